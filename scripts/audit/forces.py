"""The scene's own masses and loads: what they weigh, and the impulse of each load over a run, by Simpson's rule between the corners of
its time function. Nothing comes from the program but the length of a curved centre line."""

import json
import math

from .results import Run, differs
from .scenes import area


def lengths(run: Run) -> dict[str, float]:
    """Length of every beam: straight ones by geometry, curved ones as their stations in the scene say (their elements are cubics)."""
    stations = json.loads((run.folder / "fields" / "scene.json").read_text())["beams"]
    curved = {one["name"]: one["s"][-1] for one in stations}
    return {
        name: math.dist(*beam["points"]) if beam["curve"] == "polyline" else curved[name]
        for name, beam in run.scene["beam"].items()
    }


def arc_length(start, middle, end) -> float:
    """Of a flat arc through three points, the middle one above the middle of the chord."""
    half, rise = math.dist(start, end) / 2, middle[1] - (start[1] + end[1]) / 2
    radius = (half**2 + rise**2) / (2 * rise)
    return 2 * radius * math.asin(half / radius)


def check(run: Run) -> list[str]:
    """Arcs are as long as geometry says, to the error of their cubics: a quarter of a radian a piece at most, to its sixth power."""
    arcs = [(name, beam) for name, beam in run.scene["beam"].items() if beam["curve"] == "arc"]
    right = {name: arc_length(*beam["points"]) for name, beam in arcs}
    return [line for name in right for line in differs(f"length of {name}", lengths(run)[name], right[name], 1e-4 * right[name])]


def beam_mass(run: Run) -> float:
    per_length = run.scene["material"]["m"]["density"] * area(run.scene)
    lumps = sum(lump["mass"] for lump in run.scene.get("mass", {}).values())
    # What a struck point carries in itself belongs to the structure.
    lumps += sum(p.get("local_mass", 0.0) for p in run.scene["projectile"].values())
    return per_length * sum(lengths(run).values()) + lumps


def is_guided(projectile: dict) -> bool:
    return projectile.get("contact") != "surface"


def direction(projectile: dict) -> list[float]:
    speed = math.hypot(*projectile["velocity"])
    return [v / speed for v in projectile["velocity"]]


def gravity(run: Run) -> list[float]:
    return run.scene["load"].get("weight", {}).get("acceleration", [0.0, 0.0])


def weight_on(run: Run, projectile: dict) -> list[float]:
    """Gravity on a projectile; what is guided feels that along its line of flight alone."""
    return along_guide(projectile, [projectile["mass"] * x for x in gravity(run)])


def along_guide(projectile: dict, force: list[float]) -> list[float]:
    """What a projectile feels of a force: one that is guided, the part along its line of flight."""
    if not is_guided(projectile):
        return force
    d = direction(projectile)
    along = force[0] * d[0] + force[1] * d[1]
    return [along * x for x in d]


def course_value(shape: dict | None, t: float) -> float:
    """A time function at an instant."""
    if shape is None:
        return 1.0
    kind = shape["kind"]
    if kind == "step":
        return 1.0 if t > shape["at"] else 0.0
    if kind == "ramp":
        return min(1.0, t / shape["duration"])
    if kind == "half-sine":
        return math.sin(math.pi * t / shape["duration"]) if t < shape["duration"] else 0.0
    if kind == "triangle":
        return max(0.0, 1 - abs(2 * t / shape["duration"] - 1))
    if kind == "harmonic":
        return math.sin(2 * math.pi * shape["frequency"] * t + shape.get("phase", 0.0))
    times, values = shape["times"], shape["values"]
    for (t0, f0), (t1, f1) in zip(zip(times, values), zip(times[1:], values[1:])):
        if t <= t1:
            return f0 + (f1 - f0) * (t - t0) / (t1 - t0)
    return values[-1]


def course_integral(load: dict, end: float) -> float:
    """The integral of a load's time function up to an instant, by Simpson's rule on 2000 parts between its corners."""
    end, shape = min(end, load.get("until", end)), load.get("function")
    corners = [0.0, end]
    if shape:
        duration = shape.get("at", shape.get("duration", 0.0))
        corners += [duration, duration / 2] + list(shape.get("times", []))
    corners = sorted({t for t in corners if 0 <= t <= end})
    return math.fsum(simpson(shape, a, b) for a, b in zip(corners, corners[1:]))


def simpson(shape: dict | None, a: float, b: float, parts: int = 2000) -> float:
    h, inside = (b - a) / parts, 1e-12 * (b - a)
    at = [course_value(shape, min(max(a + k * h, a + inside), b - inside)) for k in range(parts + 1)]
    return h / 3 * math.fsum([at[0], at[-1]] + [4 * x for x in at[1::2]] + [2 * x for x in at[2:-1:2]])


def resultant(run: Run, load: dict) -> list[float]:
    """The force of a load where its time function is one."""
    if load["kind"] == "gravity":
        on_projectiles = [weight_on(run, p) for p in run.scene["projectile"].values()]
        return [beam_mass(run) * load["acceleration"][k] + sum(w[k] for w in on_projectiles) for k in (0, 1)]
    if load["kind"] == "point":
        return load["force"]
    if load["kind"] == "temperature":
        return [0.0, 0.0]
    if load["kind"] == "base":
        return inertia_of_base(run, load["acceleration"])
    length = lengths(run)[load["on"]]
    share = 1.0 if load["stretch"] == ["start", "end"] else load["stretch"][1] - load["stretch"][0]
    return [length * share * (load["force"][k] + load["force_end"][k]) / 2 for k in (0, 1)]


def inertia_of_base(run: Run, acceleration: list[float]) -> list[float]:
    """The force of inertia on everything while the ground shakes: what moves relative to it is told relative to it."""
    on_projectiles = [inertia_on(p, acceleration) for p in run.scene["projectile"].values()]
    return [-beam_mass(run) * acceleration[k] + sum(w[k] for w in on_projectiles) for k in (0, 1)]


def inertia_on(projectile: dict, acceleration: list[float]) -> list[float]:
    return along_guide(projectile, [-projectile["mass"] * a for a in acceleration])


def shaken(run: Run, projectile: dict) -> list[float]:
    """The impulse of inertia on a projectile while the ground shakes."""
    quake = run.scene["load"].get("quake")
    if not quake:
        return [0.0, 0.0]
    long = course_integral(quake, run.time[-1])
    return [force * long for force in inertia_on(projectile, quake["acceleration"])]


def pulled(scene: dict) -> set[str]:
    """Points at which springs act inside a beam."""
    ends = [end for spring in scene.get("spring", {}).values() for end in spring["between"]]
    return {end for end in ends if isinstance(end, str)}


def held_by_springs(scene: dict) -> bool:
    """Whether a rope or a bed holds beams against the ground beside the supports."""
    return "foundation" in scene or "rope" in scene.get("spring", {})


def load_impulse(run: Run) -> list[float]:
    """The impulse of all loads over the run."""
    parts = [(resultant(run, load), course_integral(load, run.time[-1])) for load in run.scene["load"].values()]
    return [math.fsum(force[k] * long for force, long in parts) for k in (0, 1)]


# The mass of a curved element is that of its cubic, which is shorter than the curve: an element of a spline here turns by up to a radian,
# one of an arc by less than half of one. The lengths that stand in the scene are those of the curve.
MASS_ERROR = {"polyline": 0.0, "arc": 1e-4, "spline": 1e-2}


def weight_error(run: Run) -> float:
    """What the impulse of weight and loads along beams may be off by for the curvature of beams."""
    error = max(MASS_ERROR[beam["curve"]] for beam in run.scene["beam"].values())
    along = run.scene["load"].get("along")
    spread = math.hypot(*resultant(run, along)) if along else 0.0
    return error * (beam_mass(run) * math.hypot(*gravity(run)) + spread) * run.time[-1]
