"""Figures with matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import MissingError

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

    from ._result import Result


def pyplot() -> Any:
    """matplotlib, or a word on where to find it."""
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise MissingError.of("matplotlib", "plotting", "plot") from error
    return plt


class Plots:
    """Figures of a result; each takes ``ax`` to draw on and returns it."""

    def __init__(self, result: Result) -> None:
        self._result = result

    def columns(self, *names: str, ax: Axes | None = None) -> Axes:
        """Columns of one unit over time."""
        ax = ax or pyplot().subplots()[1]
        units = {self._result.units[name] for name in names if name in self._result}
        for name in names:
            ax.plot(self._result.time, self._result[name], label=name, linewidth=1.2)
        ax.set_xlabel("time [s]")
        ax.set_ylabel(" or ".join(f"[{unit}]" for unit in sorted(units)))
        ax.grid(alpha=0.3)
        ax.legend(frameon=False)
        return ax

    def energy(self, ax: Axes | None = None) -> Axes:
        """Energies over time: kinetic, strain, contact, total."""
        names = ["energy.kinetic", "energy.strain", "energy.contact", "energy.springs", "energy.total"]
        return self.columns(*(n for n in names if n == "energy.total" or np.any(self._result[n])), ax=ax)

    def momentum(self, ax: Axes | None = None) -> Axes:
        """Components of linear momentum over time."""
        return self.columns("momentum.linear_1", "momentum.linear_2", ax=ax)

    def force(self, ax: Axes | None = None) -> Axes:
        """Contact forces over time; where contacts are rigid, impulses, which are no forces and stand alone."""
        contacts = [name for name in self._result.columns if name.startswith("contact.")]
        names = [name for name in contacts if name.endswith(".force")]
        if names:
            return self.columns(*names, ax=ax)
        ax = ax or pyplot().subplots()[1]
        for name in (name for name in contacts if name.endswith(".impulse")):
            struck = np.flatnonzero(self._result[name])
            ax.vlines(self._result.time[struck], 0.0, self._result[name][struck])
            ax.plot(self._result.time[struck], self._result[name][struck], "o", markersize=4, label=name)
        if not contacts:
            ax.text(0.5, 0.5, "nothing can touch", ha="center", transform=ax.transAxes)
        else:
            ax.legend(frameon=False)
        ax.set_xlim(self._result.time[0], self._result.time[-1])
        ax.set_xlabel("time [s]")
        ax.set_ylabel("impulse [N s]")
        ax.grid(alpha=0.3)
        return ax

    def displacement(self, ax: Axes | None = None) -> Axes:
        """Displacements of the recorded points over time."""
        names = [n for n in self._result.columns if n.startswith("point.") and ".displacement_" in n]
        return self.columns(*(n for n in names if np.any(self._result[n])) or names[:1], ax=ax)

    def beam(self, t: float | None = None, ax: Axes | None = None, scale: float = 1.0) -> Axes:
        """The structure at the kept shape nearest to a time, the end by default, over its reference; displacements times
        ``scale``."""
        shapes = self._result.shapes
        k = shapes.index(self._result.time[-1] if t is None else t)
        ax = ax or pyplot().subplots()[1]
        for curve in shapes.beams.curves(0.0 * shapes.displacement[k]).values():
            ax.plot(*curve.T, color="0.7", linewidth=1)
        for name, curve in shapes.beams.curves(scale * shapes.displacement[k]).items():
            ax.plot(*curve.T, linewidth=2, label=name)
        for position in self._projectiles():
            row = int(np.abs(self._result.time - shapes.times[k]).argmin())
            ax.plot(*position[row], "ko", markersize=6)
        ax.set_aspect("equal", adjustable="datalim")
        ax.set_title(f"t = {shapes.times[k]:.6g} s")
        ax.set_xlabel("[m]")
        ax.set_ylabel("[m]")
        return ax

    def animation(self, frames: int = 100, scale: float = 1.0, interval: int = 40) -> FuncAnimation:
        """The structure in motion, displacements times ``scale``; in a notebook ``HTML(animation.to_jshtml())`` plays it,
        ``animation.save("hit.gif")`` keeps it."""
        plt = pyplot()
        from matplotlib.animation import FuncAnimation

        shapes = self._result.shapes
        shapes.index(0.0)
        shown = np.unique(np.linspace(0, len(shapes) - 1, min(frames, len(shapes))).round().astype(int))
        curves = [shapes.beams.curves(scale * shapes.displacement[k]) for k in shown]
        rows = np.searchsorted(self._result.time, shapes.times[shown]).clip(max=len(self._result) - 1)
        bodies = self._projectiles()
        figure, ax = plt.subplots()
        for curve in shapes.beams.curves(0.0 * shapes.displacement[0]).values():
            ax.plot(*curve.T, color="0.7", linewidth=1)
        lines = {name: ax.plot(*curve.T, linewidth=2)[0] for name, curve in curves[0].items()}
        dots = [ax.plot(*position[rows[0]], "ko", markersize=6)[0] for position in bodies]
        every = np.concatenate([c for frame in curves for c in frame.values()] + [p[rows] for p in bodies])
        low, high = every.min(axis=0), every.max(axis=0)
        room = 0.05 * max(*(high - low), 1e-9)
        ax.set(xlim=(low[0] - room, high[0] + room), ylim=(low[1] - room, high[1] + room), xlabel="[m]", ylabel="[m]")

        def draw(frame: int) -> list[Any]:
            for name, curve in curves[frame].items():
                lines[name].set_data(*curve.T)
            for dot, position in zip(dots, bodies):
                dot.set_data(*position[rows[frame]][:, None])
            ax.set_title(f"t = {shapes.times[shown[frame]]:.6g} s")
            return [*lines.values(), *dots]

        animation = FuncAnimation(figure, draw, frames=len(shown), interval=interval)
        plt.close(figure)  # else a notebook shows its first frame besides
        return animation

    def _projectiles(self) -> list[Any]:
        """Positions of the projectiles over the rows, each (n_row, 2)."""
        result = self._result
        names = [n[: -len("position_1")] for n in result.columns if n.endswith(".position_1")]
        return [np.stack([result[f"{n}position_1"], result[f"{n}position_2"]], axis=1) for n in names]
