"""Where and when largest values are told: the columns have them there and then, in runs that have a row for every part of a step."""

import math

from . import forces
from .peaks import points_of
from .results import CLOSED, SAME, Run, differs, outside

# Joints' means over steps are those of the sections beside them, to the round-off of stiff beams (peaks.AT_SUPPORTS).
AT_JOINTS = 1e-6
# Half the depth over the radius of curvature, at most, of what scenes.py draws.
CURVED = 0.05


def check(run: Run) -> list[str]:
    out = settings(run) + strains(run) + plastic(run)
    if run.has_rows_of_all_parts():
        out += displacements(run) + reactions(run) + sections(run) + connectors(run) + joints(run)
    return out + (scale(run) if run.every == 1 and run.is_whole() else [])


def settings(run: Run) -> list[str]:
    """What was set is what the scene sets."""
    told, time = run.summary["settings"], run.scene["time"]
    out = differs("settings.end", told["end"], time["end"], 0) + differs("settings.step", told["step"], time["step"], 0)
    out += differs("settings.record_every", told["record_every"], run.every, 0)
    if run.summary["status"] == "completed":
        out += differs("steps", run.summary["steps"], round(time["end"] / time["step"]), 0)
    return out + outside("solver_steps", run.summary["solver_steps"], run.summary["steps"], math.inf)


def row_at(run: Run, time: float) -> int:
    """The row before an instant, or at it."""
    return max(k for k, t in enumerate(run.time) if t <= time * (1 + SAME))


def has_row(run: Run, time: float) -> bool:
    """Whether an instant is that of a row: a part of a step that ends where a contact was looked for, and none was, has none."""
    return abs(run.time[row_at(run, time)] - time) <= SAME * run.end


def displacements(run: Run) -> list[str]:
    """The cubic through the rows beside the instant has the value."""
    out = []
    for name, told in run.summary["point"].items():
        for k in (1, 2):
            peak = told["displacement_max"][f"component_{k}"]
            if not peak["value"]:
                continue
            u, v = run.column(f"point.{name}.displacement_{k}"), run.column(f"point.{name}.velocity_{k}")
            at = row_at(run, peak["time"])
            right = u[at] if at + 1 == len(u) else cubic(run.time, u, v, at, peak["time"])
            size = max(map(abs, u))
            out += differs(f"displacement {k} of {name} at {peak['time']:.6g} s", peak["value"], right, 1e-6 * size)
    return out


def cubic(times: list[float], u: list[float], v: list[float], k: int, t: float) -> float:
    """The value at an instant between rows k and k + 1."""
    h = times[k + 1] - times[k]
    x = (t - times[k]) / h
    return (1 + 2 * x) * (1 - x) ** 2 * u[k] + x**2 * (3 - 2 * x) * u[k + 1] + h * x * (1 - x) * ((1 - x) * v[k] - x * v[k + 1])


def reactions(run: Run) -> list[str]:
    """The row of the instant has the extreme."""
    out = []
    for name, told in run.summary["support"].items():
        for part in ("force_1", "force_2", "moment"):
            column = run.column(f"support.{name}.{part}")
            size = max(map(abs, column)) + 1e-9
            for end in [one for one in told[part].values() if has_row(run, one["time"])]:
                right = column[row_at(run, end["time"])]
                out += differs(f"{part} of {name} at {end['time']:.6g} s", end["value"], right, CLOSED * size)
    return out


def sections(run: Run) -> list[str]:
    """An extreme that lies at a recorded point is in its column; section forces may jump there, then one side is told."""
    out, long = [], forces.lengths(run)
    for beam, told in run.summary["section_forces"].items():
        places = {place(run, point, long[beam]): point for point in points_of(run, beam)}
        for part in ("axial", "shear", "moment"):
            for end, peak in told[part].items():
                at = [point for s, point in places.items() if abs(s - peak["s"]) < 1e-9 and not jumps(run, point)]
                if not at or not has_row(run, peak["time"]):
                    continue
                right = run.column(f"section.{at[0]}.{part}")[row_at(run, peak["time"])]
                size = run.largest(f"section.{at[0]}.{part}")
                what = f"{end} of {part} in {beam} at s = {peak['s']:.6g} m, {peak['time']:.6g} s"
                out += differs(what, peak["value"], right, CLOSED * size + 1e-6)
            largest = told[f"{part}_max"]
            own = [one for one in told[part].values() if one["value"] == largest["value"]]
            if not own or all((one["s"], one["time"]) != (largest["s"], largest["time"]) for one in own):
                out.append(f"{part}_max of {beam} is neither of its extremes")
    return out


def place(run: Run, point: str, length: float) -> float:
    """Arc length of a point."""
    if "@" in point:
        return float(point.split("@")[1]) * length
    return {"start": 0.0, "mid": 0.5, "end": 1.0}[point.split(".")[1]] * length


def jumps(run: Run, point: str) -> bool:
    """Whether something acts at a point, so that section forces jump; the floor and damping of modes act at any node."""
    struck = {one["strikes"] for one in run.scene["projectile"].values()}
    lumps = {lump["at"] for lump in run.scene.get("mass", {}).values()}
    return point in struck | lumps | forces.pulled(run.scene) | {"b@0.4"} or "obstacle" in run.scene or "damping" in run.scene


def strains(run: Run) -> list[str]:
    """Of an elastic beam the largest strain is the largest stress over Young's modulus, to the order of the strain itself and, of a
    curved one, to the order of its curvature times its depth."""
    material, out = run.scene["material"]["m"], []
    if "yield" in material or "retardation" in material:
        return out
    for beam, told in run.summary["section_forces"].items():
        for end in ("min", "max"):
            strain, stress = told["strain"][end]["value"], told["stress"][end]["value"]
            curved = 0.0 if run.scene["beam"][beam]["curve"] == "polyline" else CURVED
            allowed = abs(stress) / material["young"] * (3 * abs(strain) + 1e-6 + curved) + 1e-14
            out += differs(f"{end} of strain in {beam}", strain, stress / material["young"], allowed)
    return out


def plastic(run: Run) -> list[str]:
    """What yields: hinges lie on their beam and dissipate no more than it, strains add up to no less than they are, and nothing passes
    the yield stress before the first yield."""
    out, material = [], run.scene["material"]["m"]
    for beam, told in run.summary["plastic"].items():
        hinges = told["hinges"]
        out += outside(f"accumulated_max of {beam}", told["accumulated_max"], abs(told["strain_max"]) * (1 - CLOSED), math.inf)
        spent = math.fsum(hinge["dissipated"] for hinge in hinges)
        out += outside(f"dissipated by hinges of {beam}", spent, 0.0, told["dissipated"] * (1 + CLOSED) + 1e-12)
        turned = max((abs(hinge["rotation"]) for hinge in hinges), default=0.0)
        out += differs(f"rotation of {beam}", abs(told["rotation"] or 0.0), turned, SAME)
        for hinge in hinges:
            out += outside(f"place of a hinge in {beam}", hinge["s"], 0.0, forces.lengths(run)[beam] * (1 + SAME))
        for point in points_of(run, beam):
            first = told["first_yield"]["time"] if told["first_yield"] else math.inf
            before = [abs(x) for x, t in zip(run.column(f"section.{point}.stress"), run.time) if t < first * (1 - SAME)]
            out += outside(f"stress at {point} before {beam} yields", max(before, default=0.0), 0.0, material["yield"] * (1 + 1e-6))
    return out


def connectors(run: Run) -> list[str]:
    """Springs and hinges that yield: the largest values are those of their columns, and what accumulates is the way of the plastic part."""
    out = []
    for name, one in run.summary["yielding"].items():
        what = "rotation" if "plastic_rotation" in one else "extension"
        if one["failure"]["time"] is not None:
            continue
        for part in (f"plastic_{what}", what):
            peak, column = one[f"{part}_max"], run.column(f"{name}.{part}")
            size = max(map(abs, column))
            out += differs(f"{part}_max of {name}", abs(peak["value"]), size, CLOSED * size + 1e-15)
            if size > 0 and has_row(run, peak["time"]):
                there = column[row_at(run, peak["time"])]
                out += differs(f"{part} of {name} at {peak['time']:.6g} s", peak["value"], there, CLOSED * size)
        column = run.column(f"{name}.plastic_{what}")
        way = abs(column[0]) + math.fsum(abs(b - a) for a, b in zip(column, column[1:]))
        out += differs(f"accumulated_{what} of {name}", one[f"accumulated_{what}"], way, CLOSED * way + 1e-15)
    return out


def joints(run: Run) -> list[str]:
    """A joint carries what the section beside it does, until it parts."""
    out = []
    for name, told in run.summary["joint"].items():
        if "damping" in run.scene or "obstacle" in run.scene or told["parted"]:
            continue
        beside = run.scene["joint"][name]["between"][0]
        if beside in {end for spring in run.scene.get("spring", {}).values() for end in spring["between"]}:
            continue
        force = [math.hypot(n, v) for n, v in zip(run.column(f"section.{beside}.axial"), run.column(f"section.{beside}.shear"))]
        moment = [abs(m) for m in run.column(f"section.{beside}.moment")]
        for part, column in (("force_max", force), ("moment_max", moment)):
            if not has_row(run, told[part]["time"]):
                continue
            right, there = max(column), column[row_at(run, told[part]["time"])]
            allowed = AT_JOINTS * right + 1e-6
            out += differs(f"{part} of joint {name}", told[part]["value"], right, allowed)
            out += differs(f"{part} of joint {name} at {told[part]['time']:.6g} s", there, right, allowed)
    return out


def scale(run: Run) -> list[str]:
    """The energy that residuals are relative to: the largest there was, or the energy at the start with all works by their magnitudes."""
    works = [run.column("energy.work_loads"), run.column("energy.work_supports")]
    passed = math.fsum(abs(b - a) for work in works for a, b in zip(work, work[1:]))
    return outside("energy.scale", run.summary["energy"]["scale"], 0.0, (run.energy_scale() + passed) * (1 + CLOSED) + 1e-9)
