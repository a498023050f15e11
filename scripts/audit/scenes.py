"""Random scenes of every kind: beams of all shapes on all supports, what strikes them, what acts on them.

A scene is a dictionary of the tables of a scenario, numbers in SI, so that the audit knows masses, loads and times without reading
the file back. Steps are sane: a contact takes a dozen of them or more (that is what `percuss check` asks for, too).
"""

import math
import random

from . import extras

STEEL = {"young": 2.1e11, "density": 7850.0}
ALUMINIUM = {"young": 7e10, "density": 2700.0}


def scene(seed: int) -> dict:
    """The scene of a seed."""
    chance = random.Random(seed)
    made = {"title": f"Scene {seed}", "material": {"m": material(chance)}, "section": {"s": section(chance)}}
    step = chance.choice([1e-5, 2e-5, 5e-5, 1e-4])
    structure(chance, made)
    strikers(chance, made, step)
    surroundings(chance, made)
    loads(chance, made, step)
    extras.add(seed, made, step)
    settings(chance, made, step)
    return made


def material(chance: random.Random) -> dict:
    made = dict(chance.choice([STEEL, ALUMINIUM]))
    made["strain"] = chance.choice(["green", "engineering"])
    if chance.random() < 0.25:
        made["retardation"] = chance.choice([2e-6, 1e-5, 1e-4])
    if chance.random() < 0.12:
        made["mass_damping"] = chance.choice([5.0, 50.0])
    if chance.random() < 0.2:
        made["yield"] = chance.choice([100e6, 250e6])
        if chance.random() < 0.5:
            made["hardening"] = {"isotropic": 2e9} if chance.random() < 0.5 else {"kinematic": 1e9}
        made.pop("retardation", None)
    return made


def section(chance: random.Random) -> dict:
    depth = chance.choice([0.01, 0.02, 0.04])
    return {"shape": "rectangle", "width": chance.choice([0.02, 0.05]), "depth": depth}


def area(made: dict) -> float:
    return made["section"]["s"]["width"] * made["section"]["s"]["depth"]


def inertia(made: dict) -> float:
    return made["section"]["s"]["width"] * made["section"]["s"]["depth"] ** 3 / 12


def beam(points: list, elements: int, curve: str = "polyline") -> dict:
    return {"points": points, "curve": curve, "elements": elements, "material": "m", "section": "s"}


def structure(chance: random.Random, made: dict) -> None:
    kind = chance.choice(["straight", "straight", "slanted", "arc", "spline", "frame", "hinged", "free"])
    made["title"] += f", {kind}"
    length, elements = chance.uniform(0.5, 2.0), chance.choice([4, 8, 12])
    if kind == "frame":
        return frame(chance, made, length, elements)
    if kind == "hinged":
        return hinged(chance, made, length, elements)
    rise = chance.uniform(0.05, 0.2) * length
    points = {
        "slanted": [[0, 0], [length * 0.8, length * 0.6]],
        "arc": [[0, 0], [length / 2, rise], [length, 0]],
        "spline": [[0, 0], [length * 0.3, rise], [length * 0.7, -rise / 2], [length, 0]],
    }.get(kind, [[0, 0], [length, 0]])
    made["beam"] = {"b": beam(points, elements, kind if kind in ("arc", "spline") else "polyline")}
    if kind != "free":
        supports(chance, made, "b")


def supports(chance: random.Random, made: dict, name: str) -> None:
    first, last = chance.choice([
        ("clamp", "clamp"), ("clamp", None), ("pin", "roller"), ("pin", "pin"), ("clamp", "roller"), ("clamp", "stop"),
        ("elastic", "elastic"), ("pin", "elastic"), ("clamp", "slider"),
    ])
    made["support"] = {"a": support(chance, f"{name}.start", first)}
    if last:
        made["support"]["z"] = support(chance, f"{name}.end", last)


def support(chance: random.Random, at: str, kind: str) -> dict:
    if kind == "slider":
        return {"at": at, "kind": "fix", "components": [2, "rotation"]}
    made = {"at": at, "kind": kind}
    if kind == "roller":
        made["direction"] = [1, 0]
    elif kind == "elastic":
        made |= {"stiffness": [chance.choice([1e6, 1e8])] * 2, "rotational_stiffness": chance.choice([1e3, 1e5])}
        if chance.random() < 0.5:
            made |= {"damping": [100.0, 200.0], "rotational_damping": 5.0}
    elif kind == "stop":
        made |= {"direction": [0, -1], "gap": chance.choice([1e-4, 1e-3]), "stiffness": 1e7, "two_sided": chance.random() < 0.5}
    return made


def frame(chance: random.Random, made: dict, length: float, elements: int) -> None:
    """A portal frame; its right corner may be a hinge with a spring, which may yield."""
    height = chance.uniform(0.5, 1.0) * length
    made["beam"] = {
        "left": beam([[0, 0], [0, height]], elements),
        "b": beam([[0, height], [length, height]], elements),
        "right": beam([[length, 0], [length, height]], elements),
    }
    made["support"] = {
        "a": support(chance, "left.start", "clamp"),
        "z": support(chance, "right.start", chance.choice(["clamp", "pin"])),
    }
    made["joint"] = {
        "one": {"kind": "rigid", "between": ["left.end", "b.start"]},
        "two": corner(chance, ["b.end", "right.end"]),
    }
    if chance.random() < 0.4:
        brace = {"between": ["left.start", "b.end"], "stiffness": 1e6, "damping": chance.choice([0.0, 50.0])}
        if chance.random() < 0.5:
            brace["yield_force"] = chance.choice([300.0, 3000.0])
        made["spring"] = {"brace": brace}


def corner(chance: random.Random, between: list) -> dict:
    kind = chance.choice(["rigid", "hinge", "spring", "yielding", "weak"])
    if kind in ("rigid", "weak"):
        weak = {"strength": {"force": 1e5, "moment": chance.choice([50.0, 5e3])}} if kind == "weak" else {}
        return {"kind": "rigid", "between": between} | weak
    made = {"kind": "hinge", "between": between}
    if kind != "hinge":
        made |= {"stiffness": 1e4, "damping": chance.choice([0.0, 5.0])}
    if kind == "yielding":
        made |= {"yield_moment": chance.choice([20.0, 200.0]), "hardening": {"isotropic": 500.0}}
    return made


def hinged(chance: random.Random, made: dict, length: float, elements: int) -> None:
    """Two beams in line with a hinge between them, held so that they are no mechanism."""
    at = chance.uniform(0.3, 0.7) * length
    made["beam"] = {"b": beam([[0, 0], [at, 0]], elements), "c": beam([[at, 0], [length, 0]], elements)}
    made["support"] = {"a": support(chance, "b.start", "clamp"), "z": support(chance, "c.end", chance.choice(["clamp", "pin"]))}
    made["joint"] = {"hinge": corner(chance, ["b.end", "c.start"])}
    if chance.random() < 0.3:
        made["mass"] = {"lump": {"at": "c.mid", "mass": chance.uniform(0.1, 2.0)}}


def strikers(chance: random.Random, made: dict, step: float) -> None:
    count = chance.choice([0, 1, 1, 1, 2, 2, 3])
    made["projectile"] = {f"p{i}": striker(chance, made, step, i) for i in range(count)}
    # Friction and discs that strike each other are for scripts/random-scenes; here each strikes the beam.


def striker(chance: random.Random, made: dict, step: float, number: int) -> dict:
    mass, speed = chance.choice([0.2, 1.0, 5.0]), chance.uniform(0.3, 6.0)
    rigid, free = chance.random() < 0.4, chance.random() < 0.5
    at = [0.5, 0.25, 0.7][number] + chance.uniform(-0.1, 0.1)
    # Towards the beam, half a radian to either side of its normal where it is straight.
    tilt = chance.uniform(-0.5, 0.5) + (math.atan2(0.6, 0.8) if made["title"].endswith("slanted") else 0.0)
    made = {
        "kind": "rigid" if rigid else "elastic", "mass": mass,
        "velocity": [speed * math.sin(tilt), -speed * math.cos(tilt)],
        "strikes": f"b@{at:.4f}", "standoff": chance.choice([0.0, 1e-3, 5e-3]),
    }
    if rigid:
        made["restitution"] = chance.choice([0, 0.3, 0.7, 1])
        if not free and chance.random() < 0.5:
            made["local_mass"] = 0.3 * mass
    else:
        made |= law(chance, mass, speed, step)
    if free:
        # Beside its line of flight a curved beam may be nearer to a disc than along it.
        made |= {"contact": "surface", "radius": chance.choice([0.02, 0.05]), "standoff": chance.choice([5e-3, 1e-2])}
        if rigid and chance.random() < 0.5:
            made["friction"] = chance.choice([0.2, 0.6])
        if chance.random() < 0.3:
            made["spin"] = chance.uniform(-50, 50)
    return made


def law(chance: random.Random, mass: float, speed: float, step: float) -> dict:
    """A law of contact so soft that the mass alone would stay for 20 to 60 steps, pi sqrt(m / k); a light beam makes it shorter."""
    stiffness = mass * (math.pi / (chance.uniform(20, 60) * step)) ** 2
    deep = speed * math.sqrt(mass / stiffness)
    kind = chance.choice(["linear", "linear", "hertz", "crush", "table", "lossy"])
    if kind == "hertz":
        return {"law": "hertz", "hertz_stiffness": stiffness / math.sqrt(deep)}
    if kind == "crush":
        return {"stiffness": stiffness, "unloading_stiffness": 3 * stiffness}
    if kind == "table":
        forces = [0, 0.3 * stiffness * deep, stiffness * deep, 3 * stiffness * deep]
        return {"law": "table", "penetrations": [0, 0.5 * deep, deep, 2 * deep], "forces": forces}
    if kind == "lossy":
        return {"stiffness": stiffness, "dissipation": chance.uniform(0.1, 0.5) / speed}
    return {"stiffness": stiffness}


def surroundings(chance: random.Random, made: dict) -> None:
    """A floor that the beam or discs may reach, a motion of the ground, an initial motion of what is free."""
    if "support" not in made and chance.random() < 0.6:
        made["initial"] = {"velocity": [chance.uniform(-1, 1), chance.uniform(-2, 0)], "spin": chance.uniform(-3, 3)}
    if chance.random() < 0.2 and any(p.get("contact") for p in made["projectile"].values()):
        half = made["section"]["s"]["depth"] / 2
        low = min(y for b in made["beam"].values() for _, y in b["points"]) - half - chance.choice([1e-3, 5e-3]) - 0.15 * (
            2.0 if made["beam"]["b"]["curve"] == "spline" else 0.0)
        made["obstacle"] = {"floor": {"kind": "half-plane", "point": [0, low], "normal": [0, 1]}}
        rigid = chance.random() < 0.4
        made["contact"] = {"ground": {"between": ["b", "floor"]} | (
            {"law": "rigid", "restitution": chance.choice([0, 0.5])} if rigid else {"stiffness": 1e7})}
    holds = [s for s in made.get("support", {}).values() if s["kind"] in ("clamp", "pin")]
    if holds and chance.random() < 0.15:
        shape = chance.choice([{"kind": "harmonic", "frequency": 40}, {"kind": "half-sine", "duration": 4e-3}])
        motion = {"displacement": [0, chance.uniform(-2e-3, 2e-3)], "function": shape}
        for support_ in made["support"].values():
            support_["motion"] = motion


def loads(chance: random.Random, made: dict, step: float) -> None:
    made["load"] = {}
    if chance.random() < 0.4:
        made["load"]["weight"] = {"kind": "gravity", "acceleration": [0, -9.81]}
    if chance.random() < 0.35:
        force = [chance.uniform(-200, 200), chance.uniform(-500, 500)]
        made["load"]["push"] = {"kind": "point", "at": "b@0.4", "force": force} | course(chance, step)
        if chance.random() < 0.3:
            made["load"]["push"]["moment"] = chance.uniform(-50, 50)
    if chance.random() < 0.25:
        stretch = chance.choice([["start", "end"], [0.2, 0.6]])
        made["load"]["along"] = {
            "kind": "distributed", "on": "b", "stretch": stretch, "force": [0, chance.uniform(-500, 0)],
            "force_end": [0, chance.uniform(-500, 0)],
        } | course(chance, step)


def course(chance: random.Random, step: float) -> dict:
    """How a load goes on over time; none is constant."""
    long = chance.choice([23.3, 60, 111]) * step
    shape = chance.choice([
        None, None, {"kind": "step", "at": long}, {"kind": "ramp", "duration": long}, {"kind": "half-sine", "duration": long},
        {"kind": "triangle", "duration": long}, {"kind": "harmonic", "frequency": 0.5 / long, "phase": 0.7},
        {"kind": "table", "times": [0, long, 2 * long], "values": [0, 1, 0.5]},
    ])
    made = {"function": shape} if shape else {}
    if chance.random() < 0.2:
        made["until"] = 71.5 * step
    return made


def settings(chance: random.Random, made: dict, step: float) -> None:
    steps = chance.choice([120, 250, 400])
    made["time"] = {"end": steps * step, "step": step}
    held = "support" in made and all("motion" not in s for s in made["support"].values())
    if held and made["load"] and chance.random() < 0.35:
        made["time"]["start"] = "static"
    # What a stop holds, or a joint that may tear, can be a mechanism, whose modes are not damped.
    stands = all(s["kind"] != "stop" for s in made.get("support", {}).values()) and all("strength" not in j for j in made.get("joint", {}).values())
    if held and stands and chance.random() < 0.15:
        made["damping"] = {"modal": 0.02, "modes": 3}
    points = [f"{name}.{place}" for name in made["beam"] for place in ("start", "mid", "end")] + ["b@0.35", "b@0.4"]
    made["record"] = {"every": chance.choice([1, 1, 1, 1, 3]), "points": points, "shapes": 64}
