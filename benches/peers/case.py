"""Input and output of the paper's elastic example for every program.

A case is a JSON object: elements, step and end [s], free (no supports), repeat (runs in one process), options (of the program).
An answer holds user (seconds of user time in the solver, all repetitions together), steps (of one run), finished, and either u_max [m]
and f_max [N] or, of a free beam, energy_error (largest change of the energy, relative).
"""

import json
import resource
import sys

LENGTH = 3.0  # m
YOUNG = 2e9  # Pa
AREA = 0.1  # m^2
INERTIA = 8.33e-5  # m^4
MASS_PER_LENGTH = 300.0  # kg/m
PROJECTILE = 500.0  # kg
SPRING = 7.5e5  # N/m
SPEED = 20.0  # m/s
STANDOFF = 0.2  # m
ENERGY = 0.5 * PROJECTILE * SPEED**2  # J
SAMPLE = 0.05  # s, between two looks at the energy of a free beam


def user_time():
    """User time of this process so far [s]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def crest(values):
    """The largest of equally spaced values, on the parabola through it and its neighbours."""
    k = max(range(len(values)), key=lambda i: values[i])
    if not 0 < k < len(values) - 1:
        return float(values[k])
    before, top, after = (float(values[i]) for i in (k - 1, k, k + 1))
    bend = before - 2.0 * top + after
    return top if bend == 0.0 else top - 0.125 * (after - before) ** 2 / bend


def main(run):
    """Answers the case on the command line: the last line printed."""
    case = json.loads(sys.argv[1])
    user = 0.0
    for _ in range(case.get("repeat", 1)):
        answer = run(case, case.get("options", {}))
        user += answer["user"]
    print(json.dumps(answer | {"user": user}), flush=True)
