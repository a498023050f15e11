"""Natural modes and static equilibrium."""

from __future__ import annotations

import json
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _percuss
from ._scenario import Scenarios, changes_of, scenario_of
from ._structure import Beams, Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Modes:
    """Natural modes, from the lowest on."""

    def __init__(self, native: dict[str, Any]) -> None:
        self._native = native

    def __reduce__(self) -> tuple[Any, ...]:
        return (Modes, (self._native,))

    @cached_property
    def summary(self) -> dict[str, Any]:
        """As in ``modes.json``."""
        summary: dict[str, Any] = json.loads(self._native["summary"])
        return summary

    @property
    def frequencies(self) -> Floats:
        """Natural frequencies [Hz]; NaN of a motion that grows."""
        return np.array([mode["frequency"] for mode in self.summary["modes"]], dtype=float)

    @property
    def shapes(self) -> Floats:
        """Displacements and slopes of the nodes, of unit modal mass, shape (n_mode, n_node, 4)."""
        shapes: Floats = self._native["shapes"]
        return shapes

    def __len__(self) -> int:
        return len(self.shapes)

    def plot(self, number: int = 1, ax: Axes | None = None, amplitude: float = 0.1) -> Axes:
        """A mode, counted from 1; ``amplitude`` is its largest displacement as a share of the structure's size."""
        from ._plot import equal_axes, pyplot

        ax = ax or pyplot().subplots()[1]
        beams, shape = Beams(self._native["beams"]), self.shapes[number - 1]
        base = self._native["displacement"][: len(shape)]
        rest = beams.curves(base)
        points = np.concatenate(list(rest.values()))
        size = float(np.ptp(points, axis=0).max())
        largest = float(np.hypot(shape[:, 0], shape[:, 1]).max()) or 1.0
        for curve in rest.values():
            ax.plot(*curve.T, color="0.7", linewidth=1)
        for curve in beams.curves(base + amplitude * size / largest * shape).values():
            ax.plot(*curve.T, linewidth=2)
        equal_axes(ax)
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
    """A static equilibrium."""

    def __init__(self, native: dict[str, Any]) -> None:
        self._native = native

    def __reduce__(self) -> tuple[Any, ...]:
        return (Equilibrium, (self._native,))

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Displacements, reactions, section forces and buckling factor, as ``percuss static --json`` prints them."""
        summary: dict[str, Any] = json.loads(self._native["summary"])
        return summary

    @property
    def stable(self) -> bool:
        """Whether the structure stays there."""
        return bool(self.summary["stable"])

    @property
    def displacement(self) -> Floats:
        """Displacements and slopes of the nodes, shape (n_node, 4)."""
        displacement: Floats = self._native["displacement"]
        return displacement

    def plot(self, ax: Axes | None = None, scale: float = 1.0) -> Axes:
        """The structure in equilibrium over its reference, displacements times ``scale``."""
        from ._plot import equal_axes, pyplot

        ax = ax or pyplot().subplots()[1]
        beams = Beams(self._native["beams"])
        for curve in beams.curves(0.0 * self.displacement).values():
            ax.plot(*curve.T, color="0.7", linewidth=1)
        for curve in beams.curves(scale * self.displacement).values():
            ax.plot(*curve.T, linewidth=2)
        equal_axes(ax)
        return ax

    def __repr__(self) -> str:
        points = (f"{name} {point['displacement']} m" for name, point in self.summary["point"].items())
        return f"<percuss.Equilibrium {'stable' if self.stable else 'unstable'}: {', '.join(points)}>"


def modes(
    scenario: Scenarios, count: int = 10, about: Literal["reference", "static"] | None = None, **overrides: Any
) -> Modes:
    """The lowest natural modes of a scenario; projectiles take no part. ``about`` says of which configuration: by default the
    one that the scenario starts from."""
    if about not in (None, "reference", "static"):
        raise ValueError(f'about={about!r}: expected "reference" or "static"')
    if not 1 <= count <= 1000:
        raise ValueError(f"count={count}: expected from 1 to 1000 modes")
    return Modes(_percuss.modes(scenario_of(scenario)._source(changes_of(overrides)), count, about))


def static(scenario: Scenarios, path: bool = False, **overrides: Any) -> Equilibrium:
    """Static equilibrium under the loads that act at time zero; projectiles take no part. With ``path`` the equilibrium is
    followed by arc length, past limit points, and stands in ``summary["path"]``."""
    return Equilibrium(_percuss.static(scenario_of(scenario)._source(changes_of(overrides)), path))
