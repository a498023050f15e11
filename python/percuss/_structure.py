"""Beams and their shapes: Hermite's cubic in every element, as the solver has it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError, coded

Floats = NDArray[np.float64]


_SAME = 1e-9
"""Times outside a run by less than this share of its duration are its start or its end."""


def require_within(times: Floats, *instants: float) -> None:
    """Refuses instants outside those of the frames."""
    if not len(times):
        raise coded(InputError, "no shapes were kept of this run: run it with record.shapes (or shapes=) above 0", "E210")
    first, last = float(times[0]), float(times[-1])
    slack = _SAME * (last - first)
    for t in instants:
        if not first - slack <= t <= last + slack:
            raise coded(InputError, f"t = {t:g} s: the run has shapes from {first:g} s to {last:g} s", "E313")


def index_at(times: Floats, t: float) -> int:
    """The frame nearest to a time within the run."""
    require_within(times, t)
    return int(np.abs(times - t).argmin())


class Beams:
    """Centre lines of the beams of a structure: Hermite's cubic in every element.

    Examples
    --------
    >>> percuss.run("plank.toml").shapes.beams.names
    ('plank',)
    """

    def __init__(self, native: dict[str, Any]) -> None:
        self._native = native

    @property
    def names(self) -> tuple[str, ...]:
        """The beams' names.

        Returns
        -------
        tuple of str
            In the order of the scenario.

        Examples
        --------
        >>> percuss.run("plank.toml").fields.centre_lines().names
        ('plank',)
        """
        return tuple(self._native)

    def curves(self, displacement: Floats, pieces: int = 12) -> dict[str, Floats]:
        """Points of each beam.

        Parameters
        ----------
        displacement : ndarray of shape (n_node, 4)
            (u1, u2, u1', u2') of the nodes [m, 1].
        pieces : int
            Pieces an element.

        Returns
        -------
        dict of ndarray
            Places [m] of shape (n, 2), by the beam's name.

        Examples
        --------
        >>> lines = percuss.run("plank.toml").fields.centre_lines()
        >>> lines.curves(lines.reference(), pieces=2)["plank"][-1]
        array([2., 0.])
        """
        x = np.linspace(0.0, 1.0, pieces + 1)
        y = 1.0 - x
        out = {}
        for name, (nodes, lengths, ends) in self._native.items():
            a, b = ends[:, 0] + displacement[nodes], ends[:, 1] + displacement[nodes + 1]
            value = np.stack([y * y * (1 + 2 * x), x * x * (1 + 2 * y)])
            slope = np.stack([x * y * y, -x * x * y])
            both = np.stack([a, b], axis=1)
            points = np.einsum("ep,nek->npk", value, both[..., :2])
            points += np.einsum("ep,nek->npk", slope, both[..., 2:]) * lengths[:, None, None]
            inner = [part if k == 0 else part[1:] for k, part in enumerate(points)]
            out[name] = np.concatenate(inner)
        return out

    def reference(self) -> Floats:
        """No displacement at all.

        Returns
        -------
        ndarray of shape (n_node, 4)
            Zeros [m, 1].

        Examples
        --------
        >>> percuss.run("plank.toml").fields.centre_lines().reference().shape
        (9, 4)
        """
        last = max(int(nodes.max()) + 2 for nodes, _, _ in self._native.values())
        return np.zeros((last, 4))


class Shapes:
    """Shapes of a structure at some times of a run: those of its frames, between stations of the scene.

    Attributes
    ----------
    beams : Beams
        The beams' centre lines.
    times : ndarray of shape (n_shape,)
        Times [s].
    displacement : ndarray of shape (n_shape, n_station, 4)
        Displacements and slopes (u1, u2, u1', u2') of the stations [m, 1].

    Examples
    --------
    >>> shapes = percuss.run("plank.toml").shapes
    >>> len(shapes), shapes.displacement.shape
    (751, (751, 9, 4))
    """

    def __init__(self, beams: Beams, times: Floats, displacement: Floats) -> None:
        self.beams = beams
        self.times = times
        self.displacement = displacement

    def __len__(self) -> int:
        return len(self.times)

    def index(self, t: float) -> int:
        """Index of the shape nearest to a time.

        Parameters
        ----------
        t : float
            The time [s].

        Returns
        -------
        int
            Into ``times``.

        Raises
        ------
        InputError
            If no shapes were kept, or the time is outside the run.

        Examples
        --------
        >>> percuss.run("plank.toml").shapes.index(0.02)
        100
        """
        return index_at(self.times, t)

    def at(self, t: float) -> dict[str, Floats]:
        """Points of each beam at the shape nearest to a time.

        Parameters
        ----------
        t : float
            The time [s].

        Returns
        -------
        dict of ndarray
            Places [m] of shape (n, 2), by the beam's name.

        Raises
        ------
        InputError
            If no shapes were kept, or the time is outside the run.

        Examples
        --------
        >>> line = percuss.run("plank.toml").shapes.at(0.02)["plank"]
        >>> round(1000 * float(line[:, 1].min()), 2)  # mm
        -2.55
        """
        return self.beams.curves(self.displacement[self.index(t)])
