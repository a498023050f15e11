"""Laws of contact as the scene gives them, and how deep a contact was between rows."""

import math


def of(scene: dict, name: str) -> dict:
    """What gives the law of a contact: its projectile, or a contact between other things."""
    return scene["projectile"].get(name) or scene["contact"][name]


def elastic_force(law: dict, depth: float) -> float:
    """The force on the way in, without losses; beyond its end a table goes on with its last slope."""
    if depth <= 0:
        return 0.0
    if law.get("law") == "hertz":
        return law["hertz_stiffness"] * depth**1.5
    if law.get("law") != "table":
        return law["stiffness"] * depth
    points = list(zip(law["penetrations"], law["forces"]))
    for (d0, f0), (d1, f1) in zip(points, points[1:]):
        if depth <= d1 or (d1, f1) == points[-1]:
            return f0 + (f1 - f0) * (depth - d0) / (d1 - d0)
    raise ValueError("a table of one row")


def loses(law: dict) -> bool:
    return "dissipation" in law or "unloading_stiffness" in law


def crest(h: float, first: float, first_rate: float, last: float, last_rate: float) -> float:
    """The largest value of the cubic through values and rates at the ends of a step."""
    # value = first + first_rate t + b t^2 + c t^3
    b = (3 * (last - first) / h - 2 * first_rate - last_rate) / h
    c = (first_rate + last_rate - 2 * (last - first) / h) / h**2
    value = lambda t: first + t * (first_rate + t * (b + t * c))
    inside = [t for t in roots(3 * c, 2 * b, first_rate) if 0 < t < h]
    return max([first, last] + [value(t) for t in inside])


def roots(a: float, b: float, c: float) -> list[float]:
    """Of a t^2 + b t + c."""
    if abs(a) <= 1e-14 * max(abs(b), abs(c)):
        return [-c / b] if b else []
    inside = b * b - 4 * a * c
    if inside < 0:
        return []
    q = -0.5 * (b + math.copysign(math.sqrt(inside), b))
    return [q / a] + ([c / q] if q else [])


def rates(times: list[float], values: list[float]) -> list[float]:
    """Rates at rows, by the parabola through neighbours; one-sided at ends."""
    out = []
    for k in range(len(values)):
        a, b = max(k - 1, 0), min(k + 1, len(values) - 1)
        gap = times[b] - times[a]
        out.append((values[b] - values[a]) / gap if gap > 0 else 0.0)
    return out


def deepest(times: list[float], depths: list[float]) -> float:
    """The largest depth of the cubics through rows."""
    slopes = rates(times, depths)
    steps = [k for k in range(len(times) - 1) if times[k + 1] > times[k]]
    return max((crest(times[k + 1] - times[k], depths[k], slopes[k], depths[k + 1], slopes[k + 1]) for k in steps), default=0.0)
