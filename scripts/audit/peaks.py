"""Largest displacements, reactions, section forces and stresses against the columns of the history."""

import csv
import math

from . import forces, laws
from .results import CLOSED, SAME, Run, differs, outside
from .scenes import area, inertia

# Section forces at supports are the reactions, to the round-off of stiff beams: 1e-12 of the forces between nodes, EA, in a force of kN.
AT_SUPPORTS = 1e-6

# What a support gives in parts as short as an impact is split into force and impulse by the force before; beside all that it gave, the
# time of impacts times how forces change is less than this.
SPLIT = 1e-6


def check(run: Run) -> list[str]:
    return displacements(run) + reactions(run) + sections(run) + at_supports(run) + stresses(run) + envelopes(run) + yielding(run) + nulls(run)


def displacements(run: Run) -> list[str]:
    """The largest is that of the rows, or of the cubic between two of them."""
    out = []
    for name, told in run.summary["point"].items():
        for k in (1, 2):
            values, rates = run.column(f"point.{name}.displacement_{k}"), run.column(f"point.{name}.velocity_{k}")
            low = max(map(abs, values))
            high = max(low, between(run.time, values, rates)) if run.has_rows_of_all_parts() else math.inf
            size = abs(told["displacement_max"][f"component_{k}"]["value"])
            out += outside(f"displacement_max {k} of {name}", size, low * (1 - SAME), high * (1 + CLOSED) + 1e-15)
            out += outside(f"time of displacement_max {k} of {name}", told["displacement_max"][f"component_{k}"]["time"], 0, run.end)
    return out


def between(times: list[float], values: list[float], rates: list[float]) -> float:
    """The largest magnitude of the cubics through values and rates."""
    largest = 0.0
    for k in range(len(times) - 1):
        h = times[k + 1] - times[k]
        if h > 0:
            for sign in (1, -1):
                ends = [sign * x for x in (values[k], rates[k], values[k + 1], rates[k + 1])]
                largest = max(largest, laws.crest(h, *ends))
    return largest


def reactions(run: Run) -> list[str]:
    """Extremes of reactions enclose the rows, and are those of the rows where every row is a step; impulses are sums of columns."""
    out = []
    for name, told in run.summary["support"].items():
        for part in ("force_1", "force_2", "moment"):
            column = run.column(f"support.{name}.{part}")
            if part not in told or not column:
                continue
            low, high, scale = told[part]["min"]["value"], told[part]["max"]["value"], max(map(abs, column)) + 1e-9
            if run.is_whole() and run.every == 1:
                out += differs(f"largest {part} of {name}", high, max(column), CLOSED * scale)
                out += differs(f"smallest {part} of {name}", low, min(column), CLOSED * scale)
            else:
                out += outside(f"largest {part} of {name}", high, max(column) - CLOSED * scale, math.inf)
                out += outside(f"smallest {part} of {name}", low, -math.inf, min(column) + CLOSED * scale)
        for part in ("impulse_1", "impulse_2", "impulse_moment"):
            column = run.column(f"support.{name}.{part}")
            force = part.replace("impulse", "force") if part != "impulse_moment" else "moment"
            scale = math.fsum(map(abs, column)) + run.over_time(f"support.{name}.{force}", size=True)
            if told.get(part) is not None:
                out += differs(f"{part} of {name}", told[part], math.fsum(column), SPLIT * scale + 1e-12)
    return out


def sections(run: Run) -> list[str]:
    """Extremes along a beam enclose the columns of its points, at places and times that there are."""
    out = []
    for beam, told in run.summary["section_forces"].items():
        for part in ("axial", "shear", "moment", "stress"):
            ends = told[part]
            if ends["min"]["value"] is None:
                continue
            low, high = ends["min"]["value"], ends["max"]["value"]
            slack = CLOSED * max(abs(low), abs(high))
            for point in points_of(run, beam):
                column = run.column(f"section.{point}.{part}")
                out += outside(f"smallest {part} at {point} against that of {beam}", min(column), low - slack, math.inf)
                out += outside(f"largest {part} at {point} against that of {beam}", max(column), -math.inf, high + slack)
            out += [line for end in ends.values() for line in outside(f"time of extreme {part} in {beam}", end["time"], 0, run.end)]
            if f"{part}_max" in told:
                right = max(abs(low), abs(high))
                out += differs(f"{part}_max of {beam}", abs(told[f"{part}_max"]["value"]), right, SAME * right)
    return out


def points_of(run: Run, beam: str) -> list[str]:
    """Recorded points of a beam with section forces."""
    names = {column.removeprefix("section.").rsplit(".", 1)[0] for column in run.columns if column.startswith("section.")}
    return sorted(name for name in names if name.split("@")[0].split(".")[0] == beam)


def at_supports(run: Run) -> list[str]:
    """Where nothing but a support holds an end, section forces there are its reaction. The axes of the section turn with the beam, so that
    the force is compared by its size. Damping of modes acts at nodes, so also at ends, and so may a floor."""
    out = []
    if not run.is_whole() or run.every > 1 or "damping" in run.scene or "obstacle" in run.scene:
        return out
    tied = {end for spring in run.scene.get("spring", {}).values() for end in spring["between"] if isinstance(end, str)}
    for name, support in run.scene.get("support", {}).items():
        if support["at"] in tied:
            continue
        point, sign = support["at"], -1.0 if support["at"].endswith("start") else 1.0
        force = [math.hypot(*run.pair(f"support.{name}.force", k)) for k in range(len(run.time))]
        inside = [math.hypot(n, v) for n, v in zip(run.column(f"section.{point}.axial"), run.column(f"section.{point}.shear"))]
        out += first_apart(run, f"force at {point} against support {name}", inside, force)
        moment = [sign * m for m in run.column(f"support.{name}.moment")]
        out += first_apart(run, f"moment at {point} against support {name}", run.column(f"section.{point}.moment"), moment)
    return out


def first_apart(run: Run, what: str, told: list[float], right: list[float]) -> list[str]:
    """The first row in which two columns differ by more than the round-off of the stiffness EA, which is 1e-15 of it."""
    stiff = run.scene["material"]["m"]["young"] * area(run.scene)
    scale = max(max(map(abs, told)), max(map(abs, right)), 1e-15 / AT_SUPPORTS * stiff)
    for k, t in enumerate(run.time):
        found = differs(f"{what} at {t:.6g} s", told[k], right[k], AT_SUPPORTS * scale)
        if found:
            return found
    return []


def stresses(run: Run) -> list[str]:
    """Of an elastic beam the extreme fibre has |N| / A + |M| c / I, of points at which nothing jumps."""
    out, made = [], run.scene
    # Modal damping and a floor act at nodes, where section forces then jump.
    if "yield" in made["material"]["m"] or "damping" in made or "obstacle" in made:
        return out
    a, w = area(made), inertia(made) / (made["section"]["s"]["depth"] / 2)
    for beam, told in run.summary["section_forces"].items():
        lumps = {"b@0.4"} | forces.pulled(made) | {lump["at"] for lump in made.get("mass", {}).values()}
        for point in [p for p in made["record"]["points"] if p in points_of(run, beam) and p not in lumps]:
            parts = [run.column(f"section.{point}.{part}") for part in ("axial", "moment", "stress")]
            # Axial forces have the round-off of EA.
            scale = max(map(abs, parts[2])) + 1e-15 / CLOSED * made["material"]["m"]["young"]
            for n, m, stress in zip(*parts):
                if abs(abs(stress) - abs(n) / a - abs(m) / w) > CLOSED * scale:
                    out += differs(f"stress at {point}", abs(stress), abs(n) / a + abs(m) / w, CLOSED * scale)
                    break
        bound = abs(told["axial_max"]["value"]) / a + abs(told["moment_max"]["value"]) / w
        largest = max(abs(told["stress"][end]["value"]) for end in ("min", "max"))
        out += outside(f"largest stress of {beam} against its largest forces", largest, 0, bound * (1 + CLOSED))
    return out


def envelopes(run: Run) -> list[str]:
    """Rows of envelopes.csv lie within the extremes of the summary."""
    out = []
    with (run.folder / "envelopes.csv").open() as file:
        for row in csv.DictReader(file):
            told = run.summary["section_forces"][row["beam"]]
            for part in ("axial", "shear", "moment"):
                low, high = told[part]["min"]["value"], told[part]["max"]["value"]
                slack = SAME * max(abs(low), abs(high))
                what = f"envelope of {part} at {row['beam']}@{row['s']}"
                out += outside(what, float(row[f"{part}_min"]), low - slack, high + slack)
                out += outside(what, float(row[f"{part}_max"]), low - slack, high + slack)
    return out


def yielding(run: Run) -> list[str]:
    """What beams, springs and hinges dissipated adds up to that of the run; plastic parts end as their columns do."""
    told, scale, out = run.summary, run.energy_scale(), []
    each = list(told["plastic"].values()) + list(told["yielding"].values())
    dissipated = math.fsum(one["dissipated"] - one.get("dissipated_by_preload", 0.0) for one in each)
    out += differs("energy.plastic as the sum of its parts", told["energy"]["plastic"], dissipated, CLOSED * scale)
    hardening = math.fsum(one["hardening"] for one in each)
    out += differs("energy.hardening as the sum of its parts", told["energy"]["hardening"], hardening, CLOSED * scale)
    for name, one in told["yielding"].items():
        what = "rotation" if "plastic_rotation" in one else "extension"
        if one["failure"]["time"] is None:
            right = run.column(f"{name}.plastic_{what}")[-1]
            out += differs(f"plastic_{what} of {name}", one[f"plastic_{what}"], right, CLOSED * max(1e-9, abs(right)))
        for part in (f"plastic_{what}", what):
            size = abs(one[f"{part}_max"]["value"])
            out += outside(f"{part}_max of {name}", size, run.largest(f"{name}.{part}") * (1 - SAME) - 1e-15, math.inf)
    return out


# What may be null without a word beside it, by its meaning in docs/results.md.
NULLS = {
    "end", "restitution", "separation_velocity", "duration", "first_yield", "parted", "multiple_impacts", "reason", "error", "error_code",
    "plastic_deflection", "permanent_set", "permanent_set_at", "direction", "strikes", "reference", "restitution_why", "value", "strain_max_at", "advice",
}


def nulls(run: Run) -> list[str]:
    """Every null is one that the documentation explains."""
    return [f"null without a reason: {path}" for path in sorted(set(missing(run.summary, "")))][:3]


def missing(value, path: str) -> list[str]:
    """Paths of nulls that nothing explains."""
    if isinstance(value, list):
        return [found for one in value for found in missing(one, path + "[]")]
    if not isinstance(value, dict):
        return []
    out = [f"{path}.{key}" for key, one in value.items() if one is None and key not in NULLS]
    if value.keys() <= {"value", "s", "time"} and not value.get("value"):
        out = []  # what never was has no time, and what is not known (stresses of sections without a shape) no place
    if path.endswith(".permanent_set_at") and not any(value.get("displacement") or []):
        out = []  # nor has a set that is zero a place
    return out + [found for key, one in value.items() for found in missing(one, f"{path}.{key}")]
