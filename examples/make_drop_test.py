"""Makes the records of ``scenarios/fits`` again: runs of the hammer with other values than its file has, and noise.

    python examples/make_drop_test.py

What it takes are the values that ``fit-drop-test.ipynb`` and ``percuss fit scenarios/fits/drop-test.toml`` are to find.
"""

from pathlib import Path

import numpy as np

import percuss

FOLDER = Path(__file__).parents[1] / "scenarios" / "fits"

TRUTH = {
    "projectile.hammer.stiffness": 2e6,  # N/m
    "projectile.hammer.dissipation": 0.2,  # s/m
    "material.aluminium.yield": 120e6,  # Pa
}
SIGMA = {"contact.hammer.force": 40.0, "point.bar.mid.displacement_2": 20e-6}  # N, m
OFFSETS = {"hammer-6.csv": 0.5e-3, "hammer-5.csv": 0.9e-3}  # s: the recorder starts before the run
SPEEDS = {"hammer-6.csv": -6.0, "hammer-5.csv": -5.0}  # m/s
RATE = 20e3  # Hz


def record(name: str, seed: int) -> str:
    """A record as a data logger writes it."""
    scenario = percuss.load(FOLDER / "hammer.toml")
    for path, value in TRUTH.items():
        scenario[path] = value
    scenario["projectile.hammer.velocity"] = [0, SPEEDS[name]]
    run = percuss.run(scenario)
    noise = np.random.default_rng(seed)
    time = np.arange(0, 8.4e-3, 1 / RATE)
    columns = [1e3 * time]
    for (column, sigma), scale in zip(SIGMA.items(), (1e-3, 1e3)):
        clean = np.interp(time - OFFSETS[name], run.t, run[column])
        columns.append(scale * (clean + sigma * noise.standard_normal(time.size)))
    rows = [f"{t:.2f},{force:.4f},{place:.5f}" for t, force, place in zip(*columns)]
    return "t [ms],F [kN],u [mm]\n" + "\n".join(rows) + "\n"


if __name__ == "__main__":
    for seed, name in enumerate(OFFSETS):
        (FOLDER / name).write_text(record(name, seed), encoding="utf-8")
