"""What a scene may have beside: shear-flexible beams, ropes, foundations, heat, and ground that shakes.

Each is drawn by a generator of its own, so that the scene of a seed stays what it was but for what is added.
"""

import math
import random

def add(seed: int, made: dict, step: float) -> None:
    """Adds to the scene of a seed what chance brings; half of the scenes stay as they are."""
    chance = random.Random(f"beside {seed}")
    if chance.random() < 0.5:
        return
    for part in (shear, rope, bed, heat, shake):
        if chance.random() < 0.35:
            part(chance, made, step)


def shear(chance: random.Random, made: dict, step: float) -> None:
    """Beams that shear, too; such beams yield with engineering strains only."""
    made["material"]["m"] |= {"poisson": 0.3}
    made["material"]["m"].pop("retardation", None)
    if "yield" in made["material"]["m"]:
        made["material"]["m"]["strain"] = "engineering"
    for beam in made["beam"].values():
        beam["theory"] = "shear"


def rope(chance: random.Random, made: dict, step: float) -> None:
    """A rope from the beam to an anchor above it, without slack or with some."""
    start = made["beam"]["b"]["points"][0]
    end = made["beam"]["b"]["points"][-1]
    top = [start[0] + 0.2 * (end[0] - start[0]), max(start[1], end[1]) + 0.8]
    made.setdefault("spring", {})["rope"] = {
        "between": ["b@0.35", top], "law": "tension", "stiffness": chance.choice([1e5, 1e6]),
        "slack": chance.choice([0.0, 1e-4, 1e-3]),
    }


def bed(chance: random.Random, made: dict, step: float) -> None:
    """An elastic bed along a part of the beam, which may be able to lift off."""
    made["foundation"] = {"bed": {"on": "b", "stiffness": chance.choice([1e5, 1e6])}}
    if chance.random() < 0.4:
        made["foundation"]["bed"]["law"] = "compression"


def heat(chance: random.Random, made: dict, step: float) -> None:
    """Heat over time along one beam, by a few kelvin; only elastic beams can be heated (E018)."""
    if "yield" in made["material"]["m"]:
        return
    made["material"]["m"]["expansion"] = 1.2e-5
    duration = chance.choice([60, 111]) * step
    made["load"]["heat"] = {
        "kind": "temperature", "on": "b", "change": chance.uniform(-10, 10), "function": {"kind": "ramp", "duration": duration},
    }


def shake(chance: random.Random, made: dict, step: float) -> None:
    """The ground shakes; motions of single supports and modes of damping are for other scenes."""
    if "support" not in made or any("motion" in one for one in made["support"].values()):
        return
    size, turn = chance.uniform(1, 20), chance.uniform(0, 2 * math.pi)
    made["load"]["quake"] = {
        "kind": "base", "acceleration": [size * math.cos(turn), size * math.sin(turn)],
        "function": {"kind": "harmonic", "frequency": 0.5 / (60 * step), "phase": 0.7},
    }
