"""Equilibria: loads at time zero and reactions cancel, and a run that starts from an equilibrium starts from the one that `static` tells."""

import json
import math
import subprocess
from pathlib import Path

from . import balances, forces
from .results import CLOSED, Run, differs, outside
from .scenes import area

# `static` takes the mean of a load over a nanosecond from time zero on: half of that beside the steepest rise here, a half sine over
# 23 steps of 10 us.
INSTANT = 0.5e-9 * math.pi / 233e-6


def equilibrium(program: str, file: Path, out: Path) -> tuple[int, dict | None, str]:
    """Exit status, what `static --json` prints, and what it says beside."""
    command = [program, "static", file, "--json", "--out", out]
    done = subprocess.run(command, capture_output=True, text=True)
    return done.returncode, json.loads(done.stdout) if done.returncode == 0 else None, done.stderr


def applies(scene: dict) -> bool:
    """Whether a scene has an equilibrium: something holds it, and something acts on it that stands still."""
    return "support" in scene and bool(scene["load"]) and all("motion" not in support for support in scene["support"].values())


def check(run: Run, told: dict) -> list[str]:
    return sums(run, told) + moments(run, told) + sections(told) + start(run, told)


def at_zero(run: Run) -> tuple[list[float], float]:
    """The sum of loads on the structure at time zero, and the sum of their sizes at full height. Projectiles on their way take no part."""
    total, size = [0.0, 0.0], 0.0
    for load in run.scene["load"].values():
        if load["kind"] == "gravity":
            force = [forces.beam_mass(run) * a for a in load["acceleration"]]
        elif load["kind"] == "base":
            force = [-forces.beam_mass(run) * a for a in load["acceleration"]]
        else:
            force = forces.resultant(run, load)
        factor = forces.course_value(load.get("function"), 0.0)
        total = [t + factor * f for t, f in zip(total, force)]
        size += math.hypot(*force)
    return total, size


def sums(run: Run, told: dict) -> list[str]:
    """Loads and reactions cancel; loads are those of the scene."""
    right, size = at_zero(run)
    out, unsure = [], forces.weight_error(run) / run.time[-1] + INSTANT * size
    for k in (0, 1):
        reactions = math.fsum(support[f"force_{k + 1}"] for support in told["support"].values())
        balance = told["balance"]
        springs = balance["springs"][k]
        scale = max(size, max(abs(support[f"force_{k + 1}"]) for support in told["support"].values()))
        out += differs(f"static: loads and reactions {k + 1}", balance["loads"][k] + reactions + springs, 0.0, CLOSED * scale)
        out += differs(f"static: reactions {k + 1} of the balance", balance["reactions"][k], reactions, CLOSED * scale)
        out += differs(f"static: loads {k + 1}", balance["loads"][k], right[k], unsure)
        out += differs(f"static: unbalanced {k + 1}", balance["unbalanced"][k], 0.0, CLOSED * scale)
    acts = any(forces.course_value(load.get("function"), 0.0) for load in run.scene["load"].values())
    largest = max(abs(support[key]) for support in told["support"].values() for key in ("force_1", "force_2"))
    # The most that was seen of the unit lengths of shear-flexible beams at rest is 2e-10 N of an EA of 1e8 N.
    stiff = run.scene["material"]["m"]["young"] * area(run.scene)
    if not acts and largest > max(1e-15, 1e-17 * stiff):
        out.append(f"static: nothing acts at time zero, but reactions of {largest:.3g} N are told")
    return out


def moments(run: Run, told: dict) -> list[str]:
    """Moments about the origin cancel, of a straight beam under a load at a point, in the deformed configuration."""
    scene = run.scene
    if list(scene["load"]) != ["push"] or scene["beam"]["b"]["curve"] != "polyline" or "obstacle" in scene or forces.held_by_springs(scene):
        return []
    load = scene["load"]["push"]
    factor = forces.course_value(load.get("function"), 0.0)
    (x0, y0), (x1, y1) = scene["beam"]["b"]["points"]
    moved = told["point"]["b@0.4"]["displacement"]
    x, y = x0 + 0.4 * (x1 - x0) + moved[0], y0 + 0.4 * (y1 - y0) + moved[1]
    parts = [factor * (x * load["force"][1] - y * load["force"][0]), factor * load.get("moment", 0.0)]
    for name, one in scene["support"].items():
        place, moved, given = balances.end_of(scene, one["at"]), told["point"][one["at"]]["displacement"], told["support"][name]
        x, y = place[0] + moved[0], place[1] + moved[1]
        parts += [x * given["force_2"] - y * given["force_1"], given["moment"]]
    scale = max(map(abs, parts)) + math.hypot(*load["force"])
    return differs("static: moments of load and reactions", math.fsum(parts), 0.0, INSTANT * scale + CLOSED * scale)


def sections(told: dict) -> list[str]:
    """Extremes are in order, and the largest is one of them."""
    out = []
    for beam, forces_ in told["section_forces"].items():
        for part in ("axial", "shear", "moment"):
            low, high = forces_[part]["min"]["value"], forces_[part]["max"]["value"]
            out += outside(f"static: smallest {part} of {beam}", low, -math.inf, high)
            right = max(abs(low), abs(high))
            out += differs(f"static: {part}_max of {beam}", abs(forces_[f"{part}_max"]["value"]), right, CLOSED * right)
    return out


def start(run: Run, told: dict) -> list[str]:
    """The first row of a run with a static start. A beam that yields may have another state within the tolerance of its iteration."""
    if run.scene["time"].get("start") != "static":
        return []
    out = []
    scale = max(abs(support[key]) for support in told["support"].values() for key in ("force_1", "force_2", "moment")) + 1e-9
    for name, support in told["support"].items():
        for key in ("force_1", "force_2", "moment"):
            out += differs(f"static start: {key} of {name}", run.column(f"support.{name}.{key}")[0], support[key], 1e-6 * scale)
    for name, point in told["point"].items():
        size = max(abs(x) for one in told["point"].values() for x in one["displacement"]) + 1e-12
        for k in (0, 1):
            first = run.column(f"point.{name}.displacement_{k + 1}")[0]
            out += differs(f"static start: displacement {k + 1} of {name}", first, point["displacement"][k], 1e-6 * size)
    return out + differs("static start: kinetic energy of beams", run.column("energy.kinetic_beams")[0], 0.0, 0.0)
