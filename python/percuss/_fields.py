"""The scene of a run and how it moved: what is drawn, animated and exported."""

from __future__ import annotations

import json
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError, coded
from ._structure import Beams, Floats

Singles = NDArray[np.float32]


class Curve(NamedTuple):
    """Points of a beam without a corner between them."""

    points: Floats
    """Places on the axis [m], shape (n, 2)."""
    normals: Floats
    """Unit normals, to the left of the tangent, shape (n, 2)."""
    tangents: Floats
    """Unit tangents, shape (n, 2)."""
    half_depth: Floats
    """Distances of the extreme fibres from the axis [m]; nan where they are not known."""
    intervals: NDArray[np.int64]
    """Interval of the scene that each point lies in."""
    shares: Floats
    """How far along it."""
    stations: NDArray[np.int64]
    """Station of the beam before each point."""


class Contact(NamedTuple):
    """What acts at a place where two things touch."""

    contact: str
    """Name of the contact."""
    position: Floats
    """Where [m]."""
    force: Floats
    """On the beam, where a body presses on one [N]; an impulse [N s] in an impact."""
    impulsive: bool
    """Whether it is an impulse."""


class SceneBeam:
    """A beam of the scene: cubics between stations, those of the solver."""

    def __init__(self, value: dict[str, Any], first: int, interval: int) -> None:
        self.name: str = value["name"]
        self.first = first
        column = {key: np.array([np.nan if v is None else v for v in value[key]], float) for key in value if key != "name"}
        self.s, self.half_depth = column["s"], column["half_depth"]
        self.area, self.inertia = column["area"], column["inertia"]
        self.rest = np.stack([column["x"], column["y"], column["tx"], column["ty"]], axis=1)
        self.begins = np.flatnonzero(np.diff(self.s) > 0)
        """Stations at which an interval begins."""
        self.numbers = interval + np.arange(len(self.begins))
        """Numbers of the intervals among those of all beams."""

    def evaluate(self, k: Any, share: Any, u: Floats, scale: float = 1.0) -> tuple[Floats, Floats]:
        """Places and unit tangents between stations ``k`` and ``k + 1`` where the scene's nodes have displacements ``u``."""
        k, x = np.asarray(k), np.asarray(share, float)
        y, length = 1.0 - x, self.s[k + 1] - self.s[k]
        moved = self.rest + scale * u[self.first : self.first + len(self.s)]
        a, b = moved[k], moved[k + 1]
        value = [y * y * (1 + 2 * x), length * x * y * y, x * x * (1 + 2 * y), -length * x * x * y]
        slope = [(6 * x * x - 6 * x) / length, 1 - 4 * x + 3 * x * x, (6 * x - 6 * x * x) / length, 3 * x * x - 2 * x]
        parts = [a[..., :2], a[..., 2:], b[..., :2], b[..., 2:]]
        place = sum(n[..., None] * part for n, part in zip(map(np.asarray, value), parts))
        tangent = sum(n[..., None] * part for n, part in zip(map(np.asarray, slope), parts))
        return np.asarray(place), np.asarray(tangent / np.maximum(np.linalg.norm(tangent, axis=-1, keepdims=True), 1e-300))

    def curves(self, u: Floats, scale: float = 1.0, pieces: int = 8) -> list[Curve]:
        """The beam as parts without corner."""
        out = []
        breaks = np.flatnonzero(np.diff(self.begins) > 1) + 1
        for begins, numbers in zip(np.split(self.begins, breaks), np.split(self.numbers, breaks)):
            k = np.append(np.repeat(begins, pieces), begins[-1])
            share = np.append(np.tile(np.arange(pieces) / pieces, len(begins)), 1.0)
            intervals = np.append(np.repeat(numbers, pieces), numbers[-1])
            place, tangent = self.evaluate(k, share, u, scale)
            normal = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
            depth = (1 - share) * self.half_depth[k] + share * self.half_depth[k + 1]
            out.append(Curve(place, normal, tangent, depth, intervals, share, k))
        return out

    def at(self, s: float, u: Floats, scale: float = 1.0) -> tuple[Floats, Floats, float]:
        """Place, unit tangent and half depth (zero if unknown) at an arc length."""
        inside = self.begins[s <= self.s[self.begins + 1]]
        k = int(inside[0] if len(inside) else self.begins[-1])
        share = float(np.clip((s - self.s[k]) / (self.s[k + 1] - self.s[k]), 0.0, 1.0))
        place, tangent = self.evaluate(k, share, u, scale)
        depth = (1 - share) * self.half_depth[k] + share * self.half_depth[k + 1]
        return place, tangent, float(np.nan_to_num(depth))


class Fields:
    """The scene and its frames."""

    def __init__(self, native: dict[str, Any]) -> None:
        self._native = native
        self.time: Floats = native["time"]
        """Times of the frames [s]."""
        self.displacement: Singles = native["displacement"]
        """(u1, u2, u1', u2') of the stations of all beams, then (u1, u2, angle, 0) of the bodies, shape (n_frame, n_node, 4)."""
        self.velocity: Singles = native["velocity"]
        """Velocities of the same; no nodes where they were not kept."""
        self.section_forces: Singles = native["section_forces"]
        """(axial force, shear force, moment) at both ends of every interval, shape (n_frame, n_interval, 2, 3)."""
        self.load_factors: Singles = native["load_factors"]
        """Factors of the loads, shape (n_frame, n_load)."""

    def __len__(self) -> int:
        return len(self.time)

    @cached_property
    def scene(self) -> dict[str, Any]:
        """What stands there, as in ``fields/scene.json``."""
        scene: dict[str, Any] = json.loads(self._native["scene"])
        return scene

    @cached_property
    def beams(self) -> list[SceneBeam]:
        """The beams."""
        out: list[SceneBeam] = []
        for value in self.scene["beams"]:
            first = out[-1].first + len(out[-1].s) if out else 0
            interval = int(out[-1].numbers[-1]) + 1 if out else 0
            out.append(SceneBeam(value, first, interval))
        return out

    @property
    def stations(self) -> int:
        """Number of nodes that belong to beams."""
        return self.beams[-1].first + len(self.beams[-1].s) if self.beams else 0

    @property
    def nodes(self) -> int:
        """Number of nodes of the scene."""
        return self.stations + len(self.scene["bodies"])

    def index(self, t: float) -> int:
        """The frame nearest to a time."""
        self._require()
        return int(np.abs(self.time - t).argmin())

    def displacement_at(self, t: float) -> Floats:
        """Displacements at a time, straight between frames, shape (n_node, 4); none where no frames were kept."""
        if not len(self):
            return np.zeros((self.nodes, 4))
        b = int(np.clip(np.searchsorted(self.time, t), 1, max(len(self) - 1, 1)))
        a, b = b - 1, min(b, len(self) - 1)
        span = self.time[b] - self.time[a]
        share = float(np.clip((t - self.time[a]) / span, 0.0, 1.0)) if span > 0 else 0.0
        return np.asarray((1 - share) * self.displacement[a].astype(float) + share * self.displacement[b].astype(float))

    @cached_property
    def _offsets(self) -> NDArray[np.int64]:
        return np.concatenate([[0], np.cumsum(self._native["contact_counts"])]).astype(np.int64)

    def contacts(self, frame: int) -> list[Contact]:
        """What touches in a frame."""
        bodies = {b["name"] for b in self.scene["bodies"] + self.scene["obstacles"]}
        out = []
        for number, x, y, f, g, impulsive in self._native["contact_forces"][self._offsets[frame] : self._offsets[frame + 1]]:
            contact = self.scene["contacts"][int(number)]
            first, second = contact["between"]
            sign = -1.0 if second in bodies and first not in bodies else 1.0
            out.append(Contact(contact["name"], np.array([x, y], float), sign * np.array([f, g], float), impulsive > 0.5))
        return out

    @cached_property
    def largest(self) -> tuple[dict[bool, float], float | None]:
        """Largest force and impulse at one place, by whether it is an impulse; time of the largest resultant of a contact."""
        rows = self._native["contact_forces"]
        size, when = {False: 0.0, True: 0.0}, {False: (0.0, None), True: (0.0, None)}
        for frame in np.flatnonzero(self._native["contact_counts"]):
            part = rows[self._offsets[frame] : self._offsets[frame + 1]].astype(float)
            for impulsive in (False, True):
                own = part[(part[:, 5] > 0.5) == impulsive]
                for number in np.unique(own[:, 0]):
                    forces = own[own[:, 0] == number, 3:5]
                    size[impulsive] = max(size[impulsive], float(np.linalg.norm(forces, axis=1).max()))
                    resultant = float(np.linalg.norm(forces.sum(axis=0)))
                    if resultant > when[impulsive][0]:
                        when[impulsive] = (resultant, float(self.time[frame]))  # type: ignore[assignment]
        return size, when[False][1] if when[False][1] is not None else when[True][1]

    def section(self, frame: int, curve: Curve) -> Floats:
        """Axial force, shear force and moment at the points of a curve, shape (n, 3)."""
        ends = self.section_forces[frame][curve.intervals].astype(float)
        share = curve.shares[:, None]
        return np.asarray((1 - share) * ends[:, 0] + share * ends[:, 1])

    def stress(self, frame: int, beam: SceneBeam, curve: Curve) -> Floats:
        """Largest normal stress of the fibres [Pa] at the points of a curve; nan where the depth is not known or the section can
        yield: stress does not follow from forces there."""
        forces, k, share = self.section(frame, curve), curve.stations, curve.shares
        area = (1 - share) * beam.area[k] + share * beam.area[k + 1]
        inertia = (1 - share) * beam.inertia[k] + share * beam.inertia[k + 1]
        return np.asarray(np.abs(forces[:, 0]) / area + np.abs(forces[:, 2]) * curve.half_depth / inertia)

    def speed(self, frame: int, beam: SceneBeam, curve: Curve) -> Floats:
        """Size of the velocity [m/s] at the points of a curve, the rate of the same cubics."""
        if not len(self.velocity) or not self.velocity.shape[1]:
            return np.zeros(len(curve.shares))
        moved, _ = beam.evaluate(curve.stations, curve.shares, self.velocity[frame].astype(float))
        rest, _ = beam.evaluate(curve.stations, curve.shares, np.zeros((self.nodes, 4)))
        return np.asarray(np.linalg.norm(moved - rest, axis=1))

    def centre_lines(self) -> Beams:
        """The beams for :class:`percuss.Result.shapes`."""
        native = {}
        for beam in self.beams:
            k = beam.begins
            ends = np.stack([beam.rest[k], beam.rest[k + 1]], axis=1)
            native[beam.name] = (beam.first + k, beam.s[k + 1] - beam.s[k], ends)
        return Beams(native)

    def _require(self) -> None:
        if not len(self):
            raise coded(InputError, "no shapes were kept of this run: run it with record.shapes (or shapes=) above 0", "E210")
