"""Diagrams and envelopes show the section forces of the summary: the largest of a picture is that of the run."""

import csv
import re
import subprocess

from .results import SAME, Run, differs

# What a picture says of the largest value of a diagram, in the frame and over time, with five digits.
SAID = re.compile(r">[NVM] up to (?P<now>\S+) (?P<unit>[^<(]+?)(?: \(maximum over time (?P<top>\S+) (?P<of_top>[^<)]+)\))?<")
PREFIXES = {"p": 1e-12, "n": 1e-9, "\u00b5": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12}
DIGITS = 1e-4
# Of longer runs not every row is kept as a frame.
FRAMES = 1000


def check(run: Run, program: str) -> list[str]:
    beams = run.summary.get("section_forces", {})
    return envelopes(run, beams) + (diagram(run, beams, program) if beams else [])


def envelopes(run: Run, beams: dict) -> list[str]:
    """What is wrong with the extremes of envelopes.csv, of which those of the summary are a part."""
    out = []
    with (run.folder / "envelopes.csv").open() as file:
        rows = list(csv.DictReader(file))
    for name, beam in beams.items():
        own = [row for row in rows if row["beam"] == name]
        for what in ("axial", "shear", "moment"):
            for end, pick in (("min", min), ("max", max)):
                told = pick(float(row[f"{what}_{end}"]) for row in own)
                right = beam[what][end]["value"]
                size = max(abs(beam[what][one]["value"]) for one in ("min", "max"))
                out += differs(f"envelopes.csv: {what}_{end} of {name}", told, right, SAME * size)
    return out


def diagram(run: Run, beams: dict, program: str) -> list[str]:
    """What is wrong with the moments in a picture of the instant at which one is largest."""
    most = max((beam["moment_max"] for beam in beams.values()), key=lambda peak: abs(peak["value"] or 0.0))
    right, time = abs(most["value"] or 0.0), most["time"]
    if right < 1e-9:
        return []
    picture = run.folder / "moment.svg"
    command = [program, "animate", run.folder, "-o", picture, "--still", f"{time!r} s", "--diagram", "moment", "--force", "-q"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        return [f"picture: exit status {done.returncode}: {done.stderr.strip()}"]
    said = SAID.search(picture.read_text())
    if said is None:
        return ["picture: says nothing of its diagram"]
    now = number(said["now"], said["unit"])
    top = number(said["top"], said["of_top"]) if said["top"] else now
    out = differs("picture: largest moment over time", top, right, DIGITS * right)
    recorded = min(abs(row - time) for row in run.time) <= SAME * run.end
    if recorded and len(run.time) <= FRAMES:
        out += differs("picture: largest moment in its frame", now, right, DIGITS * right)
    return out


def number(text: str, unit: str) -> float:
    """A moment in N m."""
    return float(text) * PREFIXES[unit.strip().removesuffix("N m")]
