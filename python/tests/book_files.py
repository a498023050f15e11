"""A folder with the files that documentation speaks of, and the fenced blocks of its pages."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
FIRST_HOUR = ROOT / "docs" / "book" / "src" / "first-hour.md"


class Block(NamedTuple):
    """A fenced block: ```` ```python,wait=ROUTE ````."""

    language: str
    marks: tuple[str, ...]
    text: str
    line: int
    """Line of the page at which its text begins, from 1."""

    def value(self, key: str) -> str | None:
        """What stands behind ``key=`` among the marks."""
        found = [mark.removeprefix(f"{key}=") for mark in self.marks if mark.startswith(f"{key}=")]
        return found[0] if found else None


def blocks(page: Path) -> list[Block]:
    """The fenced blocks of a page."""
    text = page.read_text(encoding="utf-8")
    out = []
    for found in re.finditer(r"^```([^\n]+)\n(.*?)^```$", text, re.M | re.S):
        language, *marks = (word.strip() for word in found[1].split(","))
        line = text.count("\n", 0, found.start(2)) + 1
        out.append(Block(language, tuple(marks), found[2], line))
    return out


def write(folder: Path) -> None:
    """``plank.toml`` and ``speed.toml`` of the book's first hour, and ``speed-and-mass.toml`` with the scenario that it varies."""
    for block in blocks(FIRST_HOUR):
        name = block.value("file")
        if name is not None:
            (folder / name).write_text(block.text)
    for name in ("speed-and-mass.toml", "elastic-clamped.toml"):
        shutil.copy(ROOT / "scenarios" / "studies" / name, folder / name)
