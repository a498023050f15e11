"""Contacts: forces against their laws and the rows, impulses against the sums of columns, intervals against gaps."""

import math

from . import forces, laws
from .results import CLOSED, SAME, Run, contacts, differs, events, outside, partner

# Between rows the force follows a cubic through gaps; rates by differences are off by the square of a step in the contact of some
# dozen steps, (pi / 12)^2 / 6, about 1 %; what the beam does beside it adds as much again.
BETWEEN_ROWS = 0.03
# What crushes remembers how deep it was at ends of steps. In a contact of four steps the deepest one is short of the peak by 1 - cos(pi / 8).
BETWEEN_STEPS = 0.08
# Rigid impacts are located: what is left is the resolution of gaps.
LOCATED = 1e-6
# Slower approaches, beside the fastest, stick (docs/book/src/theory/4-impacts.md), here with what locating them leaves open.
STICKS = 2e-6


def check(run: Run) -> list[str]:
    out = []
    for name, contact in contacts(run):
        rigid = "impulse_total" in contact
        found = sums(run, name, contact) + places_in_time(run, name, contact)
        found += (blows if rigid else presses)(run, name, contact)
        out += [f"contact {name}: {line}" for line in found]
    return out + first_touch(run) + touching(run) + log_rows(run)


def sums(run: Run, name: str, contact: dict) -> list[str]:
    """Impulses of impacts and intervals add up to those of the column."""
    total, column = math.fsum(event["impulse"] for event in events(contact)), run.total(f"contact.{name}.impulse")
    scale = max(math.fsum(abs(x) for x in run.column(f"contact.{name}.impulse")), 1e-12)
    out = differs("sum of impulses", total, column, CLOSED * scale)
    if "impulse_total" in contact:
        out += differs("impulse_total", contact["impulse_total"], column, CLOSED * scale)
        out += differs("impact_count", contact["impact_count"], len(contact["impacts"]), 0)
    return out


def places_in_time(run: Run, name: str, contact: dict) -> list[str]:
    """Everything happens within the run, intervals one after the other, in the place where the beam is."""
    out, end, before = [], run.time[-1], 0.0
    for one in contact["intervals"]:
        last = end if one["end"] is None else one["end"]
        out += outside("start of an interval", one["start"], before - SAME * end, last)
        out += outside("end of an interval", last, one["start"], end * (1 + SAME))
        before = last
    out += [line for one in contact.get("impacts", []) for line in outside("time of an impact", one["time"], 0, end * (1 + SAME))]
    longest = max(forces.lengths(run).values())
    out += [line for event in events(contact) for line in outside("place of an event", event["place"]["s"], -SAME, longest * (1 + SAME))]
    for event in events(contact):
        out += ratio(event)
    return out


def ratio(event: dict) -> list[str]:
    """Restitution is separation over approach, or it says why there is none."""
    told = event.get("restitution")
    if told is None:
        return [] if event.get("restitution_why") else [f"no restitution and no reason for it at {event.get('time', event.get('start'))} s"]
    right = event["separation_velocity"] / event["approach_velocity"]
    # Below 1e-8 it is told as zero: that is round-off of a plastic impact.
    return differs("restitution", told, right, 1e-8 if told == 0 else CLOSED * max(1.0, abs(right)))


def presses(run: Run, name: str, contact: dict) -> list[str]:
    """A smooth contact."""
    out, peak, intervals = [], contact["peak_force"], contact["intervals"]
    if not intervals:
        never = peak["value"] is None and contact.get("duration") is None
        return [] if never else [f"never closed, but peak force {peak} and duration {contact.get('duration')}"]
    largest = max(one["peak_force"]["value"] for one in intervals)
    out += differs("peak_force against the largest of its intervals", peak["value"], largest, SAME * largest)
    first = intervals[0]
    if first["end"] is not None:
        out += differs("duration", contact["duration"], first["end"] - first["start"], SAME * run.time[-1])
    out += law_at_rows(run, name) + peak_between(run, name, contact) + crushed(run, name, contact)
    if run.every == 1:
        out += closed_where_pressed(run, name, intervals) + force_over_time(run, name, intervals)
    return out


def law_at_rows(run: Run, name: str) -> list[str]:
    """The force of a row is that of its gap, where nothing is lost and one point touches."""
    law, force, gap = laws.of(run.scene, name), run.column(f"contact.{name}.force"), run.column(f"contact.{name}.gap")
    if laws.loses(law) or name not in run.scene["projectile"]:
        return []
    scale = max(force)
    for k, (f, g) in enumerate(zip(force, gap)):
        found = differs(f"force at {run.time[k]:.6g} s against its law", f, laws.elastic_force(law, -g), 1e-7 * scale)
        if found:
            return found
    return []


def crushed(run: Run, name: str, contact: dict) -> list[str]:
    """What stays pushed in: a law that comes back along a steeper line leaves the depth at the peak less by peak over that stiffness. On
    a guided projectile the place is always the same; a disc may leave several."""
    law, told = laws.of(run.scene, name), contact.get("permanent_penetration")
    if "unloading_stiffness" not in law:
        return [] if told is None else [f"permanent_penetration {told} under a law that does not crush"]
    peak = contact["peak_force"]["value"]
    right = peak / law["stiffness"] - peak / law["unloading_stiffness"]
    if forces.is_guided(law):
        return outside("permanent_penetration", told, (1 - BETWEEN_STEPS) * right, (1 + BETWEEN_ROWS) * right)
    return outside("permanent_penetration", told, 0, right * (1 + BETWEEN_ROWS))


def peak_between(run: Run, name: str, contact: dict) -> list[str]:
    """The peak is at least the largest of the rows, and at most what the law gives for the deepest state between rows."""
    force, peak = run.column(f"contact.{name}.force"), contact["peak_force"]
    low = max(force) * (1 - SAME)
    if run.every > 1:
        return outside("peak_force against the rows", peak["value"], low, math.inf)
    if name not in run.scene["projectile"]:
        return outside("peak_force against the rows", peak["value"], low, max(force) + steepest(run.time, force))
    law = laws.of(run.scene, name)
    depths = [-gap for gap in run.column(f"contact.{name}.gap")]
    high = laws.elastic_force(law, laws.deepest(run.time, depths))
    if "dissipation" in law:
        fastest = max(abs(one["approach_velocity"]) for one in contact["intervals"])
        fastest = max([fastest] + [abs(r) for r, d in zip(laws.rates(run.time, depths), depths) if d > 0])
        high *= 1 + law["dissipation"] * fastest
    few = min(one["steps"] for one in contact["intervals"]) < 8
    slack = steepest(run.time, force) if few or "dissipation" in law else BETWEEN_ROWS * high + sharpest(force)
    high = min(high + slack, max(force) + steepest(run.time, force)) if "dissipation" in law else high + slack
    return outside("peak_force against rows and law", peak["value"], low, high)


def sharpest(force: list[float]) -> float:
    """What the crest of a parabola through three rows has beyond them, at the largest row: an eighth of the second difference at most."""
    k = min(max(force.index(max(force)), 1), len(force) - 2)
    return abs(force[k - 1] - 2 * force[k] + force[k + 1]) / 8


def steepest(times: list[float], force: list[float]) -> float:
    """The largest change of a force from one row to the next: what it may reach beyond its rows."""
    return max((abs(b - a) for a, b in zip(force, force[1:])), default=0.0)


def closed_where_pressed(run: Run, name: str, intervals: list[dict]) -> list[str]:
    """Rows with a negative gap lie in intervals; in an interval the gap is open for less than a step only."""
    end, gap, force = run.time[-1], run.column(f"contact.{name}.gap"), run.column(f"contact.{name}.force")
    spans = [(one["start"], end if one["end"] is None else one["end"]) for one in intervals]
    out, slack = [], 1e-6 * run.step
    for k, t in enumerate(run.time):
        inside = any(a - slack <= t <= b + slack for a, b in spans)
        if force[k] > 1e-9 * max(force) and not inside:
            out.append(f"presses with {force[k]:.4g} N at {t:.6g} s, in no interval")
            break
    for a, b in spans:
        opened = [t for t, g in zip(run.time, gap) if a + slack < t < b - slack and g > 1e-12]
        longest = longest_row(opened, run.step)
        if longest > 2 * run.step:
            out.append(f"open for {longest:.3g} s within the interval from {a:.6g} s to {b:.6g} s")
    return out


def longest_row(times: list[float], step: float) -> float:
    """The longest stretch of times that follow each other step by step."""
    longest, begun = 0.0, None
    for k, t in enumerate(times):
        if begun is None or t - times[k - 1] > 1.01 * step:
            begun = t
        longest = max(longest, t - begun)
    return longest


def force_over_time(run: Run, name: str, intervals: list[dict]) -> list[str]:
    """The integral of the force is the impulse. Between rows the force is taken to lie between those of the rows; at either end of an
    interval, and where it turns, it may be larger by what the next row adds."""
    force, told = run.column(f"contact.{name}.force"), math.fsum(one["impulse"] for one in intervals)
    steps = list(zip(run.time, run.time[1:], force, force[1:]))
    integral = math.fsum((b - a) * (f + g) / 2 for a, b, f, g in steps)
    allowed = math.fsum((b - a) * abs(g - f) / 2 for a, b, f, g in steps)
    return differs("impulse against the integral of the force", told, integral, allowed + CLOSED * abs(told))


def blows(run: Run, name: str, contact: dict) -> list[str]:
    """A rigid contact."""
    law, out = laws.of(run.scene, name), []
    depth = max(0.0, -min(run.column(f"contact.{name}.gap")))
    size = contact["penetration"]["value"]
    out += outside("penetration against the rows", size, depth * (1 - CLOSED) - 1e-15, LOCATED + depth)
    if run.summary["accumulated_steps"] == 0:
        out += outside("penetration of located impacts", size, 0, LOCATED)
    friction = law.get("friction", 0.0)
    for event in events(contact):
        along = abs(event.get("tangential_impulse") or 0.0)
        out += outside("impulse of friction", along, 0, friction * event["impulse"] * (1 + CLOSED) + 1e-12)
    return out + struck_back(run, contact["impacts"], law["restitution"])


def struck_back(run: Run, impacts: list[dict], coefficient: float) -> list[str]:
    """An impact of a single point has the coefficient of its law, where no law for shared or accumulated blows takes its place."""
    if run.summary["multiple_impacts"] or run.summary["accumulated_steps"]:
        return []
    fastest = max(event["approach_velocity"] for _, contact in contacts(run) for event in events(contact)) if impacts else 0.0
    plain = [
        one for one in impacts
        if one["approach_velocity"] > STICKS * fastest and not one["fallback_law"] and one["restitution"] is not None and one["points"] == 1
    ]
    return [line for one in plain for line in differs(f"restitution at {one['time']:.6g} s", one["restitution"], coefficient, 1e-6)]


def first_touch(run: Run) -> list[str]:
    """Where nothing but projectiles moves before the first touch, that is as fast as the flight."""
    scene = run.scene
    moves = scene["load"] or "initial" in scene or any("motion" in s for s in scene.get("support", {}).values())
    first = [(event.get("time", event.get("start")), name, event) for name, contact in contacts(run) for event in events(contact)]
    if moves or not first:
        return []
    _, name, event = min(first, key=lambda one: one[0])
    if name not in scene["projectile"]:
        return []
    one = scene["projectile"][name]
    speed, told = math.hypot(*one["velocity"]), abs(event["approach_velocity"])
    if forces.is_guided(one):
        return differs(f"contact {name}: approach_velocity of the first touch", told, speed, 1e-7 * speed)
    return outside(f"contact {name}: approach_velocity of the first touch", told, 0, speed * (1 + 1e-7))


def touching(run: Run) -> list[str]:
    """`still_touches` names the contacts that are closed at the end."""
    out = []
    for name, told in run.summary["projectile"].items():
        closed = [
            other for other, contact in contacts(run)
            if partner(contact, name) is not None and any(one["end"] is None for one in contact["intervals"])
        ]
        if sorted(told.get("still_touches", [])) != sorted(closed):
            out.append(f"projectile {name}: still_touches {told.get('still_touches')}, right {closed}")
    return out


def log_rows(run: Run) -> list[str]:
    """impacts.csv has as many rows as the summary has impacts and intervals, in the order of time."""
    lines = (run.folder / "impacts.csv").read_text().splitlines()
    column = lines[0].split(",").index("start_s")
    starts = [float(line.split(",")[column]) for line in lines[1:]]
    stops = sum(len(support.get("intervals", [])) for support in run.summary["support"].values())
    right = sum(len(events(contact)) for _, contact in contacts(run)) + stops
    out = differs("rows of impacts.csv", len(starts), right, 0)
    return out + (["impacts.csv is not in the order of time"] if starts != sorted(starts) else [])
