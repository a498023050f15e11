"""Errors of runs whose steps are chosen for an accuracy; see `run`."""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

FINER = 16
ACCURACIES = ["5 %", "1 %", "0.2 %"]
SCENES = [
    "paper/elastic-clamped",
    "paper/elastic-free",
    "paper/rigid-clamped-e0.5",
    "portal-frame",
    "sweet-spot",
    "drop-weight",
    "yielding-beam",
    "oblique-throw",
    "gapped-pipe",
    "shallow-arch",
    "flying-beam",
    "crossing-beams",
    "rattling-tube",
    "disc-chain",
    "tapping-cantilever",
]


def run(text, folder, *options):
    file = Path(folder) / "scene.toml"
    file.write_text(text)
    command = ["target/release/percuss", "run", str(file), "--json", "--quiet", "--no-report"]
    out = subprocess.run([*command, "--out", str(Path(folder) / "out"), *options], capture_output=True, text=True)
    if out.returncode != 0:
        sys.exit(f"{' '.join(options)}: {out.stderr}")
    return json.loads(out.stdout)


def figures(summary):
    """Largest contact force, and largest displacements of the recorded points in both directions."""
    forces = [c["peak_force"]["value"] for c in summary["contact"].values() if "peak_force" in c]
    forces = [f for f in forces if f is not None]
    moved = [p["displacement_max"][k]["value"] for p in summary["point"].values() for k in ("component_1", "component_2")]
    return forces, moved


def error(found, right):
    largest = max((abs(x) for x in right), default=0.0)
    if largest == 0.0:
        return None
    return 100 * max(abs(a - b) for a, b in zip(found, right, strict=True)) / largest


def measure(name):
    text = Path(f"scenarios/{name}.toml").read_text()
    with tempfile.TemporaryDirectory() as folder:
        given = run(text, folder)
        step = given["settings"]["step"]
        fine = figures(run(text, folder, "--set", f"time.step={step / FINER}"))
        own = [error(a, b) for a, b in zip(figures(given), fine)]
        row = [f"| {name} | {cell(own)}, {given['steps']} |"]
        for accuracy in ACCURACIES:
            chosen = re.sub(r"(?m)^step = .*$", f'accuracy = "{accuracy}"', text, count=1)
            summary = run(chosen, folder)
            off = [error(a, b) for a, b in zip(figures(summary), fine)]
            row.append(f" {cell(off)}, {summary['steps']} |")
        print("".join(row), flush=True)


def cell(errors):
    return " / ".join("-" if e is None else f"{e:.2g}" for e in errors)


print("| scene | given step | " + " | ".join(ACCURACIES) + " |")
print("|---|---|" + "---|" * len(ACCURACIES))
for name in sys.argv[1:] or SCENES:
    measure(name)
