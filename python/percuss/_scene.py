"""Beams and contact points of a scene."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._structure import Floats


_ARC = 12
"""Chords of a quarter of a round end."""


class Curve(NamedTuple):
    """Points of a beam without a corner between them.

    Attributes
    ----------
    points : ndarray of shape (n, 2)
        Places on the axis [m].
    normals : ndarray of shape (n, 2)
        Unit normals, to the left of the tangent [1].
    tangents : ndarray of shape (n, 2)
        Unit tangents [1].
    half_depth : ndarray of shape (n,)
        Distances of the extreme fibres from the axis [m]; NaN where they are not known.
    reach : ndarray of shape (n,)
        Distances of the outline from the axis, less than the half depth towards round ends [m].
    intervals : ndarray of shape (n,)
        Interval of the scene that each point lies in [-].
    shares : ndarray of shape (n,)
        How far along it [1].
    stations : ndarray of shape (n,)
        Station of the beam before each point [-].

    Examples
    --------
    >>> fields = percuss.run("plank.toml").fields
    >>> fields.beams[0].curves(fields.displacement_at(0.02))[0].points.shape
    (65, 2)
    """

    points: Floats
    normals: Floats
    tangents: Floats
    half_depth: Floats
    reach: Floats
    intervals: NDArray[np.int64]
    shares: Floats
    stations: NDArray[np.int64]


class Contact(NamedTuple):
    """Force or impulse at a contact point.

    Attributes
    ----------
    contact : str
        Name of the contact.
    position : ndarray of shape (2,)
        Where [m].
    force : ndarray of shape (2,)
        On the beam, where a body presses on one [N]; an impulse [N s] in an impact.
    impulsive : bool
        Whether it is an impulse.

    Examples
    --------
    >>> fields = percuss.run("plank.toml").fields
    >>> touch = fields.contacts(fields.index(0.02))[0]
    >>> touch.contact, round(float(touch.force[1])), touch.impulsive
    ('bag', -1756, False)
    """

    contact: str
    position: Floats
    force: Floats
    impulsive: bool


class SceneBeam:
    """A beam of the scene: cubics between stations, those of the solver.

    Attributes
    ----------
    name : str
        Its name.
    first : int
        Number of its first node in the scene.
    s : ndarray of shape (n_station,)
        Arc lengths of its stations [m].
    half_depth : ndarray of shape (n_station,)
        Distances of the extreme fibres from the axis [m]; NaN where they are not known.
    area : ndarray of shape (n_station,)
        Areas of the section [m^2].
    inertia : ndarray of shape (n_station,)
        Second moments of area [m^4].
    rest : ndarray of shape (n_station, 4)
        Places [m] and tangents [1] in the reference configuration.
    roundings : tuple of float
        Radii of the arcs from face to face at its start and its end, zero where it ends straight across [m].
    shear_flexible : bool
        Whether it is shear-flexible: tangents are the normals of its sections.
    begins : ndarray of int
        Stations at which an interval begins [-].
    numbers : ndarray of int
        Numbers of the intervals among those of all beams [-].
    gaps : list of tuple
        Where it has parted, from and to an arc length [m], and when [s].

    Examples
    --------
    >>> beam = percuss.run("plank.toml").fields.beams[0]
    >>> beam.name, beam.s[:3]
    ('plank', array([0.  , 0.25, 0.5 ]))
    """

    def __init__(self, value: dict[str, Any], first: int, interval: int) -> None:
        self.name: str = value["name"]
        self.first = first
        column = {key: np.array([np.nan if v is None else v for v in value[key]], float) for key in value if isinstance(value[key], list)}
        self.s, self.half_depth = column["s"], column["half_depth"]
        self.area, self.inertia = column["area"], column["inertia"]
        self.rest = np.stack([column["x"], column["y"], column["tx"], column["ty"]], axis=1)
        self.roundings: tuple[float, float] = tuple(value.get("roundings", (0.0, 0.0)))
        self.shear_flexible: bool = value.get("shear_flexible", False)
        self._bent = column.get("bent", np.zeros(len(self.s)))
        self.begins = np.flatnonzero(np.diff(self.s) > 0)
        self.numbers = interval + np.arange(len(self.begins))
        self.gaps: list[tuple[float, float, float]] = []

    def evaluate(self, k: Any, share: Any, u: Floats, scale: float = 1.0) -> tuple[Floats, Floats]:
        """Places and unit tangents between stations ``k`` and ``k + 1``; of a shear-flexible beam the normals of its sections.

        Parameters
        ----------
        k : int or array of int
            Stations.
        share : float or array
            How far from one to the next, from 0 to 1 [1].
        u : ndarray of shape (n_node, 4)
            Displacements of the scene's nodes [m, 1].
        scale : float
            Displacements are taken so many times as large.

        Returns
        -------
        (ndarray, ndarray)
            Places [m] and unit tangents [1], of shape (..., 2).

        Examples
        --------
        >>> fields = percuss.run("plank.toml").fields
        >>> place, tangent = fields.beams[0].evaluate(0, 0.5, fields.displacement_at(0.0))
        >>> place
        array([0.125, 0.   ])
        """
        k, x = np.asarray(k), np.asarray(share, float)
        y, length = 1.0 - x, self.s[k + 1] - self.s[k]
        moved = self.rest + scale * u[self.first : self.first + len(self.s)]
        a, b = moved[k], moved[k + 1]
        value = [y * y * (1 + 2 * x), length * x * y * y, x * x * (1 + 2 * y), -length * x * x * y]
        slope = [(6 * x * x - 6 * x) / length, 1 - 4 * x + 3 * x * x, (6 * x - 6 * x * x) / length, 3 * x * x - 2 * x]
        parts = [a[..., :2], a[..., 2:], b[..., :2], b[..., 2:]]
        if self.shear_flexible:
            # The slopes of the axis differ from the normals of the sections by the shear; the rest of the difference is bending.
            difference = (parts[2] - parts[0]) / np.asarray(length)[..., None] - 0.5 * (parts[1] + parts[3])
            turned = self._bent[k][..., None] * difference
            shear = difference - turned
            tangent = y[..., None] * parts[1] + x[..., None] * parts[3] + (6 * x * y)[..., None] * turned
            parts = [parts[0], parts[1] + shear, parts[2], parts[3] + shear]
        else:
            tangent = sum(n[..., None] * part for n, part in zip(map(np.asarray, slope), parts))
        place = sum(n[..., None] * part for n, part in zip(map(np.asarray, value), parts))
        return np.asarray(place), np.asarray(tangent / np.maximum(np.linalg.norm(tangent, axis=-1, keepdims=True), 1e-300))

    def curves(self, u: Floats, scale: float = 1.0, pieces: int = 8, t: float = -np.inf) -> list[Curve]:
        """The beam as parts without corners and without fractured parts.

        Parameters
        ----------
        u : ndarray of shape (n_node, 4)
            Displacements of the scene's nodes [m, 1].
        scale : float
            Displacements are taken so many times as large.
        pieces : int
            Pieces an interval.
        t : float
            Time by which it may have parted [s].

        Returns
        -------
        list of Curve
            From its start to its end.

        Examples
        --------
        >>> fields = percuss.run("plank.toml").fields
        >>> len(fields.beams[0].curves(fields.displacement_at(0.02)))
        1
        """
        out = []
        whole = np.array([not self._is_parted(int(k), t) for k in self.begins], bool)
        kept, numbers_kept = self.begins[whole], self.numbers[whole]
        breaks = np.flatnonzero(np.diff(kept) > 1) + 1
        for begins, numbers in zip(np.split(kept, breaks), np.split(numbers_kept, breaks)):
            if not len(begins):
                continue
            shares = [self._shares(int(begin), pieces) for begin in begins]
            counts = [len(one) for one in shares]
            k = np.append(np.repeat(begins, counts), begins[-1])
            share = np.append(np.concatenate(shares), 1.0)
            intervals = np.append(np.repeat(numbers, counts), numbers[-1])
            place, tangent = self.evaluate(k, share, u, scale)
            normal = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
            depth = (1 - share) * self.half_depth[k] + share * self.half_depth[k + 1]
            reach = depth - self._cut(self.s[k] + share * (self.s[k + 1] - self.s[k]))
            out.append(Curve(place, normal, tangent, depth, reach, intervals, share, k))
        return out

    def _cut(self, s: Floats) -> Floats:
        """By how much the arcs of round ends cut off either face at arc lengths."""
        out = np.zeros_like(s)
        for r, away in zip(self.roundings, (s - self.s[0], self.s[-1] - s)):
            inside = np.clip(away, 0.0, r)
            out = np.maximum(out, r - np.sqrt(inside * (2 * r - inside)))
        return out

    def _shares(self, k: int, pieces: int) -> Floats:
        """Shares of the interval after station ``k`` at which it is drawn, its end left out: evenly, and at even angles of round ends."""
        shares = [np.arange(pieces) / pieces]
        angles = np.arange(1, _ARC + 1) / _ARC * (np.pi / 2)
        for r, end, way in zip(self.roundings, (self.s[0], self.s[-1]), (1.0, -1.0)):
            s = end + way * r * (1 - np.cos(angles))
            inside = (r > 0) & (s > self.s[k]) & (s < self.s[k + 1])
            shares.append((s[inside] - self.s[k]) / (self.s[k + 1] - self.s[k]))
        return np.sort(np.concatenate(shares))

    def _is_parted(self, k: int, t: float) -> bool:
        """Whether it has parted between stations ``k`` and ``k + 1`` by a time."""
        return any(
            time <= t and min(to, self.s[k + 1]) - max(start, self.s[k]) > 1e-9 * (to - start) for start, to, time in self.gaps
        )

    def loose(self, times: Floats) -> NDArray[np.bool_]:
        """Stations that belong to no piece of the beam, all that they bound having parted.

        Parameters
        ----------
        times : ndarray of shape (n_time,)
            Instants [s].

        Returns
        -------
        ndarray of bool, shape (n_time, n_station)
            Whether each station stands alone [-].

        Examples
        --------
        >>> beam = percuss.run("plank.toml").fields.beams[0]
        >>> beam.loose([0.0, 0.02]).any()
        np.False_
        """
        out = np.zeros((len(times), len(self.s)), bool)
        if self.gaps:
            begins = {int(k) for k in self.begins}
            for i, t in enumerate(times):
                for k in range(len(self.s)):
                    out[i, k] = all(self._is_parted(j, float(t)) for j in (k - 1, k) if j in begins)
        return out

    def at(self, s: float, u: Floats, scale: float = 1.0) -> tuple[Floats, Floats, float]:
        """Place, unit tangent and half depth at an arc length.

        Parameters
        ----------
        s : float
            The arc length [m].
        u : ndarray of shape (n_node, 4)
            Displacements of the scene's nodes [m, 1].
        scale : float
            Displacements are taken so many times as large.

        Returns
        -------
        (ndarray, ndarray, float)
            Place [m], unit tangent [1] and half depth [m], zero where it is not known.

        Examples
        --------
        >>> fields = percuss.run("plank.toml").fields
        >>> place, tangent, half_depth = fields.beams[0].at(1.0, fields.displacement_at(0.02))
        >>> place.round(4), half_depth
        (array([ 1.    , -0.0026]), 0.006)
        """
        inside = self.begins[s <= self.s[self.begins + 1]]
        k = int(inside[0] if len(inside) else self.begins[-1])
        share = float(np.clip((s - self.s[k]) / (self.s[k + 1] - self.s[k]), 0.0, 1.0))
        place, tangent = self.evaluate(k, share, u, scale)
        depth = (1 - share) * self.half_depth[k] + share * self.half_depth[k + 1]
        return place, tangent, float(np.nan_to_num(depth))
