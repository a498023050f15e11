"""The scene in matplotlib: beams to scale, supports, loads and contacts by the usual symbols. Axes are always equal."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, Any

import numpy as np

from ._fields import Fields
from ._scene import Curve, SceneBeam
from ._structure import Floats
from ._symbols import Symbols
from ._words import engineering, position_label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = {
    "beam": "#c9d3de", "outline": "#3d4955", "ghost": "#7d8590", "hatch": "#7d8590", "wall": "#e6e9ed", "symbol": "#59636e",
    "load": "#009e73", "contact": "#d55e00", "body": "#8fb8d8", "page": "#ffffff",
}  # fmt: skip
SYMBOL = 0.025
"""Size of symbols beside that of the structure."""
_FORCES = {"axial": 0, "shear": 1, "moment": 2}
_LEGENDS = {
    "stress": ("largest stress", "Pa"), "axial": ("axial force", "N"), "shear": ("shear force", "N"), "moment": ("moment", "N m"),
    "velocity": ("speed", "m/s"),
}  # fmt: skip


class Drawing:
    """Draws instants of a run on axes; what was drawn before is taken away first."""

    def __init__(self, fields: Fields, ax: Axes, scale: float = 1.0, colour: str = "none") -> None:
        if colour != "none" and colour not in _LEGENDS:
            raise ValueError(f"colour={colour!r}: expected none, stress, velocity, moment, axial or shear")
        if scale != 1.0 and not _can_exaggerate(fields):
            raise ValueError(f"scale={scale}: enlarged displacements would show bodies that overlap and do not; leave it at 1")
        self.fields, self.ax, self.scale, self.colour = fields, ax, scale, colour
        self.low, self.high = bounds(fields, scale)
        self.size = float(max(self.high - self.low))
        self.unit = SYMBOL * self.size
        self._own: list[Any] = []
        self._top = self._largest() if colour != "none" else 0.0
        margin = 0.1 * self.size
        ax.set_aspect("equal", adjustable="box")
        ax.set_xlim(self.low[0] - margin, self.high[0] + margin)
        ax.set_ylim(self.low[1] - margin, self.high[1] + margin)
        ax.set_xlabel(position_label("x", scale))
        ax.set_ylabel(position_label("y", scale))
        if colour != "none":
            self._legend()

    def draw(self, t: float, hide: Collection[str] = ()) -> list[Any]:
        """The scene at a time; impulses are shown in the frames in which they act. Of ``forces``, ``loads``, ``ghost`` any may be
        hidden."""
        if unknown := set(hide) - {"forces", "loads", "ghost"}:
            raise ValueError(f"hide={sorted(unknown)}: expected some of forces, loads, ghost")
        for artist in self._own:
            artist.remove()
        self._own = []
        self.u = self.fields.displacement_at(t)
        self.frame = self.fields.index(t) if len(self.fields) else 0
        self.t = t
        symbols = Symbols(self)
        symbols.obstacles()
        if "ghost" not in hide:
            self._ghost()
        symbols.springs()
        symbols.foundations()
        for beam in self.fields.beams:
            for curve in beam.curves(self.u, self.scale, t=t):
                self._beam(beam, curve)
        symbols.supports()
        symbols.joints_and_masses()
        symbols.bodies()
        if len(self.fields):
            if "loads" not in hide:
                symbols.loads()
            if "forces" not in hide:
                self._forces()
        self.ax.set_title(f"t = {engineering(t, 's')}")
        return self._own

    def line(self, points: Any, colour: str, width: float = 1.2, **style: Any) -> None:
        """A line through points."""
        points = np.asarray(points, float)
        self._own += self.ax.plot(points[:, 0], points[:, 1], color=COLOURS.get(colour, colour), linewidth=width, **style)

    def area(self, points: Any, fill: str, edge: str | None = "outline", width: float = 1.0, **style: Any) -> None:
        """A filled outline."""
        from matplotlib.patches import Polygon

        edge_colour = "none" if edge is None else COLOURS[edge]
        corners, colour = np.asarray(points, float), COLOURS.get(fill, fill)
        patch = Polygon(corners, closed=True, facecolor=colour, edgecolor=edge_colour, linewidth=width, **style)
        self._own.append(self.ax.add_patch(patch))

    def circle(self, centre: Any, radius: float, fill: str, edge: str = "outline", width: float = 1.0) -> None:
        """A disc."""
        from matplotlib.patches import Circle

        patch = Circle((float(centre[0]), float(centre[1])), radius, facecolor=COLOURS[fill], edgecolor=COLOURS[edge], linewidth=width)
        self._own.append(self.ax.add_patch(patch))

    def arrow(self, tail: Any, tip: Any, colour: str, width: float = 1.6) -> None:
        """An arrow between places."""
        style = {"arrowstyle": "-|>", "color": COLOURS[colour], "linewidth": width, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 11}
        self._own.append(self.ax.annotate("", xy=tuple(tip), xytext=tuple(tail), arrowprops=style, annotation_clip=False))

    def on(self, place: dict[str, Any], rest: bool = False) -> tuple[Floats, Floats, float]:
        """Place, tangent and half depth where something sits on a beam."""
        u = np.zeros_like(self.u) if rest else self.u
        beam: SceneBeam = self.fields.beams[place["beam"]]
        return beam.at(place["s"], u, self.scale)

    def _ghost(self) -> None:
        still = np.zeros((self.fields.nodes, 4))
        for beam in self.fields.beams:
            for curve in beam.curves(still):
                self.line(curve.points, "ghost", 1.0, linestyle=(0, (5, 4)))

    def _beam(self, beam: SceneBeam, curve: Curve) -> None:
        thick = bool(np.isfinite(curve.half_depth).all() and curve.half_depth.max() > 0.002 * self.size)
        depth = curve.reach[:, None] * curve.normals
        upper, lower = curve.points + depth, curve.points - depth
        if self.colour != "none":
            self._coloured(beam, curve, (upper, lower) if thick else None)
        if thick:
            outline = np.concatenate([upper, lower[::-1]])
            self.area(outline, "beam" if self.colour == "none" else "none")
        elif self.colour == "none":
            self.line(curve.points, "outline", 2.5)

    def _coloured(self, beam: SceneBeam, curve: Curve, sides: tuple[Floats, Floats] | None) -> None:
        from matplotlib import colormaps
        from matplotlib.collections import LineCollection, PolyCollection

        values = self._values(self.frame, beam, curve)
        each = np.ma.masked_invalid(np.maximum(values[1:], values[:-1]))
        if sides is None:
            lines = np.stack([curve.points[:-1], curve.points[1:]], axis=1)
            made: Any = LineCollection(list(lines), linewidths=4.0)
        else:
            upper, lower = sides
            quads = np.stack([upper[:-1], upper[1:], lower[1:], lower[:-1]], axis=1)
            made = PolyCollection(list(quads), edgecolors="face", linewidths=0.3)
        made.set_array(each)
        # What has no value is drawn as without colours: no depth, or a section that can yield.
        made.set_cmap(colormaps["cividis"].with_extremes(bad=COLOURS["beam"]))
        made.set_clim(0.0, self._top or 1.0)
        self._own.append(self.ax.add_collection(made, autolim=False))

    def _values(self, frame: int, beam: SceneBeam, curve: Curve) -> Floats:
        if self.colour == "stress":
            return self.fields.stress(frame, beam, curve)
        if self.colour == "velocity":
            return self.fields.speed(frame, beam, curve)
        return np.abs(self.fields.section(frame, curve)[:, _FORCES[self.colour]])

    def _largest(self) -> float:
        """Largest value over the run of what colours stand for."""
        self.fields._require()
        if self.colour in _FORCES:
            return self.fields._largest_section(_FORCES[self.colour])
        still, top = np.zeros((self.fields.nodes, 4)), 0.0
        for beam in self.fields.beams:
            for curve in beam.curves(still, pieces=1):
                for frame in range(len(self.fields)):
                    values = self._values(frame, beam, curve)
                    top = max(top, float(np.nanmax(values)) if np.isfinite(values).any() else 0.0)
        return top

    def _legend(self) -> None:
        from matplotlib.cm import ScalarMappable
        from matplotlib.colors import Normalize

        name, unit = _LEGENDS[self.colour]
        if self.colour == "stress" and not any(np.isfinite(beam.half_depth * beam.inertia).any() for beam in self.fields.beams):
            text = "no stress known: sections without depth, or that yield"
            self.ax.text(0.01, 0.02, text, transform=self.ax.transAxes, fontsize="small", color=COLOURS["symbol"])
            return
        if self.colour == "stress" and any(np.isnan(beam.inertia).any() for beam in self.fields.beams):
            name = "stress, elastic beams"
        shown = ScalarMappable(Normalize(0.0, self._top or 1.0), "cividis")
        self.ax.figure.colorbar(shown, ax=self.ax, label=f"{name} [{unit}]", shrink=0.7)

    def _forces(self) -> None:
        top, _ = self.fields.largest
        for contact in self.fields.contacts(self.frame):
            size = float(np.linalg.norm(contact.force))
            if size > 0.004 * top[contact.impulsive]:
                length = self.size * (0.03 + 0.12 * size / top[contact.impulsive])
                self.arrow(contact.position - length * contact.force / size, contact.position, "contact", 2.2)


def bounds(fields: Fields, scale: float = 1.0) -> tuple[Floats, Floats]:
    """Corners of what is shown: everything the beams pass through, and bodies as far as they stay near."""
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    shown = fields.displacement[:: max(1, len(fields) // 300), :, :2] if len(fields) else np.zeros((1, fields.nodes, 2))
    times = np.append(fields.time[:: max(1, len(fields) // 300)] if len(fields) else [0.0], 0.0)
    shown = np.concatenate([shown, np.zeros((1, fields.nodes, 2))])
    for beam in fields.beams:
        places = beam.rest[:, :2] + scale * shown[:, beam.first : beam.first + len(beam.s)]
        places = np.where(beam.loose(times)[:, :, None], beam.rest[:, :2], places)
        depth = float(np.nanmax(beam.half_depth)) if np.isfinite(beam.half_depth).any() else 0.0
        low, high = np.minimum(low, places.min(axis=(0, 1)) - depth), np.maximum(high, places.max(axis=(0, 1)) + depth)
    reach = 0.35 * float(max(high - low)) if fields.beams else np.inf
    near_low, near_high = low - reach, high + reach

    def grow(places: Floats, radius: float = 0.0) -> None:
        nonlocal low, high
        if fields.beams:
            places = places[((places >= near_low) & (places <= near_high)).all(axis=1)]
        if len(places):
            low, high = np.minimum(low, places.min(axis=0) - radius), np.maximum(high, places.max(axis=0) + radius)

    for k, body in enumerate(fields.scene["bodies"]):
        if body["kind"] in ("disc", "guided"):
            grow(np.asarray(body["position"]) + shown[:, fields.stations + k], body.get("radius", 0.0))
    for obstacle in fields.scene["obstacles"]:
        if obstacle["kind"] == "disc":
            grow(np.array([obstacle["centre"]]), obstacle["radius"])
        if obstacle["kind"] == "walls":
            grow(np.array(obstacle["ends"]).reshape(-1, 2))
    for spring in fields.scene["springs"]:
        grow(np.array([end["position"] for end in spring["between"] if "position" in end]).reshape(-1, 2))
    if not np.isfinite(low).all():
        return np.array([-1.0, -1.0]), np.array([1.0, 1.0])
    _grow_by_guided(fields, low, high)
    # A straight structure keeps a margin for what is drawn beside it.
    short = np.maximum(0.18 * float(max(high - low)) - (high - low), 0.0) / 2
    return low - short, high + short


def _grow_by_guided(fields: Fields, low: Floats, high: Floats) -> None:
    """A margin for guided projectiles, whose blocks and springs have the size of symbols."""
    bodies = fields.scene["bodies"]
    unit, still = SYMBOL * float(max(high - low)), np.zeros((fields.nodes, 4))
    for k, body in enumerate(bodies):
        if body["kind"] != "guided":
            continue
        behind = bodies[k + 1]["kind"] == "rear" if k + 1 < len(bodies) else False
        place, _, depth = fields.beams[body["strikes"]["beam"]].at(body["strikes"]["s"], still)
        reach = depth + unit * (8.0 if behind else 4.5)
        tail = place - reach * np.array(body["direction"], float)
        np.minimum(low, tail, out=low)
        np.maximum(high, tail, out=high)


def _can_exaggerate(fields: Fields) -> bool:
    guided = {b["name"] for b in fields.scene["bodies"] if b["kind"] in ("guided", "rear")}
    return all(guided & set(contact["between"]) for contact in fields.scene["contacts"])
