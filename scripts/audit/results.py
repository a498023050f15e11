"""What a run left, read back: the summary, the columns of the history, the words on the terminal; and how numbers are held against each other."""

import csv
import json
import math
import subprocess
from pathlib import Path

# What sums over a run may be off by, relative to the largest amount in them. Balances close to 1e-10 (`--strict`); the history has
# seventeen digits, and sums of some hundred rows of it lose a few more.
CLOSED = 1e-9
# Numbers that are told twice are the same to the last digits.
SAME = 1e-12


def differs(what: str, told, right: float, allowed: float) -> list[str]:
    """A line that says by how much a number is wrong; none where it is right to within what is allowed."""
    if isinstance(told, (int, float)) and math.isfinite(told) and abs(told - right) <= allowed:
        return []
    return [f"{what}: told {told}, right {right:.9g}, off by {distance(told, right)}, allowed {allowed:.2e}"]


def outside(what: str, told, low: float, high: float) -> list[str]:
    """A line where a number is not between two bounds."""
    if isinstance(told, (int, float)) and low <= told <= high:
        return []
    return [f"{what}: told {told}, right between {low:.9g} and {high:.9g}"]


def distance(told, right: float) -> str:
    return f"{abs(told - right):.2e}" if isinstance(told, (int, float)) else "everything"


class Run:
    """A finished run of a scene."""

    def __init__(self, scene: dict, folder: Path, done: subprocess.CompletedProcess):
        self.scene = scene
        self.status = done.returncode
        self.text = done.stderr
        self.folder = folder
        self.summary = json.loads((folder / "summary.json").read_text())
        with (folder / "history.csv").open() as file:
            rows = list(csv.reader(file))
        self.columns = {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}
        self.time = self.columns["time"]
        self.every = scene["record"]["every"]
        self.step = scene["time"]["step"]
        # The time of an instant at the end may be a unit in the last place behind it.
        self.end = self.time[-1] * (1 + SAME)

    def column(self, name: str) -> list[float]:
        return self.columns.get(name, [0.0] * len(self.time))

    def pair(self, prefix: str, row: int) -> list[float]:
        """The two components of a vector in a row."""
        return [self.column(f"{prefix}_{k}")[row] for k in (1, 2)]

    def total(self, name: str) -> float:
        """The sum of a column of amounts since the row before."""
        return math.fsum(self.column(name))

    def over_time(self, name: str, size: bool = False) -> float:
        """The integral of a column of means since the row before, or of its magnitude."""
        values = [abs(x) for x in self.column(name)] if size else self.column(name)
        return math.fsum(values[k] * (self.time[k] - self.time[k - 1]) for k in range(1, len(values)))

    def largest(self, name: str) -> float:
        return max((abs(x) for x in self.column(name)), default=0.0)

    def energy_scale(self) -> float:
        """The largest energy or work of the run, by the history."""
        names = ["energy.total", "energy.work_loads", "energy.work_supports", "energy.loss_impacts", "energy.loss_damping", "energy.plastic"]
        return max(self.largest(name) for name in names)

    def has_rows_of_all_parts(self) -> bool:
        """Whether nothing happened between two rows: where a contact was looked for and none was, a step has parts without one, and
        so have those that were cut or in which impacts accumulate."""
        return self.every == 1 and self.summary["solver_steps"] == len(self.time) - 1

    def is_whole(self) -> bool:
        """Whether every row ends a whole step: nothing was located or cut within one."""
        whole = [abs((b - a) / self.step - self.every) for a, b in zip(self.time, self.time[1:-1])]
        return self.summary["solver_steps"] == self.summary["steps"] and max(whole, default=0) < 1e-6


def contacts(run: Run) -> list[tuple[str, dict]]:
    return list(run.summary["contact"].items())


def partner(contact: dict, name: str) -> int | None:
    """Which of the two partners of a contact a thing is."""
    names = [between.split("@")[0].split(".")[0] for between in contact["between"]]
    return names.index(name) if name in names else None


def events(contact: dict) -> list[dict]:
    """Impacts and intervals of a contact."""
    return contact.get("impacts", []) + contact["intervals"]
