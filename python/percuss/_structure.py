"""Beams and their shapes: Hermite's cubic in every element, as the solver has it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError, coded

Floats = NDArray[np.float64]


class Beams:
    """Centre lines of the beams of a structure."""

    def __init__(self, native: dict[str, Any]) -> None:
        self._native = native

    @property
    def names(self) -> tuple[str, ...]:
        """The beams' names."""
        return tuple(self._native)

    def curves(self, displacement: Floats, pieces: int = 12) -> dict[str, Floats]:
        """Points (n, 2) of each beam where its nodes have these displacements (n_node, 4)."""
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
        """No displacement at all."""
        last = max(int(nodes.max()) + 2 for nodes, _, _ in self._native.values())
        return np.zeros((last, 4))


class Shapes:
    """Shapes of a structure at some times of a run: those of its frames, between stations of the scene."""

    def __init__(self, beams: Beams, times: Floats, displacement: Floats) -> None:
        self.beams = beams
        """The beams' centre lines."""
        self.times = times
        """Times [s], shape (n_shape)."""
        self.displacement = displacement
        """Displacements and slopes (u1, u2, u1', u2') of the stations, in single precision, shape (n_shape, n_station, 4)."""

    def __len__(self) -> int:
        return len(self.times)

    def index(self, t: float) -> int:
        """Index of the shape nearest to a time."""
        if not len(self.times):
            raise coded(InputError, "no shapes were kept of this run: run it with record.shapes (or shapes=) above 0", "E210")
        return int(np.abs(self.times - t).argmin())

    def at(self, t: float) -> dict[str, Floats]:
        """Points (n, 2) of each beam at the shape nearest to a time."""
        return self.beams.curves(self.displacement[self.index(t)])
