"""Natural modes and static equilibrium."""

from __future__ import annotations

import json
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _percuss
from ._columns import read_only
from ._load import Scenarios, scenario_of
from ._outcome import warn_of_advice
from ._structure import Beams, Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Modes:
    """Natural modes, from the lowest on; :func:`percuss.modes` makes them.

    Examples
    --------
    >>> modes = percuss.modes("plank.toml", 3)
    >>> modes
    <percuss.Modes: 7.036, 28.1496, 63.397 Hz>
    >>> len(modes)
    3
    """

    def __init__(self, native: dict[str, Any]) -> None:
        read_only(native)
        self._native = native

    def __reduce__(self) -> tuple[Any, ...]:
        return (Modes, (self._native,))

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Content of ``modes.json``.

        Returns
        -------
        dict
            Of each mode number, kind, frequency [Hz], period [s], eigenvalue [1/s^2], rate of growth [1/s], and whether it is of the
            second spectrum of Timoshenko's theory.

        Examples
        --------
        >>> percuss.modes("plank.toml", 1).summary["modes"][0]["kind"]
        'vibration'
        """
        summary: dict[str, Any] = json.loads(self._native["summary"])
        return summary

    @property
    def frequencies(self) -> Floats:
        """Natural frequencies; NaN for an unstable mode.

        Returns
        -------
        ndarray of shape (n_mode,)
            Frequencies [Hz].

        Examples
        --------
        >>> percuss.modes("plank.toml", 3).frequencies.round(2)
        array([ 7.04, 28.15, 63.4 ])
        """
        return np.array([mode["frequency"] for mode in self.summary["modes"]], dtype=float)

    @property
    def shapes(self) -> Floats:
        """Displacements and slopes of the nodes, of unit modal mass.

        Returns
        -------
        ndarray of shape (n_mode, n_node, 4)
            (u1, u2, u1', u2') of each node [kg^(-1/2), m^-1 kg^(-1/2)].

        Examples
        --------
        >>> percuss.modes("plank.toml", 3).shapes.shape
        (3, 9, 4)
        """
        shapes: Floats = self._native["shapes"]
        return shapes

    def __len__(self) -> int:
        return len(self.shapes)

    def plot(self, number: int = 1, *, ax: Axes | None = None, amplitude: float = 0.1) -> Axes:
        """Draws a mode over the configuration about which the structure vibrates.

        Parameters
        ----------
        number : int
            The mode, counted from 1.
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.
        amplitude : float
            Largest displacement as a share of the structure's size.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Raises
        ------
        MissingError
            If matplotlib is not installed.
        IndexError
            If there is no such mode.

        Examples
        --------
        >>> percuss.modes("plank.toml", 2).plot(2).get_title()
        'mode 2: 28.1496 Hz'
        """
        from ._plot import equal_axes, pyplot

        if not 1 <= number <= len(self):
            raise IndexError(f"mode {number}: expected one from 1 to {len(self)}")
        ax = ax or pyplot().subplots()[1]
        beams, shape = Beams(self._native["beams"]), self.shapes[number - 1]
        base = self._native["displacement"][: len(shape)]
        rest = beams.curves(base)
        points = np.concatenate(list(rest.values()))
        size = float(np.ptp(points, axis=0).max())
        largest = float(np.hypot(shape[:, 0], shape[:, 1]).max()) or 1.0
        scale = amplitude * size / largest  # of a shape of unit modal mass
        for curve in rest.values():
            ax.plot(*curve.T, color="0.7", linewidth=1)
        for curve in beams.curves(base + scale * shape).values():
            ax.plot(*curve.T, linewidth=2)
        equal_axes(ax, scale)
        ax.set_title(f"mode {number}: {self.frequencies[number - 1]:.6g} Hz")
        return ax

    def __repr__(self) -> str:
        return f"<percuss.Modes: {', '.join(f'{f:.6g}' for f in self.frequencies)} Hz>"

    def _repr_html_(self) -> str:
        modes = self.summary["modes"]
        rows = "".join(
            f"<tr><td>{m['number']}</td><td>{'-' if m['frequency'] is None else format(m['frequency'], '.6g')}</td>"
            f"<td>{escape(m['kind'])}</td></tr>"
            for m in modes
        )
        return f"<table><tr><th>mode</th><th>frequency [Hz]</th><th>kind</th></tr>{rows}</table>"


class Equilibrium:
    """A static equilibrium; :func:`percuss.static` makes it.

    Examples
    --------
    >>> percuss.static("plank.toml")
    <percuss.Equilibrium stable: plank.mid [0.0, 0.0] m>
    """

    def __init__(self, native: dict[str, Any]) -> None:
        read_only(native)
        self._native = native

    def __reduce__(self) -> tuple[Any, ...]:
        return (Equilibrium, (self._native,))

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Displacements, reactions, section forces and buckling factor, as ``percuss static --json`` prints them.

        Returns
        -------
        dict
            By the names of docs/results.md, in SI units.

        Examples
        --------
        >>> percuss.static("plank.toml").summary["point"]
        {'plank.mid': {'displacement': [0.0, 0.0], 'rotation': 0.0}}
        """
        summary: dict[str, Any] = json.loads(self._native["summary"])
        return summary

    @property
    def stable(self) -> bool:
        """Whether the equilibrium is stable.

        Returns
        -------
        bool
            False past a limit point.

        Examples
        --------
        >>> percuss.static("plank.toml").stable
        True
        """
        return bool(self.summary["stable"])

    @property
    def displacement(self) -> Floats:
        """Displacements and slopes of the nodes, those of beams first, then those of bodies (u1, u2, angle, 0).

        Returns
        -------
        ndarray of shape (n_node, 4)
            (u1, u2, u1', u2') of each node [m, 1].

        Examples
        --------
        >>> percuss.static("plank.toml").displacement.shape
        (10, 4)
        """
        displacement: Floats = self._native["displacement"]
        return displacement

    def plot(self, ax: Axes | None = None, *, scale: float = 1.0) -> Axes:
        """Draws the structure in equilibrium over its reference.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.
        scale : float
            Displacements are drawn so many times as large.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Raises
        ------
        MissingError
            If matplotlib is not installed.

        Examples
        --------
        >>> percuss.static("plank.toml").plot(scale=10).get_xlabel()
        'x [m], displacements \u00d7 10'
        """
        from ._plot import equal_axes, pyplot

        ax = ax or pyplot().subplots()[1]
        beams = Beams(self._native["beams"])
        for curve in beams.curves(0.0 * self.displacement).values():
            ax.plot(*curve.T, color="0.7", linewidth=1)
        for curve in beams.curves(scale * self.displacement).values():
            ax.plot(*curve.T, linewidth=2)
        equal_axes(ax, scale)
        return ax

    def __repr__(self) -> str:
        points = (f"{name} {point['displacement']} m" for name, point in self.summary["point"].items())
        return f"<percuss.Equilibrium {'stable' if self.stable else 'unstable'}: {', '.join(points)}>"


def modes(
    scenario: Scenarios, count: int = 10, *, about: Literal["reference", "static"] | None = None, **overrides: Any
) -> Modes:
    """The lowest natural modes of a scenario; projectiles are ignored.

    Parameters
    ----------
    scenario : str, path, mapping or Scenario
        A scenario, the path of its file, or nested dictionaries with the file's names.
    count : int
        How many, from 1 to 1000.
    about : {"reference", "static"}, optional
        Of which configuration; by default the one that the scenario starts from.
    **overrides
        Values to change, with ``__`` for the dots of a path.

    Returns
    -------
    Modes
        From the lowest on.

    Raises
    ------
    ValueError
        If ``count`` or ``about`` is out of what they may be.
    ScenarioError
        If the scenario has faults.
    AnalysisError
        If there are no such modes, as of a beam without mass.

    Examples
    --------
    >>> percuss.modes("plank.toml", 2, section__plank__depth="24 mm").frequencies.round(1)
    array([14.1, 56.3])
    """
    if about not in (None, "reference", "static"):
        raise ValueError(f'about={about!r}: expected "reference" or "static"')
    if not 1 <= count <= 1000:
        raise ValueError(f"count={count}: expected from 1 to 1000 modes")
    return Modes(_percuss.modes(scenario_of(scenario)._source(overrides), count, about))


def static(scenario: Scenarios, *, path: bool = False, **overrides: Any) -> Equilibrium:
    """Static equilibrium under the loads that act at time zero; projectiles are ignored.

    Stresses beyond the strength of a material are issued as an :class:`AdviceWarning`.

    Parameters
    ----------
    scenario : str, path, mapping or Scenario
        A scenario, the path of its file, or nested dictionaries with the file's names.
    path : bool
        Follow the equilibrium by arc length, past limit points; the path is ``summary["path"]``.
    **overrides
        Values to change, with ``__`` for the dots of a path.

    Returns
    -------
    Equilibrium
        Where the structure comes to rest.

    Raises
    ------
    ScenarioError
        If the scenario has faults, or the structure can move without being strained.
    AnalysisError
        If no equilibrium was found.

    Examples
    --------
    >>> scenario = percuss.load("plank.toml")
    >>> scenario["load.worker"] = {"kind": "point", "at": "plank.mid", "force": [0, "-800 N"]}
    >>> place = percuss.static(scenario).summary["point"]["plank.mid"]["displacement"]
    >>> round(1000 * place[1], 1)  # mm
    -22.0
    """
    native = _percuss.static(scenario_of(scenario)._source(overrides), path)
    warn_of_advice(native.pop("warnings"))
    return Equilibrium(native)
