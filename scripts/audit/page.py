"""The report: its story is that of the terminal, and no number in it is missing."""

import html
import re
import subprocess

from .results import Run
from .words import story_and_table


def check(run: Run, program: str) -> list[str]:
    done = subprocess.run([program, "report", run.folder], capture_output=True, text=True)
    if done.returncode != 0:
        return [f"report: exit status {done.returncode}: {done.stderr.strip()}"]
    text = visible((run.folder / "report.html").read_text())
    out = [f"report: {word} among its words" for word in ("NaN", "undefined", "null") if re.search(rf"\b{word}\b", text)]
    story, _ = story_and_table(run)
    return out if story in text else out + ["report: its story is not that of the terminal"]


def visible(page: str) -> str:
    """What a reader sees of a page without its scripts."""
    text = re.sub(r"<(script|style).*?</\1>", "", page, flags=re.S)
    return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", text)).split())
