"""The same scene elsewhere: turned, mirrored, shifted, and in other units. Its numbers are the same, so whatever differs by more than
round-off was decided by round-off, or by the axes.

A scene that is turned by 37 degrees or shifted by tens of metres has other round-off in every number; chaos (many impacts) makes that
visible, so that numbers are compared up to a share of the largest of their kind.
"""

import json
import math
import subprocess
from pathlib import Path

from . import toml
from .results import Run

# Round-off of places some tens of metres away is 1e-14 of a beam's length, 1e-12 of its strains, and grows with every step.
SAME = 1e-4

# Below this energy, in J, nothing has moved.
QUIET = 1e-15

# Dimension of a number by its key: powers of length, mass and time.
FORCE, MOMENT, STRESS, STIFFNESS = (1, 1, -2), (2, 1, -2), (-1, 1, -2), (0, 1, -2)
DIMENSIONS = {
    "young": STRESS, "density": (-3, 1, 0), "retardation": (0, 0, 1), "mass_damping": (0, 0, -1), "yield": STRESS,
    "width": (1, 0, 0), "depth": (1, 0, 0), "rotational_stiffness": MOMENT, "rotational_damping": (2, 1, -1), "gap": (1, 0, 0),
    "displacement": (1, 0, 0), "point": (1, 0, 0), "points": (1, 0, 0), "mass": (0, 1, 0), "velocity": (1, 0, -1), "standoff": (1, 0, 0),
    "radius": (1, 0, 0), "local_mass": (0, 1, 0), "spin": (0, 0, -1), "unloading_stiffness": STIFFNESS,
    "hertz_stiffness": (-0.5, 1, -2), "dissipation": (-1, 0, 1), "penetrations": (1, 0, 0), "forces": FORCE, "acceleration": (1, 0, -2),
    "moment": MOMENT, "yield_force": FORCE, "yield_moment": MOMENT, "slack": (1, 0, 0),
}
VECTORS = ("displacement", "velocity", "acceleration", "direction", "normal", "force", "force_end")
PLACES = ("point", "points", "between")
TURNING = ("spin", "moment")


class Move:
    """A map of the plane onto itself, and units in which numbers are written."""

    def __init__(self, name: str, turn: float = 0.0, mirrored: bool = False, shift=(0.0, 0.0), length: float = 1.0, mass: float = 1.0):
        self.name, self.mirrored, self.shift = name, mirrored, shift
        self.length, self.mass = length, mass
        c, s = (0.0, 1.0) if turn == 90 else (math.cos(math.radians(turn)), math.sin(math.radians(turn)))
        self.rows = [[-c if mirrored else c, -s], [-s if mirrored else s, c]]

    def unit(self, dimension) -> float:
        return self.length ** dimension[0] * self.mass ** dimension[1]

    def vector(self, v) -> list[float]:
        return [row[0] * v[0] + row[1] * v[1] for row in self.rows]

    def place(self, x) -> list[float]:
        return [self.length * p + s for p, s in zip(self.vector(x), self.shift)]

    def back(self, v) -> list[float]:
        """A vector in the axes of the scene."""
        return [self.rows[0][k] * v[0] + self.rows[1][k] * v[1] for k in (0, 1)]

    def applies(self, scene: dict) -> bool:
        """Whether the moved scene can be written: components and unequal dampers have the axes of space, a bed that presses the side of its
        beam."""
        along_axes = any(s["kind"] == "fix" or "damping" in s for s in scene.get("support", {}).values())
        one_sided = any(bed.get("law") == "compression" for bed in scene.get("foundation", {}).values())
        turns = abs(self.rows[0][1]) > 0
        return not (along_axes and turns) and not (one_sided and self.mirrored)

    def scene(self, scene: dict) -> dict:
        made = json.loads(json.dumps(scene))  # nothing is shared between two tables
        for kind in made:
            if kind == "initial":
                self.table(kind, made[kind])
                made[kind]["about"] = self.place([0, 0])
            elif isinstance(made[kind], dict) and kind not in ("time", "record", "damping"):
                for one in made[kind].values():
                    self.table(kind, one)
        return made

    def table(self, kind: str, one: dict) -> None:
        for key, value in one.items():
            if key in PLACES:
                one[key] = self.places(value)
            elif key == "motion":
                self.table(kind, value)
            elif key == "strength":
                value["force"] *= self.unit(FORCE)
                value["moment"] *= self.unit(MOMENT)
            elif (dimension := dimension_of(kind, one, key)) is not None:
                one[key] = self.amount(key, value, self.unit(dimension))
            elif key in VECTORS:
                one[key] = self.vector(value)

    def places(self, value):
        if isinstance(value, str):
            return value
        if all(isinstance(x, (int, float)) for x in value):
            return self.place(value)
        return [self.places(x) for x in value]

    def amount(self, key: str, value, unit: float):
        if isinstance(value, dict):
            return {k: v * unit for k, v in value.items()}
        if key in VECTORS:
            return [unit * v for v in self.vector(value)]
        if isinstance(value, list):
            return [unit * v for v in value]
        return value * unit * (-1 if self.mirrored and key in TURNING else 1)


def dimension_of(kind: str, one: dict, key: str):
    """Powers of length, mass and time of a number, where its meaning depends on its table."""
    if key in ("force", "force_end"):
        return FORCE if one["kind"] == "point" else STIFFNESS
    if key == "hardening":
        return STRESS if kind == "material" else MOMENT
    if key in ("stiffness", "damping"):
        turns = 2 if kind == "joint" else -1 if kind == "foundation" else 0
        return (turns, 1, -2 if key == "stiffness" else -1)
    return DIMENSIONS.get(key)


MOVES = [
    Move("turned by 37 degrees", turn=37),
    Move("mirrored", mirrored=True),
    Move("shifted", shift=(30.0, -30.0)),
    Move("in millimetres and tonnes", length=1e3, mass=1e-3),
]


def check(run: Run, program: str, folder: Path) -> list[str]:
    """What differs between a scene and itself elsewhere."""
    out = []
    if has_impacts(run.scene) or run.energy_scale() < QUIET:
        return out
    for move in MOVES:
        if not move.applies(run.scene):
            continue
        scene = move.scene(run.scene)
        file, results = folder / "moved.toml", folder / f"moved-{run.folder.name}-{move.name.replace(' ', '-')}"
        file.write_text(toml.text(scene))
        command = [program, "run", file, "--out", results, "--history", "csv", "--no-report"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != run.status or not (results / "summary.json").exists():
            said = [line for line in done.stderr.splitlines() if "[E" in line]
            out.append(f"{move.name}: exit status {done.returncode} in place of {run.status}: {' '.join(said)}")
            continue
        other = Run(scene, results, done)
        # A step at a kink may converge whole or be cut, by round-off; then the numbers differ by the error of the step.
        if other.summary["solver_steps"] == run.summary["solver_steps"]:
            out += [f"{move.name}: {line}" for line in compared(run, other, move)]
    return out


def has_impacts(scene: dict) -> bool:
    """Whether velocities may jump: after some impacts nothing of a trajectory is left but its balances."""
    pairs = list(scene["projectile"].values()) + list(scene.get("contact", {}).values())
    return any("rigid" in (one.get("kind"), one.get("law")) for one in pairs)


def compared(run: Run, other: Run, move: Move) -> list[str]:
    """Columns of the two histories, each to a share of the largest of its kind."""
    if len(run.time) != len(other.time):
        return [f"{len(other.time)} rows in place of {len(run.time)}"]
    kinds: dict[str, list[str]] = {}
    for name in run.columns:
        if dimension := dimension_of_column(name):
            kinds.setdefault(str(dimension), []).append(name)
    out = []
    for names in kinds.values():
        scale = max(run.largest(name) for name in names)
        for name in names:
            out += first_difference(run, other, move, name, SAME * scale)
    return out


def first_difference(run: Run, other: Run, move: Move, name: str, allowed: float) -> list[str]:
    unit, told = move.unit(dimension_of_column(name)), other.columns.get(name)
    if told is None:
        return [f"{name} is missing"]
    right = run.columns[name]
    for k, time in enumerate(run.time):
        value = vector_back(other, move, name, k) if name[-2:] in ("_1", "_2") else told[k] * sign(move, name)
        if not abs(value / unit - right[k]) <= allowed:
            return [f"{name} at {time:.6g} s: {value / unit:.9g} in place of {right[k]:.9g}, allowed {allowed:.2e}"]
    return []


def vector_back(other: Run, move: Move, name: str, row: int) -> float:
    return move.back(other.pair(name[:-2], row))[int(name[-1]) - 1]


def sign(move: Move, name: str) -> float:
    """Moments, shear forces, rotations and spins of a mirrored scene have the other sign."""
    odd = name.rsplit(".", 1)[-1] in ("shear", "moment", "rotation", "spin")
    return -1.0 if move.mirrored and odd else 1.0


def dimension_of_column(name: str):
    """Powers of length, mass and time of a column that is compared; places count from another origin, and stresses change their side."""
    last = name.rsplit(".", 1)[-1].removesuffix("_1").removesuffix("_2")
    if name.startswith("section."):
        return {"axial": FORCE, "shear": FORCE, "moment": MOMENT}.get(last)
    if name.startswith("support."):
        return {"force": FORCE, "moment": MOMENT}.get(last)
    if name.startswith("point."):
        return {"displacement": (1, 0, 0), "velocity": (1, 0, -1)}.get(last)
    if name.startswith("contact.") and name.endswith(".force"):
        return FORCE
    if name.startswith("energy."):
        return MOMENT
    return None
