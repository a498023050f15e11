"""Single touches: when they begin, how fast, how hard, and where, against the rows around them."""

import math

from . import forces, laws
from .contacts import BETWEEN_ROWS, sharpest, steepest
from .instants import cubic, row_at
from .results import CLOSED, SAME, Run, contacts, differs, outside


def check(run: Run) -> list[str]:
    out = []
    for name, contact in contacts(run):
        found = []
        if name in run.scene["projectile"] and forces.is_guided(run.scene["projectile"][name]):
            found += places(run, name, contact)
        if "impulse_total" in contact:
            found += impacts(run, name, contact) + first_blow(run, name, contact)
        elif run.every == 1 and name in run.scene["projectile"]:
            # Of many points the rows have the sum of forces and the smallest gap, which is another's from row to row.
            found += beginnings(run, name, contact) + peaks(run, name, contact)
        out += [f"contact {name}: {line}" for line in found]
    return out


def places(run: Run, name: str, contact: dict) -> list[str]:
    """A guided projectile always touches the point that it strikes, at rest and moved."""
    strikes, out = run.scene["projectile"][name]["strikes"], []
    beam, share = strikes.split("@")
    right = float(share) * forces.lengths(run)[beam]
    events = [(one, "place", one["start"]) for one in contact["intervals"]]
    events += [(one, "place_end", one["end"]) for one in contact["intervals"] if one["end"] is not None]
    events += [(one, "place", one["time"]) for one in contact.get("impacts", [])]
    for event, key, time in events:
        out += differs(f"{key} at {time:.6g} s", event[key]["s"], right, CLOSED * right)
        if run.has_rows_of_all_parts() and run.scene["beam"][beam]["curve"] == "polyline":
            out += position(run, strikes, time, event[key]["position"])
    return out


def position(run: Run, point: str, time: float, told: list[float]) -> list[str]:
    """Where a point of a straight beam is: where it was and what the cubics of its displacement add."""
    beam, share = point.split("@")
    start, end = run.scene["beam"][beam]["points"]
    at, out = row_at(run, time), []
    for k in (0, 1):
        u, v = run.column(f"point.{point}.displacement_{k + 1}"), run.column(f"point.{point}.velocity_{k + 1}")
        last = at + 1 == len(u) or run.time[at + 1] == run.time[at]
        moved = u[at] if last else cubic(run.time, u, v, at, time)
        # Within a step the place is taken along the increment of the step.
        allowed = 1e-9 + (0.0 if last else abs(u[at + 1] - u[at]) + run.step * abs(v[at + 1] - v[at]))
        out += differs(f"position {k + 1} at {time:.6g} s", told[k], start[k] + float(share) * (end[k] - start[k]) + moved, allowed)
    return out


def impacts(run: Run, name: str, contact: dict) -> list[str]:
    """Every located impact lies between two rows that have its impulse."""
    if run.summary["accumulated_steps"]:
        return []
    column, out, short = run.column(f"contact.{name}.impulse"), [], 1e-3 * run.step
    # What rests takes its part of a blow, which is not told of the impact.
    resting = [(one["start"], one["end"] or math.inf) for one in contact["intervals"]]
    alone = [one for one in contact["impacts"] if not any(a <= one["time"] <= b for a, b in resting)]
    parts = [k for k in range(1, len(run.time)) if run.time[k] - run.time[k - 1] < short]
    for one in alone:
        near = [k for k in parts if run.time[k - 1] <= one["time"] <= run.time[k]]
        right = max((column[k] for k in near), default=math.nan)
        if not near:
            out.append(f"impact at {one['time']:.9g} s lies between no two rows of an impact")
        else:
            out += differs(f"impulse of the impact at {one['time']:.6g} s", one["impulse"], right, 1e-6 * right + 1e-12)
    return out


def first_blow(run: Run, name: str, contact: dict) -> list[str]:
    """The first blow of a guided projectile on a structure at rest: (1 + e) v over the sum of one over the masses."""
    scene, told = run.scene, contact.get("effective_mass")
    moves = scene["load"] or "initial" in scene or any("motion" in s for s in scene.get("support", {}).values())
    alone = len(scene["projectile"]) == 1 and "obstacle" not in scene
    one = scene["projectile"].get(name)
    if moves or not alone or not one or not forces.is_guided(one) or not contact["impacts"] or not told:
        return []
    blow = contact["impacts"][0]
    right = (1 + one["restitution"]) * math.hypot(*one["velocity"]) / (1 / one["mass"] + 1 / told)
    # The effective mass is that at one instant; the part of a step in which the impact lies is 1e-6 of it long.
    return differs("impulse of the first blow by the effective mass", blow["impulse"], right, 1e-4 * right)


def beginnings(run: Run, name: str, contact: dict) -> list[str]:
    """An interval begins where the gap closes, as fast as it did so over the step before; a gap that had not been open for three steps
    says nothing of it."""
    gap, out = run.column(f"contact.{name}.gap"), []
    # What has crushed, or lost force on its way out, is struck again before the gap closes.
    again = not laws.loses(laws.of(run.scene, name))
    for one in contact["intervals"] if again else contact["intervals"][:1]:
        k = row_at(run, one["start"])
        if k < 3 or k + 1 >= len(gap) or run.summary["step_cuts"]:
            continue
        if one["start"] - run.time[k] > 1e-9 * run.step and (gap[k] < -1e-12 or gap[k + 1] > 1e-12) and one["steps"] > 2:
            out.append(f"begins at {one['start']:.6g} s, where the gap goes from {gap[k]:.3g} m to {gap[k + 1]:.3g} m")
        if "changes by more than itself" in (one.get("restitution_why") or ""):
            continue  # the run says itself that the step does not see it
        rates = [(gap[j - 1] - gap[j]) / (run.time[j] - run.time[j - 1]) for j in (k - 2, k - 1, k) if run.time[j] > run.time[j - 1]]
        if len(rates) == 3 and min(gap[k - 3 : k + 1]) > -1e-12:
            swing = max(rates) - min(rates)
            # It goes on for up to a step as it changed over the three before; what oscillates faster may double that.
            out += differs(f"approach_velocity at {one['start']:.6g} s", one["approach_velocity"], rates[-1], 4 * swing + 0.02 * abs(rates[-1]))
    return out


def peaks(run: Run, name: str, contact: dict) -> list[str]:
    """The peak of every interval is no less than its rows, no more than its law allows beside them, and lies beside the largest of them."""
    force, out = run.column(f"contact.{name}.force"), []
    for one in contact["intervals"]:
        end, peak = one["end"] if one["end"] is not None else run.time[-1], one["peak_force"]
        inside = [k for k, t in enumerate(run.time) if one["start"] <= t <= end]
        if not inside:
            continue
        a, b = max(inside[0] - 1, 0), min(inside[-1] + 2, len(force))
        own = force[a:b]
        most = max(force[k] for k in inside)
        slack = steepest(run.time[a:b], own) if one["steps"] < 8 or len(own) < 3 else 2 * sharpest(own) + BETWEEN_ROWS * most
        out += outside(f"peak_force from {one['start']:.6g} s on", peak["value"], most * (1 - SAME), most + slack + SAME)
        out += outside(f"time of the peak from {one['start']:.6g} s on", peak["time"], one["start"] * (1 - SAME), end * (1 + SAME))
        k = row_at(run, peak["time"])
        beside = max(force[k : k + 2])
        out += outside(f"rows beside the peak at {peak['time']:.6g} s", beside, peak["value"] - slack - BETWEEN_ROWS * most, math.inf)
    if contact["intervals"]:
        first = min(contact["intervals"], key=lambda one: -one["peak_force"]["value"])
        out += differs("time of peak_force", contact["peak_force"]["time"], first["peak_force"]["time"], SAME * run.time[-1])
    return out
