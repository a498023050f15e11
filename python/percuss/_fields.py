"""The scene of a run and its motion, for drawings, animations and exports."""

from __future__ import annotations

import json
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._scene import Contact, Curve, SceneBeam
from ._structure import Beams, Floats, index_at, require_within

Singles = NDArray[np.float32]


class Fields:
    """The scene and its frames, ``result.fields``.

    Attributes
    ----------
    time : ndarray of shape (n_frame,)
        Times of the frames [s].
    displacement : ndarray of shape (n_frame, n_node, 4)
        (u1, u2, u1', u2') of the stations of all beams [m, 1], then (u1, u2, angle, 0) of the bodies [m, rad].
    velocity : ndarray of shape (n_frame, n_node, 4)
        Velocities of the same [m/s, 1/s, rad/s]; no nodes where they were not kept.
    angular_velocity : ndarray of shape (n_frame, n_interval, 3)
        Angular velocity of the sections at the start, in the middle and at the end of every interval [rad/s], the one whose energy
        is conserved with that of `velocity`; no intervals where it was not kept.
    section_forces : ndarray of shape (n_frame, n_interval, 2, 3)
        (axial force [N], shear force [N], moment [N m]) at both ends of every interval; tension is positive,
        V = dM/ds. Between them :meth:`section` gives them.
    load_factors : ndarray of shape (n_frame, n_load)
        Factors of the loads [1].

    Examples
    --------
    >>> fields = percuss.run("plank.toml").fields
    >>> len(fields), fields.section_forces.shape
    (751, (751, 8, 2, 3))
    """

    def __init__(self, native: dict[str, Any]) -> None:
        self._native = native
        self.time: Floats = native["time"]
        self.displacement: Singles = native["displacement"]
        self.velocity: Singles = native["velocity"]
        self.angular_velocity: Singles = native["angular_velocity"]
        self.section_forces: Singles = native["section_forces"]
        self.load_factors: Singles = native["load_factors"]

    def __len__(self) -> int:
        return len(self.time)

    @cached_property
    def scene(self) -> dict[str, Any]:
        """Content, as in ``fields/scene.json``.

        Returns
        -------
        dict
            Beams, bodies, obstacles, supports, joints, springs, masses, loads and contacts, in SI units.

        Examples
        --------
        >>> [support["name"] for support in percuss.run("plank.toml").fields.scene["supports"]]
        ['left', 'right']
        """
        scene: dict[str, Any] = json.loads(self._native["scene"])
        return scene

    @cached_property
    def beams(self) -> list[SceneBeam]:
        """The beams.

        Returns
        -------
        list of SceneBeam
            In the order of the scenario.

        Examples
        --------
        >>> [beam.name for beam in percuss.run("plank.toml").fields.beams]
        ['plank']
        """
        out: list[SceneBeam] = []
        for value in self.scene["beams"]:
            first = out[-1].first + len(out[-1].s) if out else 0
            interval = int(out[-1].numbers[-1]) + 1 if out else 0
            out.append(SceneBeam(value, first, interval))
        for gap in self.scene.get("parted", []):
            out[gap["beam"]].gaps.append((*gap["stretch"], gap["time"]))
        return out

    @property
    def stations(self) -> int:
        """Number of nodes that belong to beams.

        Returns
        -------
        int
            They stand before those of bodies.

        Examples
        --------
        >>> percuss.run("plank.toml").fields.stations
        9
        """
        return self.beams[-1].first + len(self.beams[-1].s) if self.beams else 0

    @property
    def nodes(self) -> int:
        """Number of nodes of the scene.

        Returns
        -------
        int
            Stations of beams and bodies.

        Examples
        --------
        >>> percuss.run("plank.toml").fields.nodes
        10
        """
        return self.stations + len(self.scene["bodies"])

    def index(self, t: float) -> int:
        """The frame nearest to a time.

        Parameters
        ----------
        t : float
            The time [s].

        Returns
        -------
        int
            Into ``time``.

        Raises
        ------
        InputError
            If no frames were kept, or the time is outside the run.

        Examples
        --------
        >>> percuss.run("plank.toml").fields.index(0.02)
        100
        """
        return index_at(self.time, t)

    def instant_shown(self, t: float) -> float:
        """The instant at which a drawing shows an event.

        Parameters
        ----------
        t : float
            Time of the event [s].

        Returns
        -------
        float
            The time itself; before a frame with impulses that of the frame, since impulses are in the frame after an impact [s].

        Examples
        --------
        >>> percuss.run("plank.toml").fields.instant_shown(0.02)
        0.02
        """
        if not len(self):
            return t
        after = int(np.searchsorted(self.time, t, side="right"))

        def strikes(frame: int) -> bool:
            return 0 <= frame < len(self) and any(c.impulsive for c in self.contacts(frame))

        here = after > 0 and self.time[after - 1] == t and strikes(after - 1)
        return float(self.time[after]) if strikes(after) and not here else t

    def displacement_at(self, t: float) -> Floats:
        """Displacements at a time, straight between frames.

        Parameters
        ----------
        t : float
            The time [s].

        Returns
        -------
        ndarray of shape (n_node, 4)
            As ``displacement`` [m, 1]; zeros where no frames were kept.

        Raises
        ------
        InputError
            If the time is outside the run.

        Examples
        --------
        >>> u = percuss.run("plank.toml").fields.displacement_at(0.02)
        >>> round(1000 * float(u[4, 1]), 2)  # mm, in the middle
        -2.55
        """
        if not len(self):
            return np.zeros((self.nodes, 4))
        require_within(self.time, t)
        b = int(np.clip(np.searchsorted(self.time, t), 1, max(len(self) - 1, 1)))
        a, b = b - 1, min(b, len(self) - 1)
        span = self.time[b] - self.time[a]
        share = float(np.clip((t - self.time[a]) / span, 0.0, 1.0)) if span > 0 else 0.0
        return np.asarray((1 - share) * self.displacement[a].astype(float) + share * self.displacement[b].astype(float))

    @cached_property
    def _offsets(self) -> NDArray[np.int64]:
        return np.concatenate([[0], np.cumsum(self._native["contact_counts"])]).astype(np.int64)

    def contacts(self, frame: int) -> list[Contact]:
        """Contact points of a frame.

        Parameters
        ----------
        frame : int
            Its number.

        Returns
        -------
        list of Contact
            Places, forces and impulses; a contact that transmits an impact may have both.

        Raises
        ------
        IndexError
            If there is no such frame.

        Examples
        --------
        >>> percuss.run("plank.toml").fields.contacts(0)
        []
        """
        frame = range(len(self))[frame]
        bodies = {b["name"] for b in self.scene["bodies"] + self.scene["obstacles"]}
        out = []
        for number, x, y, f, g, impulsive in self._native["contact_forces"][self._offsets[frame] : self._offsets[frame + 1]]:
            contact = self.scene["contacts"][int(number)]
            first, second = contact["between"]
            sign = -1.0 if second in bodies and first not in bodies else 1.0
            out.append(Contact(contact["name"], np.array([x, y], float), sign * np.array([f, g], float), bool(impulsive > 0.5)))
        return out

    @cached_property
    def largest(self) -> tuple[dict[bool, float], float | None]:
        """Scale of the arrows of contact forces.

        Returns
        -------
        (dict of float, float or None)
            Largest force [N] and impulse [N s] at one place, by whether it is an impulse; time [s] of the largest resultant of a contact.

        Examples
        --------
        >>> size, time = percuss.run("plank.toml").fields.largest
        >>> round(size[False]), round(time, 4)
        (2561, 0.0306)
        """
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
        """Axial force, shear force and moment at the points of a curve.

        Parameters
        ----------
        frame : int
            Number of the frame.
        curve : Curve
            Of a beam of the scene.

        Returns
        -------
        ndarray of shape (n, 3)
            Forces and moment [N, N, N m].

        Examples
        --------
        >>> fields = percuss.run("plank.toml").fields
        >>> curve = fields.beams[0].curves(fields.displacement_at(0.02))[0]
        >>> round(float(abs(fields.section(fields.index(0.02), curve)[:, 2]).max()))  # N m
        214
        """
        out = np.empty((len(curve.shares), 3))
        for interval in np.unique(curve.intervals):
            own = curve.intervals == interval
            shares, forces = self._vertices(frame, int(interval))
            # Of two vertices at one place the second counts: the values just ahead of a jump.
            after = np.clip(np.searchsorted(shares, curve.shares[own], side="right"), 1, len(shares) - 1)
            long = shares[after] - shares[after - 1]
            along = np.where(long > 0, (curve.shares[own] - shares[after - 1]) / np.where(long > 0, long, 1.0), 1.0)[:, None]
            out[own] = (1 - along) * forces[after - 1] + along * forces[after]
        return out

    def _vertices(self, frame: int, interval: int) -> tuple[Floats, Floats]:
        """Section forces along an interval: shares of the way and forces of the vertices of straight lines; two at a place where they jump."""
        from_, to = self._point_offsets[frame], self._point_offsets[frame + 1]
        rows = self._native["section_points"][from_:to].astype(float)
        rows = rows[rows[:, 0] == interval]
        ends = self.section_forces[frame][interval].astype(float)
        shares = np.concatenate([[0.0], rows[:, 1], [1.0]])
        return shares, np.concatenate([ends[:1], rows[:, 2:], ends[1:]])

    @cached_property
    def _point_offsets(self) -> NDArray[np.int64]:
        return np.concatenate([[0], np.cumsum(self._native["point_counts"])]).astype(np.int64)

    def _largest_section(self, which: int) -> float:
        """Largest axial force, shear force or moment of the run [N, N, N m]: that of the summary, which may be between two frames; else of the frames."""
        name = ("axial", "shear", "moment")[which]
        noted = [beam.get("largest", {}).get(name) for beam in self.scene["beams"]]
        if noted and all(value is not None for value in noted):
            return float(max(noted))
        inside = self._native["section_points"][:, 2 + which]
        return float(max(np.abs(self.section_forces[..., which]).max(initial=0.0), np.abs(inside).max(initial=0.0)))

    def stress(self, frame: int, beam: SceneBeam, curve: Curve) -> Floats:
        """Largest normal stress of the fibres at the points of a curve.

        Parameters
        ----------
        frame : int
            Number of the frame.
        beam : SceneBeam
            A beam of the scene.
        curve : Curve
            Of that beam.

        Returns
        -------
        ndarray of shape (n,)
            Stress [Pa]; NaN where the depth is not known or the section can yield, where it does not follow from forces.

        Examples
        --------
        >>> fields = percuss.run("plank.toml").fields
        >>> beam, frame = fields.beams[0], fields.index(0.02)
        >>> curve = beam.curves(fields.displacement_at(0.02))[0]
        >>> round(float(fields.stress(frame, beam, curve).max()) / 1e6, 1)  # MPa
        44.6
        """
        forces, k, share = self.section(frame, curve), curve.stations, curve.shares
        area = (1 - share) * beam.area[k] + share * beam.area[k + 1]
        inertia = (1 - share) * beam.inertia[k] + share * beam.inertia[k + 1]
        return np.asarray(np.abs(forces[:, 0]) / area + np.abs(forces[:, 2]) * curve.half_depth / inertia)

    def speed(self, frame: int, beam: SceneBeam, curve: Curve) -> Floats:
        """Size of the velocity at the points of a curve, the rate of the same cubics.

        Parameters
        ----------
        frame : int
            Number of the frame.
        beam : SceneBeam
            A beam of the scene.
        curve : Curve
            Of that beam.

        Returns
        -------
        ndarray of shape (n,)
            Speed [m/s]; zero where velocities were not kept.

        Examples
        --------
        >>> fields = percuss.run("plank.toml").fields
        >>> beam, frame = fields.beams[0], fields.index(0.02)
        >>> curve = beam.curves(fields.displacement_at(0.02))[0]
        >>> round(float(fields.speed(frame, beam, curve).max()), 2)
        0.59
        """
        if not len(self.velocity) or not self.velocity.shape[1]:
            return np.zeros(len(curve.shares))
        moved, _ = beam.evaluate(curve.stations, curve.shares, self.velocity[frame].astype(float))
        rest, _ = beam.evaluate(curve.stations, curve.shares, np.zeros((self.nodes, 4)))
        return np.asarray(np.linalg.norm(moved - rest, axis=1))

    def centre_lines(self) -> Beams:
        """The beams as :attr:`Result.shapes` takes them.

        Returns
        -------
        Beams
            Centre lines between stations.

        Examples
        --------
        >>> percuss.run("plank.toml").fields.centre_lines().names
        ('plank',)
        """
        native = {}
        for beam in self.beams:
            k = beam.begins
            ends = np.stack([beam.rest[k], beam.rest[k + 1]], axis=1)
            native[beam.name] = (beam.first + k, beam.s[k + 1] - beam.s[k], ends)
        return Beams(native)

    def _require(self) -> None:
        require_within(self.time)
