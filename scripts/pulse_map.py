"""Draws the map of docs/short-pulse.md from the results of scripts/pulse-map, and prints what its table says."""

import math
import sys
from pathlib import Path

import matplotlib
import pyarrow.parquet as parquet

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "percuss"  # the same file from the same results
matplotlib.rcParams["svg.fonttype"] = "none"
import matplotlib.pyplot as plt  # noqa: E402

LABELS = {
    "elements": ("elements", "{:.0f}"),
    "step": ("step", "{:.3g} s"),
    "fibres": ("fibres", "{:.0f}"),
    "end": ("until", "{:.3g} s"),
    "damping": ("mass damping", "{:.0f} 1/s"),
}
SETTLED = 15.5e3  # N/m: from here on the side does not depend on the instant at which a run ends


def sets(folder: Path) -> dict[float, dict[float, float]]:
    """Permanent set (m) by the value of the setting and the force per length (N/m)."""
    table = parquet.read_table(folder / "results" / "results.parquet").to_pydict()
    out: dict[float, dict[float, float]] = {}
    for force, value, found in zip(table["force"], table["varied"], table["set"]):
        out.setdefault(value, {})[round(force)] = found
    return out


def side(found: float) -> int | None:
    """1 above, -1 below; nothing where no equilibrium is near."""
    return None if math.isnan(found) else (1 if found > 0 else -1)


def main(runs: Path, picture: Path) -> None:
    """Reads the results below `runs` and draws them."""
    figure, axes = plt.subplots(len(LABELS), 1, figsize=(7.5, 11), sharex=True, layout="constrained")
    for ax, (name, (label, form)) in zip(axes, LABELS.items()):
        found = sets(runs / name)
        for (value, by_force), marker in zip(found.items(), "ox+"):
            forces = sorted(by_force)
            heights = [1e3 * by_force[force] for force in forces]
            text = f"{label} {form.format(value)}"
            ax.plot([f / 1e3 for f in forces], heights, marker, ms=4, mew=0.9, mfc="none", label=text)
        ax.axhline(0, color="0.6", lw=0.6)
        ax.set_ylabel("set of the middle in mm")
        ax.legend(fontsize=7, loc="upper left")
        first, *others = found.values()
        shared = [f for f in first if f >= SETTLED]
        same = [f for f in shared if all(side(o[f]) == side(first[f]) for o in others)]
        far = max(abs(o[f] - first[f]) for f in same for o in others if side(o[f]))
        below = [f for f in first if f < SETTLED]
        alike = [f for f in below if all(side(o[f]) == side(first[f]) for o in others)]
        print(
            f"{name}: same side in {len(same)} of {len(shared)} pulses from {SETTLED / 1e3} kN/m on "
            f"(others: {sorted(set(shared) - set(same))}), there at most {1e3 * far:.3f} mm apart; "
            f"below, in {len(alike)} of {len(below)}"
        )
    axes[-1].set_xlabel("force per length in kN/m, for 0.5 ms")
    figure.savefig(picture, metadata={"Date": None})


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
