"""Symbols of supports, bodies, obstacles and loads, as engineers draw them; part of the drawing."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._structure import Floats

if TYPE_CHECKING:
    from ._drawing import Drawing


def left_of(v: Any) -> Floats:
    """A vector turned by a right angle to the left."""
    return np.array([-v[1], v[0]], float)


class Symbols:
    """Symbols of one instant, in sizes that follow the structure's."""

    def __init__(self, drawing: Drawing) -> None:
        self.drawing = drawing
        self.scene = drawing.fields.scene
        self.unit = drawing.unit

    def supports(self) -> None:
        """By their kinds, as long as they act."""
        for support in self.scene["supports"]:
            if support["until"] is not None and self.drawing.t > support["until"]:
                continue
            place, tangent, depth = self.drawing.on(support["at"])
            kind = support["kind"]
            if kind in ("clamp", "guide"):
                self._clamp(support, place, tangent, depth)
            elif kind in ("pin", "roller"):
                self._triangle(support, place, tangent)
            elif kind == "elastic":
                self._elastic(support, place)
            else:
                self._stop(support, place)

    def _hatch(self, a: Floats, b: Floats, into: Floats) -> None:
        """Strokes behind a line, on the side of ``into``."""
        length = float(np.linalg.norm(b - a))
        count = max(2, int(length / (0.5 * self.unit)))
        along = (b - a) / max(length, 1e-300)
        size = 0.5 * self.unit
        for x in (np.arange(count) + 0.5) * length / count:
            start = a + x * along
            self.drawing.line([start, start + size * (into - 0.6 * along)], "hatch", 0.8)

    def _plate(self, centre: Floats, into: Floats, half: float) -> None:
        """A hatched line across ``into``."""
        across = left_of(into)
        a, b = centre + half * across, centre - half * across
        self.drawing.line([a, b], "symbol", 1.8)
        self._hatch(a, b, into)

    def _clamp(self, support: dict[str, Any], place: Floats, tangent: Floats, depth: float) -> None:
        beam = self.drawing.fields.beams[support["at"]["beam"]]
        into = tangent if support["at"]["s"] > 0.5 * beam.s[-1] else -tangent
        self._plate(place, into, max(1.3 * self.unit, depth + 0.5 * self.unit))

    def _triangle(self, support: dict[str, Any], place: Floats, tangent: Floats) -> None:
        if support["kind"] == "roller":
            down = left_of(support["direction"])
        else:
            down = left_of(tangent) if abs(tangent[1]) > 0.8 else np.array([0.0, -1.0])
        if down[1] > 1e-9 or (abs(down[1]) <= 1e-9 and down[0] > 0):
            down = -down
        across, size = left_of(down), self.unit
        a, b = (place + 1.4 * size * down + side * 0.8 * size * across for side in (1, -1))
        self.drawing.area([place, a, b], "page", "symbol", 1.4, zorder=3)
        if support["kind"] == "roller":
            off = 0.4 * size * down
            self.drawing.line([a + off, b + off], "symbol", 1.4)
        else:
            self._hatch(a, b, down)

    def _elastic(self, support: dict[str, Any], place: Floats) -> None:
        rest, _, _ = self.drawing.on(support["at"], rest=True)
        d = np.array(support["direction"], float)
        if d[1] > 1e-9 or (abs(d[1]) <= 1e-9 and d[0] > 0):
            d = -d
        end = rest + 2.4 * self.unit * d
        self.coil(place, end)
        self._plate(end, d, self.unit)

    def _stop(self, support: dict[str, Any], place: Floats) -> None:
        """A plate where the free way ends, on a spring to ground."""
        rest, _, depth = self.drawing.on(support["at"], rest=True)
        for side in (1.0, -1.0) if support["two_sided"] else (1.0,):
            d = side * np.array(support["direction"], float)
            way = max(support["gap"], float((place - rest) @ d))
            plate, ground = rest + (way + depth) * d, rest + (support["gap"] + depth + 2.0 * self.unit) * d
            across = self.unit * left_of(d)
            self.drawing.line([plate - across, plate + across], "symbol", 1.8)
            self.coil(plate, ground)
            self._plate(ground, d, self.unit)

    def coil(self, a: Any, b: Any, colour: str = "symbol") -> None:
        """A spring as a zigzag."""
        a, b = np.asarray(a, float), np.asarray(b, float)
        across = 0.35 * self.unit * left_of((b - a) / max(float(np.linalg.norm(b - a)), 1e-300))
        inner = [a + k / 10 * (b - a) + (1 if k % 2 else -1) * across for k in range(1, 10)]
        self.drawing.line([a, *inner, b], colour)

    def springs(self) -> None:
        """Springs and dampers between points."""
        for spring in self.scene["springs"]:
            until = spring.get("until")
            if until is not None and until <= self.drawing.t:
                continue
            ends = [self._end(end) for end in spring["between"]]
            if spring["springs"]:
                self.coil(ends[0], ends[1])
            else:
                self.drawing.line(ends, "symbol", 2.5, linestyle=(0, (1, 1)))
            for end, place in zip(spring["between"], ends):
                if "position" in end:
                    self.drawing.circle(place, 0.25 * self.unit, "symbol", "symbol")

    def foundations(self) -> None:
        """Springs from a beam to a hatched line, on the side away from which its foundation pushes.

        Those of compression alone stay behind where the beam lifts off.
        """
        for foundation in self.scene.get("foundations", []):
            start, end = foundation["stretch"]
            pieces = int(np.clip(round((end - start) / (3.5 * self.unit)), 1, 24))
            last: Floats | None = None
            # Springs in the middle of pieces, the hatched line from end to end.
            for number, s in enumerate(np.linspace(start, end, 2 * pieces + 1)):
                place = {"beam": foundation["beam"], "s": float(s)}
                rest, tangent, depth = self.drawing.on(place, rest=True)
                push = np.array(foundation["direction"] or left_of(tangent), float)
                foot = rest - (depth + 2.0 * self.unit) * push
                if number % 2:
                    top = self.drawing.on(place)[0]
                    lifted = foundation["lifts"] and (top - rest) @ push > 0
                    self.coil(rest - depth * push if lifted else top, foot)
                    continue
                if last is not None:
                    self.drawing.line([last, foot], "symbol", 1.4)
                    self._hatch(last, foot, -push)
                last = foot

    def _end(self, end: dict[str, Any]) -> Floats:
        """An end of a spring: fixed in space, at the centre of a body, or on a beam."""
        if "position" in end:
            return np.array(end["position"], float)
        if "body" in end:
            u = self.drawing.u[self.drawing.fields.stations + end["body"]]
            place: Floats = np.array(self.scene["bodies"][end["body"]]["position"], float) + u[:2]
            return place
        return self.drawing.on(end)[0]

    def joints_and_masses(self) -> None:
        """Hinges, and masses fixed to beams."""
        for joint in self.scene["joints"]:
            until = joint.get("until")
            if joint["turns"] and (until is None or self.drawing.t < until):
                self.drawing.circle(self.drawing.on(joint["at"])[0], 0.35 * self.unit, "page", "outline", 1.4)
        for mass in self.scene["masses"]:
            self.drawing.circle(self.drawing.on(mass["at"])[0], 0.5 * self.unit, "body")

    def obstacles(self) -> None:
        """Walls, discs and half planes, where they are now."""
        for obstacle in self.scene["obstacles"]:
            body = obstacle["body"]
            moved = np.zeros(2) if body is None else self.drawing.u[self.drawing.fields.stations + body, :2]
            if obstacle["kind"] == "disc":
                self.drawing.circle(moved + obstacle["centre"], obstacle["radius"], "wall", "hatch", 1.4)
            elif obstacle["kind"] == "walls":
                for wall in obstacle["ends"]:
                    self._wall(moved + wall[0], moved + wall[1], obstacle["thickness"])
            else:
                self._behind(moved + obstacle["point"], np.array(obstacle["normal"], float))

    def _wall(self, a: Floats, b: Floats, thickness: float) -> None:
        half = max(0.5 * thickness, 0.1 * self.unit) * left_of((b - a) / max(float(np.linalg.norm(b - a)), 1e-300))
        self.drawing.area([a + half, a - half, b - half, b + half], "hatch", None)

    def _behind(self, point: Floats, normal: Floats) -> None:
        """A straight edge with what lies behind it."""
        along, size = left_of(normal), self.drawing.size
        middle = 0.5 * (self.drawing.low + self.drawing.high)
        at = point + float((middle - point) @ along) * along
        a, b = at - 1.5 * size * along, at + 1.5 * size * along
        self.drawing.area([a, b, b - 3 * size * normal, a - 3 * size * normal], "wall", None, zorder=0)
        self.drawing.line([a, b], "hatch", 1.4)
        self._hatch(at - 0.75 * size * along, at + 0.75 * size * along, -normal)

    def bodies(self) -> None:
        """Discs with a spoke that turns; guided projectiles as blocks before what they strike."""
        fields = self.drawing.fields
        bodies = self.scene["bodies"]
        for k, body in enumerate(bodies):
            u = self.drawing.u[fields.stations + k]
            if body["kind"] == "disc":
                centre, radius = np.array(body["position"]) + u[:2], body["radius"]
                self.drawing.circle(centre, radius, "body")
                self.drawing.line([centre, centre + radius * np.array([np.cos(u[2]), np.sin(u[2])])], "outline")
            elif body["kind"] == "guided":
                front = self._guided(body, u[:2])
                if k + 1 < len(bodies) and bodies[k + 1]["kind"] == "rear":
                    self._rear(body, front, self.drawing.u[fields.stations + k + 1, :2] - u[:2])

    def _guided(self, body: dict[str, Any], u: Floats) -> Floats:
        """A mass at its true gap from the beam's surface, behind its spring if it has one; where its front is."""
        struck, _, depth = self.drawing.on(body["strikes"])
        d = np.array(body["direction"], float)
        beam = self.drawing.fields.beams[body["strikes"]["beam"]]
        true, _, _ = beam.at(body["strikes"]["s"], self.drawing.u)
        rest, _, _ = self.drawing.on(body["strikes"], rest=True)
        gap = float(body["standoff"] + (true - rest) @ d - u @ d)
        surface = struck - (depth + max(gap, 0.0)) * d
        free = 2.4 * self.unit if body["elastic"] else 0.0
        front = np.asarray(surface - (free - min(0.7 * free, max(-gap, 0.0))) * d)
        if body["elastic"]:
            self.coil(front, surface, "outline")
        self._block(front, d)
        return front

    def _rear(self, guided: dict[str, Any], front: Floats, lag: Floats) -> None:
        """The mass behind it, as far as both have moved towards each other."""
        d = np.array(guided["direction"], float)
        back = front - 1.6 * self.unit * d
        at = back - max(2.0 * self.unit - float(lag @ d), 0.8 * self.unit) * d
        self.coil(at, back, "outline")
        self._block(at, d)

    def _block(self, front: Floats, d: Floats) -> None:
        half, n = 0.8 * self.unit, left_of(d)
        self.drawing.area([front + half * n, front - half * n, front - half * (n + 2 * d), front + half * (n - 2 * d)], "body")

    def loads(self) -> None:
        """Arrows as long as a load is strong beside the strongest of its kind."""
        loads = self.scene["loads"]
        points = [float(np.linalg.norm(load["force"])) for load in loads if load["kind"] == "point"]
        spread = [float(np.linalg.norm(f)) for load in loads if load["kind"] == "distributed" for f in load["force"]]
        most = {"point": max(points, default=0.0), "distributed": max(spread, default=0.0)}
        for load, factor in zip(loads, self.drawing.fields.load_factors[self.drawing.frame].astype(float)):
            if factor == 0.0:
                continue
            if load["kind"] == "point":
                self._point_load(load, float(factor), most["point"])
            elif load["kind"] == "distributed":
                self._distributed_load(load, float(factor), most["distributed"])
            elif load["kind"] == "strain":
                start, end = load["stretch"]
                places = np.linspace(float(start), float(end), 25)
                axis = [self.drawing.on({"beam": load["beam"], "s": float(s)})[0] for s in places]
                self.drawing.line(axis, "load", 1.4, linestyle=(0, (2, 2)))
            else:
                self._acceleration(load, float(factor))

    def _direction(self, load: dict[str, Any], force: Any, tangent: Floats) -> Floats:
        force = np.asarray(force, float)
        return np.asarray(force[0] * tangent + force[1] * left_of(tangent)) if load["follower"] else force

    def _acceleration(self, load: dict[str, Any], factor: float) -> None:
        # Gravity at the corner, the acceleration of the base beside it.
        g = np.sign(factor) * np.array(load["acceleration"], float)
        if (size := float(np.linalg.norm(g))) > 0:
            aside = 4.0 * self.unit if load["kind"] == "base" else 0.0
            tip = np.array([self.drawing.high[0] - aside, self.drawing.low[1]]) + 1.2 * self.unit * g / size
            self.drawing.arrow(tip - 2.4 * self.unit * g / size, tip, "load", 1.4)

    def _point_load(self, load: dict[str, Any], factor: float, most: float) -> None:
        tip, tangent, _ = self.drawing.on(load["at"])
        force = self._direction(load, load["force"], tangent)
        if (size := float(np.linalg.norm(force))) > 0:
            length = np.sign(factor) * self.unit * (1.0 + 3.0 * min(1.0, abs(factor)) * size / most)
            self.drawing.arrow(tip - length * force / size, tip, "load", 1.8)
        if load["moment"]:
            turn = np.sign(load["moment"] * factor)
            angle = turn * np.linspace(-0.6, 3.6, 24)
            arc = tip + 1.3 * self.unit * np.stack([np.cos(angle), np.sin(angle)], axis=1)
            self.drawing.line(arc[:-1], "load", 1.6)
            self.drawing.arrow(arc[-4], arc[-1], "load", 1.6)

    def _distributed_load(self, load: dict[str, Any], factor: float, most: float) -> None:
        tails = []
        for share in np.linspace(0.0, 1.0, 13):
            s = (1 - share) * load["stretch"][0] + share * load["stretch"][1]
            place, tangent, depth = self.drawing.on({"beam": load["beam"], "s": s})
            force = (1 - share) * np.array(load["force"][0], float) + share * np.array(load["force"][1], float)
            force = np.sign(factor) * self._direction(load, force, tangent)
            size = float(np.linalg.norm(force))
            d = force / size if size > 0 else np.zeros(2)
            tip = place - depth * d
            length = self.unit * (0.4 + 1.4 * min(1.0, abs(factor)) * size / most) if size > 0 else 0.0
            tails.append(tip - length * d)
            if length > 0.45 * self.unit:
                self.drawing.arrow(tails[-1], tip, "load", 1.0)
        self.drawing.line(tails, "load", 1.0)
