"""Balances of energy and momentum, summed again from the rows of the history."""

import math

from . import forces
from .results import CLOSED, SAME, Run, contacts, differs, events, outside, partner

# An energy of strains of 1e-17 of a beam of steel, J: round-off of one that stands still.
NOTHING = 1e-24


def check(run: Run) -> list[str]:
    return forces.check(run) + rows(run) + energy_parts(run) + energy_balance(run) + losses(run) + momentum(run) + turning(run) + projectiles(run)


def rows(run: Run) -> list[str]:
    """Rows lie in the order of time within the run, and no number of theirs is missing."""
    told, end = run.summary, run.scene["time"]["end"]
    out = differs("time of the last row", told["time"], run.time[-1], SAME * end)
    if told["status"] == "completed":
        out += differs("time of the last row", run.time[-1], end, SAME * end)
    out += differs("number of rows", told["rows"], len(run.time), 0)
    if any(b < a for a, b in zip(run.time, run.time[1:])):
        out.append("times of rows go back")
    missing = [name for name, values in run.columns.items() if not all(map(math.isfinite, values))]
    return out + [f"column {name} has numbers that are missing" for name in missing]


def energy_parts(run: Run) -> list[str]:
    """In every row the parts add up to the total."""
    scale, out = run.energy_scale(), []
    parts = [
        ("energy.kinetic", ["energy.kinetic_beams", "energy.kinetic_projectiles"]),
        ("energy.strain", ["energy.strain_axial", "energy.strain_bending", "energy.strain_shear"]),
        ("energy.total", ["energy.kinetic", "energy.strain", "energy.contact", "energy.springs", "energy.hardening"]),
    ]
    for whole, names in parts:
        if whole == "energy.strain" and "yield" in run.scene["material"]["m"]:
            continue  # fibres store what they store, whether they are stretched or bent
        for k in range(len(run.time)):
            found = differs(f"{whole} at {run.time[k]:.6g} s", run.column(whole)[k], sum(run.column(n)[k] for n in names), CLOSED * scale)
            out += found
            if found:
                break
    return out + kinetic(run, scale)


def kinetic(run: Run, scale: float) -> list[str]:
    """Kinetic energy of the projectiles from their masses and velocities, in every row."""
    for k in range(len(run.time)):
        right = math.fsum(kinetic_of(run, name, k) for name in run.scene["projectile"])
        told = run.column("energy.kinetic_projectiles")[k]
        if abs(told - right) > CLOSED * scale:
            return differs(f"energy.kinetic_projectiles at {run.time[k]:.6g} s", told, right, CLOSED * scale)
    return []


def kinetic_of(run: Run, name: str, row: int) -> float:
    """Of a projectile; a disc is solid."""
    one, v = run.scene["projectile"][name], run.pair(f"projectile.{name}.velocity", row)
    turning = 0.5 * one["mass"] * one.get("radius", 0.0) ** 2
    spin = run.column(f"projectile.{name}.spin")[row]
    return 0.5 * one["mass"] * (v[0] ** 2 + v[1] ** 2) + 0.5 * turning * spin**2


def energy_balance(run: Run) -> list[str]:
    """What was there and what came in is what is there and what was lost, in every row; and the summary tells the last one."""
    told, scale, out = run.summary["energy"], run.energy_scale(), []
    gone = ["loss_impacts", "loss_damping", "plastic", "failure"]
    start = run.column("energy.total")[0] + sum(run.column(f"energy.{name}")[0] for name in gone)
    for k in range(len(run.time)):
        given = run.column("energy.work_loads")[k] + run.column("energy.work_supports")[k]
        left = start + given - sum(run.column(f"energy.{name}")[k] for name in gone)
        found = differs(f"energy balance at {run.time[k]:.6g} s", run.column("energy.total")[k], left, CLOSED * max(scale, told["scale"]) + NOTHING)
        if found:
            out += found
            break
    out += differs("energy.initial", told["initial"], run.column("energy.total")[0], SAME * scale)
    out += differs("energy.final", told["final"], run.column("energy.total")[-1], SAME * scale)
    for name in ["work_loads", "work_supports", "loss_impacts", "loss_damping", "failure", "hardening", "plastic"]:
        right = run.column(f"energy.{name}")[-1] - (run.column("energy.plastic")[0] if name == "plastic" else 0.0)
        out += differs(f"energy.{name}", told[name], right, CLOSED * scale)
    return out + outside("energy.scale against the largest energy of a row", told["scale"], scale * (1 - SAME), math.inf)


def losses(run: Run) -> list[str]:
    """No loss comes back, and losses of contacts are the sums of those of their impacts and intervals."""
    out, scale = [], run.energy_scale()
    for name in ["energy.loss_impacts", "energy.loss_damping", "energy.plastic", "energy.failure"]:
        values = run.column(name)
        drop = max((a - b for a, b in zip(values, values[1:])), default=0.0)
        if drop > CLOSED * scale:
            out.append(f"{name} falls by {drop:.3e} J between two rows, of {scale:.3e} J")
    energy, lost = run.summary["energy"], {True: 0.0, False: 0.0}
    for name, contact in contacts(run):
        for event in events(contact):
            parts = event["energy"]
            total = sum(parts["given"]) + parts["lost"] + parts["stored"] + parts["scheme"]
            out += differs(f"contact {name}: energies of an event add up", total, 0.0, CLOSED * scale)
            lost["impulse_total" in contact] += parts["lost"]
    out += differs("energy.loss_contacts as the sum over smooth contacts", energy["loss_contacts"], lost[False], CLOSED * scale)
    return out + differs("energy.loss_impacts as the sum over rigid contacts", energy["loss_impacts"], lost[True], CLOSED * scale)


def momentum(run: Run) -> list[str]:
    """The change of linear momentum is the impulse of supports, obstacles and loads. Damping by mass and of modes
    holds the structure against the ground, and so do ropes and beds, of which no column has the mean over a step."""
    if run.scene["material"]["m"].get("mass_damping") or "damping" in run.scene or forces.held_by_springs(run.scene):
        return []
    out, loads, unsure = [], forces.load_impulse(run), forces.weight_error(run)
    for k in (0, 1):
        outer = [
            run.over_time(f"support.{name}.force_{k + 1}") + run.total(f"support.{name}.impulse_{k + 1}")
            for name in run.summary["support"]
        ]
        column = run.column(f"momentum.linear_{k + 1}")
        scale = max(run.summary["momentum"]["linear_scale"], run.largest(f"momentum.linear_{k + 1}"))
        out += differs(f"change of linear momentum {k + 1}", column[-1] - column[0], math.fsum(outer) + loads[k], CLOSED * scale + unsure)
    return out


def turning(run: Run) -> list[str]:
    """The change of angular momentum about the origin is that of the supports, where they stand still and nothing else acts: guided
    projectiles have a guide that takes couples, and loads and springs to the ground have places of their own."""
    scene = run.scene
    held = scene.get("support", {})
    fixed = all(one["kind"] in ("clamp", "pin") and "motion" not in one for one in held.values())
    guided = any(forces.is_guided(one) for one in scene["projectile"].values())
    damped = scene["material"]["m"].get("mass_damping") or "damping" in scene
    if not fixed or guided or damped or scene["load"] or "obstacle" in scene or forces.held_by_springs(scene):
        return []
    outer = 0.0
    for name, one in held.items():
        x, y = end_of(scene, one["at"])
        given = [run.over_time(f"support.{name}.force_{k}") + run.total(f"support.{name}.impulse_{k}") for k in (1, 2)]
        outer += x * given[1] - y * given[0] + run.over_time(f"support.{name}.moment") + run.total(f"support.{name}.impulse_moment")
    column = run.column("momentum.angular")
    scale = max(run.summary["momentum"]["angular_scale"], run.largest("momentum.angular"))
    return differs("change of angular momentum", column[-1] - column[0], outer, CLOSED * scale)


def end_of(scene: dict, at: str) -> list[float]:
    """Where an end of a beam lies."""
    beam, place = at.split(".")
    return scene["beam"][beam]["points"][0 if place == "start" else -1]


def projectiles(run: Run) -> list[str]:
    out = []
    for name, one in run.scene["projectile"].items():
        told = run.summary["projectile"][name]
        last = run.pair(f"projectile.{name}.velocity", -1)
        speed = math.hypot(*one["velocity"])
        for k in (0, 1):
            out += differs(f"projectile {name}: velocity_final {k + 1}", told["velocity_final"][k], last[k], SAME * speed)
        out += differs(f"projectile {name}: spin_final", told["spin_final"], run.column(f"projectile.{name}.spin")[-1], SAME * 100)
        out += given(run, name, one, told)
    return out


def given(run: Run, name: str, one: dict, told: dict) -> list[str]:
    """Impulse and energy that a projectile gave are what it lost, its weight apart."""
    weight, span, out = forces.weight_on(run, one), run.time[-1], []
    last, d = run.pair(f"projectile.{name}.velocity", -1), forces.direction(one)
    shaken = forces.shaken(run, one)
    lost = [one["mass"] * (one["velocity"][k] - last[k]) + weight[k] * span + shaken[k] for k in (0, 1)]
    scale = one["mass"] * math.hypot(*one["velocity"]) + math.hypot(*weight) * span + math.hypot(*shaken)
    out += differs(f"projectile {name}: momentum_transferred", told["momentum_transferred"], lost[0] * d[0] + lost[1] * d[1], CLOSED * scale)
    moved = [run.column(f"projectile.{name}.position_{k}")[-1] - run.column(f"projectile.{name}.position_{k}")[0] for k in (1, 2)]
    fell = weight[0] * moved[0] + weight[1] * moved[1]
    energy = kinetic_of(run, name, 0) - kinetic_of(run, name, -1) + fell
    scale = max(run.energy_scale(), abs(fell))
    if "quake" not in run.scene["load"]:  # the work of inertia on a projectile has no column
        out += differs(f"projectile {name}: energy_given", told["energy_given"], energy, CLOSED * scale)
    others = math.fsum(
        event["energy"]["given"][1 - side]
        for _, contact in contacts(run)
        if (side := partner(contact, name)) is not None
        for event in events(contact)
    )
    if forces.is_guided(one):
        own = [other for other, contact in contacts(run) if partner(contact, name) is not None]
        impulse = math.fsum(run.total(f"contact.{other}.impulse") for other in own)
        what = f"projectile {name}: momentum_transferred as impulse of its contact"
        out += differs(what, told["momentum_transferred"], impulse, CLOSED * max(impulse, 1e-9))
    return out + differs(f"projectile {name}: energy_received_by_others", told["energy_received_by_others"], others, CLOSED * scale)
