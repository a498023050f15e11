"""Figures with matplotlib."""

from __future__ import annotations

import os
from collections.abc import Collection
from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import InputError, MissingError, coded
from ._options import colour_of, own_options, texts
from ._structure import require_within
from ._words import position_label, unit_words, words

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


def equal_axes(ax: Any, scale: float = 1.0) -> None:
    """Axes of positions; displacements are drawn so many times as large."""
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel(position_label("x", scale))
    ax.set_ylabel(position_label("y", scale))


def stems(ax: Any, time: Any, values: Any, label: str) -> None:
    """Values at single instants as lines from zero, in a colour of their own."""
    (marks,) = ax.plot(time, values, "o", markersize=4, label=label)
    ax.vlines(time, 0.0, values, color=marks.get_color())


class Plots:
    """Figures of a result, ``result.plot``; each takes ``ax`` to draw on and returns it.

    Examples
    --------
    >>> result = percuss.run("plank.toml")
    >>> result.plot(colour="stress").get_xlabel()
    'x [m]'
    """

    def __init__(self, result: Result) -> None:
        self._result = result

    @own_options
    def __call__(
        self,
        t: float | None = None,
        *,
        ax: Axes | None = None,
        scale: float = 1.0,
        colour: str = "none",
        color: str | None = None,
        hide: Collection[str] = (),
    ) -> Axes:
        """The scene at a time: beams to scale, supports, bodies, loads, contact forces.

        Parameters
        ----------
        t : float, optional
            The time [s]; by default the end where something stays bent or has failed, else that of the largest contact force, or
            without one of the largest impulse.
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.
        scale : float
            Displacements are drawn so many times as large.
        colour : {"none", "stress", "velocity", "moment", "axial", "shear"}
            What colours the beams.
        color : str, optional
            The same as ``colour``.
        hide : collection of str
            Some of ``forces``, ``loads`` and ``ghost``, the reference configuration.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Raises
        ------
        MissingError
            If matplotlib is not installed.
        InputError
            If the run has no frames, or the time is outside it.
        ValueError
            If there is no such colour or part, or enlarged displacements would show bodies that overlap and do not.

        Examples
        --------
        >>> ax = percuss.run("plank.toml").plot(0.03, hide=["ghost"])
        """
        from ._drawing import Drawing

        fields = self._result.fields
        fields._require()
        if t is None:
            t = self._result._instant()
        ax = ax or pyplot().subplots(figsize=_figure_size(fields))[1]
        Drawing(fields, ax, scale, colour_of(colour, color)).draw(t, texts("hide", hide))
        return ax

    def columns(self, *names: str, ax: Axes | None = None) -> Axes:
        """Columns over time, with labels in words.

        Parameters
        ----------
        *names : str
            Names of the columns.
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Raises
        ------
        KeyError
            If there is no such column.
        MissingError
            If matplotlib is not installed.

        Examples
        --------
        >>> percuss.run("plank.toml").plot.columns("support.left.force_2").get_xlabel()
        'time [s]'
        """
        ax = ax or pyplot().subplots()[1]
        described = {name: words(name) for name in names}
        quantities = {word.quantity for word in described.values()}
        units = {unit_words(self._result.units[name]) for name in names if name in self._result}
        for name in names:
            label = described[name].of if len(quantities) == 1 and described[name].of else described[name].label
            ax.plot(self._result.time, self._result[name], label=label, linewidth=1.2)
        ax.set_xlabel("time [s]")
        ax.set_ylabel(f"{' or '.join(sorted(quantities))} [{' or '.join(sorted(units))}]")
        ax.grid(alpha=0.3)
        ax.legend(frameon=False)
        return ax

    def _seen(self, names: list[str], always: str = "") -> list[str]:
        """Columns that are more than round-off beside the largest of them; one at least."""
        sizes = [float(np.nanmax(np.abs(self._result[name]), initial=0.0)) for name in names]
        most = max(sizes, default=0.0)
        return [n for n, size in zip(names, sizes) if n == always or size > 1e-9 * most] or names[:1]

    def energy(self, ax: Axes | None = None) -> Axes:
        """Energies over time: kinetic, strain, contact, total.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Examples
        --------
        >>> percuss.run("plank.toml").plot.energy().get_ylabel()
        'energy [J]'
        """
        names = ["energy.kinetic", "energy.strain", "energy.contact", "energy.springs", "energy.total"]
        return self.columns(*self._seen(names, "energy.total"), ax=ax)

    def momentum(self, ax: Axes | None = None) -> Axes:
        """Components of linear momentum over time.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Examples
        --------
        >>> len(percuss.run("plank.toml").plot.momentum().get_lines())
        2
        """
        return self.columns("momentum.linear_1", "momentum.linear_2", ax=ax)

    def force(self, ax: Axes | None = None) -> Axes:
        """Contact forces over time; for rigid contacts impulses, shown in a separate figure.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Examples
        --------
        >>> percuss.run("plank.toml").plot.force().get_ylabel()
        'contact force [N]'
        """
        contacts = [name for name in self._result.columns if name.startswith("contact.")]
        names = [name for name in contacts if name.endswith(".force")]
        if names:
            return self.columns(*names, ax=ax)
        ax = ax or pyplot().subplots()[1]
        for name in (name for name in contacts if name.endswith(".impulse")):
            struck = np.flatnonzero(self._result[name])
            stems(ax, self._result.time[struck], self._result[name][struck], words(name).of)
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
        """Displacements of the recorded points over time.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Examples
        --------
        >>> percuss.run("plank.toml").plot.displacement().get_ylabel()
        'displacement [m]'
        """
        names = [n for n in self._result.columns if n.startswith("point.") and ".displacement_" in n]
        return self.columns(*self._seen(names), ax=ax)

    def beam(self, t: float | None = None, *, ax: Axes | None = None, scale: float = 1.0) -> Axes:
        """The scene at a time, the end by default.

        Parameters
        ----------
        t : float, optional
            The time [s].
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.
        scale : float
            Displacements are drawn so many times as large.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Examples
        --------
        >>> ax = percuss.run("plank.toml").plot.beam()
        """
        fields = self._result.fields
        fields._require()
        return self(float(fields.time[-1]) if t is None else t, ax=ax, scale=scale)

    @own_options
    def animation(
        self,
        frames: int = 150,
        *,
        scale: float = 1.0,
        interval: int = 40,
        path: str | os.PathLike[str] | None = None,
        span: tuple[float, float] | None = None,
        colour: str = "none",
        color: str | None = None,
    ) -> FuncAnimation:
        """Animation of the scene, with equal time intervals.

        In a notebook the result itself shows a player; ``HTML(animation.to_jshtml())`` shows this one.

        Parameters
        ----------
        frames : int
            How many.
        scale : float
            Displacements are drawn so many times as large.
        interval : int
            Time from frame to frame [ms].
        path : str or path, optional
            Keeps it as a film (``hit.gif``, ``hit.mp4``).
        span : (float, float), optional
            Part of the run [s]; by default all of it.
        colour : {"none", "stress", "velocity", "moment", "axial", "shear"}
            What colours the beams.
        color : str, optional
            The same as ``colour``.

        Returns
        -------
        matplotlib.animation.FuncAnimation
            The animation.

        Raises
        ------
        MissingError
            If matplotlib is not installed.
        InputError
            If the run has no frames, ``span`` is not within it, or the format needs ffmpeg and there is none.

        Examples
        --------
        >>> import os
        >>> animation = percuss.run("plank.toml").plot.animation(frames=3, span=(0.01, 0.05), path="impact.gif")
        >>> os.path.getsize("impact.gif") > 0
        True
        """
        plt = pyplot()
        from matplotlib.animation import FuncAnimation

        from ._drawing import Drawing

        fields = self._result.fields
        fields._require()
        writer = None if path is None else _writer(os.fspath(path))
        start, end = span or (float(fields.time[0]), float(fields.time[-1]))
        require_within(fields.time, start, end)
        times = np.linspace(start, end, max(int(frames), 1))
        figure, ax = plt.subplots(figsize=_figure_size(fields))
        drawing = Drawing(fields, ax, scale, colour_of(colour, color))

        def show(k: int) -> list[Any]:
            return drawing.draw(float(times[k]))

        animation = FuncAnimation(figure, show, frames=len(times), interval=interval, init_func=lambda: [])
        if path is not None:
            animation.save(os.fspath(path), writer=writer)
        plt.close(figure)  # else a notebook shows its first frame besides
        return animation


def _writer(path: str) -> str:
    """What writes a film: Pillow, or ffmpeg where the format needs it."""
    from matplotlib.animation import writers

    if path.lower().endswith((".gif", ".apng", ".webp")):
        return "pillow"
    if not writers.is_available("ffmpeg"):
        text = f"{path}: this format needs the program ffmpeg, which is not there; .gif, .apng and .webp do without"
        raise coded(InputError, text, "E213")
    return "ffmpeg"


def _figure_size(fields: Any) -> tuple[float, float]:
    """Inches, as high as the scene needs."""
    from ._drawing import bounds

    low, high = bounds(fields)
    return 8.0, float(np.clip(8.0 * (high[1] - low[1]) / (high[0] - low[0]) + 1.2, 2.6, 8.0))
