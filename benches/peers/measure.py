"""Runs the cases in turns and prints the tables of docs/performance.md: `run` starts it, `run --quick` with three rounds instead of nine.

Each measurement is a process of its own; the programs take turns, and ratios within a round are compared, of which the
median is printed. Times are user time in the solver.
"""

import json
import os
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
PERCUSS = [os.path.join(HERE, "../../target/release/examples/peer")]
EXUDYN = [sys.executable, os.path.join(HERE, "exudyn_case.py")]
OPENSEES = [sys.executable, os.path.join(HERE, "opensees_case.py")]
PROGRAMS = {"Percuss": PERCUSS, "Exudyn": EXUDYN, "OpenSees": OPENSEES}
# Least user time of a measurement [s]: short runs are repeated in one process.
LEAST = 0.3
# Largest error of peak force and deflection, or of the energy of a free beam.
PEAKS, ENERGY = 0.0035, 0.01
# Steps of the searches [s], the longest first.
STEPS = [5e-3, 4e-3, 3e-3, 2.5e-3, 2e-3, 1.5e-3, 1.25e-3, 1e-3, 7.5e-4, 5e-4, 4e-4, 3e-4, 2.5e-4, 2e-4, 1.5e-4, 1e-4, 5e-5, 2e-5, 1e-5]

# Comparison at one step: the cheapest settings with which the other programs solve it as well.
SAME_STEP = {
    "Percuss": {},
    "Exudyn": {"order": 2},
    "OpenSees": {"algorithm": ["ModifiedNewton"]},
}
# Settings tried in the searches.
IMPLICIT = [{"order": 2, "tolerance": 1e-4}, {"order": 0, "tolerance": 1e-4}]
EXPLICIT = [{"order": order, "solver": s} for s in ("RK33", "RK44", "VelocityVerlet") for order in (0, 2)]
NEWMARK = ["Newmark", 0.5, 0.25]
SETTINGS = {
    "Percuss": [{}],
    "Exudyn": IMPLICIT + EXPLICIT,
    "OpenSees": [
        {"algorithm": ["ModifiedNewton"], "integrator": NEWMARK, "tolerance": 1e-5},
        {"algorithm": ["Newton"], "integrator": NEWMARK, "tolerance": 1e-5},
        {"algorithm": ["Linear"], "integrator": NEWMARK},
        {"algorithm": ["ModifiedNewton"], "integrator": ["HHT", 0.9], "tolerance": 1e-5},
        {"algorithm": ["Linear", "-factorOnce"], "integrator": ["NewmarkExplicit", 0.5]},
    ],
}
MESHES = [4, 6, 8, 12, 16, 24]
FINE = {"elements": 96, "step": 2e-5, "end": 0.15, "free": False}


def answer(program, case):
    """The answer of a program to a case; None if it crashed or took too long."""
    command = PROGRAMS[program] + [json.dumps(case)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=case.get("patience", 300), cwd=HERE)
    except subprocess.TimeoutExpired:
        return None
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    return json.loads(lines[-1]) if lines else None


def repeats(program, case):
    """Number of repetitions of a case in one process."""
    first = answer(program, case)
    return max(1, min(200, round(LEAST / max(first["user"], 1e-4))))


def in_turns(cases, rounds):
    """User time of one run of each program's case in each round [s]."""
    cases = {p: case | {"repeat": repeats(p, case)} for p, case in cases.items()}
    times = {p: [] for p in cases}
    for _ in range(rounds):
        for program, case in cases.items():
            times[program].append(answer(program, case)["user"] / case["repeat"])
    return times


def ratio(times, program):
    """Time relative to Percuss: the median over rounds, and the range of the middle half."""
    all_of_them = sorted(a / b for a, b in zip(times[program], times["Percuss"]))
    n = len(all_of_them)
    low, high = all_of_them[n // 4], all_of_them[n - 1 - n // 4]
    return f"{statistics.median(all_of_them):.1f} ({low:.1f} to {high:.1f})"


def table(head, rows):
    """Prints a table of Markdown."""
    for row in [head, ["---"] * len(head), *rows]:
        print("| " + " | ".join(row) + " |", flush=True)


def same_step(rounds):
    """Microseconds per step on 6, 60 and 600 elements, clamped."""
    print("\nSteps of 1e-4 s, clamped, everything recorded: microseconds of user time a step (median)\n")
    rows = []
    for elements, end in ((6, 0.15), (60, 0.15), (600, 0.03)):
        base = {"elements": elements, "step": 1e-4, "end": end, "free": False}
        cases = {p: base | {"options": options} for p, options in SAME_STEP.items()}
        times = in_turns(cases, rounds)
        steps = round(end / 1e-4)
        row = [str(elements)] + [f"{statistics.median(times[p]) / steps * 1e6:.3g}" for p in PROGRAMS]
        rows.append(row + [ratio(times, p) for p in ("Exudyn", "OpenSees")])
    table(["elements", *PROGRAMS, "Exudyn / Percuss", "OpenSees / Percuss"], rows)


def error(found, reference):
    """The larger of the errors of peak force and deflection; infinite if the run did not finish."""
    if not found or not found["finished"]:
        return float("inf")
    return max(abs(found[key] / reference[key] - 1.0) for key in ("f_max", "u_max"))


def holds(program, case, reference):
    """The error of a case if it is small enough also with a step four fifths as long, so that it is not accidental."""
    found = answer(program, case)
    if case["free"]:
        small = found and found["finished"] and found["energy_error"] <= ENERGY
        return (found, found["energy_error"]) if small else None
    shorter = answer(program, case | {"step": 0.8 * case["step"]})
    errors = [error(f, reference) for f in (found, shorter)]
    return (found, errors[0]) if max(errors) <= PEAKS else None


def cheapest(program, base, meshes, reference):
    """The cheapest case that is good enough, with its error."""
    best = None
    for elements in meshes:
        for options in SETTINGS[program]:
            for step in STEPS:
                case = base | {"elements": elements, "step": step, "options": options}
                # Settings with twice the cost of the best one so far are skipped.
                if best and base["end"] / step * 1e-6 > 2.0 * best[0]:
                    break
                held = holds(program, case, reference)
                if held:
                    user = min(held[0]["user"], answer(program, case)["user"])
                    if best is None or user < best[0]:
                        best = (user, case, held[1])
                    break
    return best


def describe(case):
    """A setting in words."""
    options = case["options"]
    words = [options.get("solver", "") or "/".join(map(str, options.get("integrator", []))), "/".join(options.get("algorithm", []))]
    words.append(f"order {options['order']}" if "order" in options else "")
    return ", ".join([f"{case['elements']} elements, {case['step'] * 1e3:g} ms"] + [w for w in words if w])


def equal_error(rounds, title, base, meshes, fine):
    """The cheapest setting of each program, in turns."""
    print(f"\n{title}\n")
    best = {}
    for program in PROGRAMS:
        reference = answer(program, fine | {"options": SAME_STEP[program]}) if fine else None
        best[program] = cheapest(program, base, meshes, reference)
        if reference:
            print(f"<!-- {program}: {reference['f_max']:.6g} N, {reference['u_max']:.6g} m -->", flush=True)
    times = in_turns({p: b[1] for p, b in best.items()}, rounds)
    rows = []
    for program, (_, case, miss) in best.items():
        beside = "1" if program == "Percuss" else ratio(times, program)
        rows.append([program, describe(case), f"{100 * miss:.2g} %", f"{statistics.median(times[program]) * 1e3:.3g}", beside])
    table(["", "cheapest setting", "error", "milliseconds", "beside Percuss"], rows)


def main():
    """All tables, or those named."""
    rounds = 3 if "--quick" in sys.argv else 9
    named = [a for a in sys.argv[1:] if not a.startswith("--")]
    base = {"end": 0.15, "free": False}
    if not named or "steps" in named:
        same_step(rounds)
    if not named or "mesh" in named:
        title = "6 elements, peak force and deflection within 0.35 % of short steps on the same mesh"
        equal_error(rounds, title, base, [6], FINE | {"elements": 6, "step": 1e-5})
    if not named or "error" in named:
        title = "Peak force and deflection within 0.35 % of a fine mesh and short steps, mesh and step free"
        equal_error(rounds, title, base, MESHES, FINE)
    if not named or "free" in named:
        title = "20 s without supports, 6 elements, energy within 1 %, steps of 5 ms at most"
        equal_error(rounds, title, {"end": 20.0, "free": True}, [6], None)


if __name__ == "__main__":
    main()
