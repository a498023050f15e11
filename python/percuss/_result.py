"""What a run leaves."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _arrow, _percuss
from ._columns import Columns
from ._errors import InputError, coded
from ._fields import Fields
from ._structure import Shapes
from ._words import engineering

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.animation import FuncAnimation

    from ._plot import Plots

Column = NDArray[np.float64]


class Result(Columns[np.float64]):
    """A run: ``result["contact.mass.force"]`` is a column of its history as an array.

    Arrays are those that the run filled, without a copy, and cannot be written to. pyarrow, pandas and polars take a result
    as a table: ``pyarrow.table(result)``, ``pandas.DataFrame(result)``, ``polars.DataFrame(result)``.
    """

    def __init__(self, state: dict[str, Any]) -> None:
        self.__setstate__(state)

    @classmethod
    def _of(cls, native: dict[str, Any]) -> Result:
        return cls(native)

    def __getstate__(self) -> dict[str, Any]:
        return self._native

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._native = state
        self._columns: dict[str, Column] = dict(zip(state["names"], state["columns"]))
        fields = state["fields"] or {}
        for array in [*state["columns"], *(a for a in fields.values() if isinstance(a, np.ndarray))]:
            array.flags.writeable = False  # lost on the way through a pickle

    def __reduce__(self) -> tuple[Any, ...]:
        return (Result, (self._native,))

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns of the history."""
        return tuple(self._native["names"])

    @property
    def units(self) -> dict[str, str]:
        """Unit of every column."""
        return dict(zip(self._native["names"], self._native["units"]))

    @property
    def descriptions(self) -> dict[str, str]:
        """What every column holds."""
        return dict(zip(self._native["names"], self._native["descriptions"]))

    @property
    def time(self) -> Column:
        """Times of the rows [s]."""
        return self._columns["time"]

    def __len__(self) -> int:
        """Number of rows."""
        return len(self.time)

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What the run amounts to, as in ``summary.json``; see docs/results.md."""
        summary: dict[str, Any] = json.loads(self._native["summary"])
        return summary

    @property
    def status(self) -> str:
        """``completed``, ``interrupted`` or ``failed``."""
        return str(self.summary["status"])

    @property
    def scenario(self) -> str:
        """The scenario that was run, as a file with every default written out."""
        return str(self._native["scenario"])

    @property
    def shapes(self) -> Shapes:
        """Shapes of the structure over time, those of the frames that were kept."""
        fields = self.fields
        return Shapes(fields.centre_lines(), fields.time, fields.displacement[:, : fields.stations].astype(np.float64))

    @cached_property
    def fields(self) -> Fields:
        """The scene and how it moved: what is drawn, animated and exported."""
        if self._native["fields"] is None:
            raise coded(InputError, "this run has no fields/: run its scenario again with record.shapes above 0", "E210")
        return Fields(self._native["fields"])

    @property
    def story(self) -> str:
        """What happened, in a few sentences."""
        return _percuss.story(self._native["summary"])

    @property
    def plot(self) -> Plots:
        """Figures: ``result.plot()`` draws the scene; ``result.plot.energy()``, ``.force()``, ``.displacement()`` draw curves."""
        from ._plot import Plots

        return Plots(self)

    def animate(self, path: str | os.PathLike[str] | None = None, **options: Any) -> FuncAnimation:
        """The scene in motion, with the options of ``result.plot.animation``; ``path`` keeps it as a film (``hit.gif``,
        ``hit.mp4``)."""
        return self.plot.animation(path=path, **options)

    def export(self, directory: str | os.PathLike[str], format: str = "vtkhdf") -> list[str]:
        """Writes how the scene moved for ParaView into a directory of its own; the names of the files to open. ``vtkhdf`` is for
        ParaView 5.12 and later, ``pvd``, a file an instant, for all."""
        if self._native["fields"] is None:
            self.fields  # says why there are none
        return _percuss.export(self._native["fields"], directory, format)

    def to_pandas(self) -> pandas.DataFrame:
        """The history as a table of pandas, one row a recorded step; ``attrs`` holds units and descriptions."""
        return self._to_pandas(self.units, self.descriptions)

    def to_xarray(self) -> xarray.Dataset:
        """The history over ``time`` and the frames over ``instant`` as a data set of xarray, units as attributes."""
        from ._tables import dataset

        return dataset(self)

    def filtered(self, column: str, cfc: int | None = 180) -> xarray.DataArray:
        """An acceleration, such as ``point.tip.acceleration_2``, in a channel frequency class of SAE J211 and ISO 6487 (60, 180, 600,
        1000; None leaves it as it is) [m/s^2]: means over recorded steps, at the middle of them."""
        from ._shock import filtered

        return filtered(self, column, cfc)

    def shock_spectrum(
        self,
        column: str,
        damping: float = 0.05,
        *,
        from_: float = 1.0,
        to: float | None = None,
        per_octave: float = 12.0,
        cfc: int | None = None,
    ) -> xarray.Dataset:
        """Shock response spectrum of an acceleration over natural frequencies from ``from_`` to ``to`` [Hz] (by default 10 kHz, or a
        tenth of the sampling where that is less): primary, residual and maximax absolute accelerations, pseudo-velocities and
        relative displacements."""
        from ._shock import shock_spectrum

        return shock_spectrum(self, column, damping, (from_, to, per_octave), cfc)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return _arrow.table(self).__arrow_c_stream__(requested_schema)

    def __arrow_c_schema__(self) -> object:
        return _arrow.table(self).schema.__arrow_c_schema__()

    def __repr__(self) -> str:
        residual = self.summary["energy"]["residual_max"]
        title = self.summary["title"]
        return (
            f"<percuss.Result {title + ': ' if title else ''}{self.status}, {len(self)} rows, "
            f"{len(self.columns)} columns, energy residual {residual:.1e}>"
        )

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><th>{escape(what)}</th><td>{escape(value)}</td></tr>" for what, value in self._facts())
        title = escape(self.summary["title"] or "percuss run")
        return f"{self._scene()}<table><caption><b>{title}</b></caption><tbody>{rows}</tbody></table>"

    def _scene(self) -> str:
        """The scene in motion, in a frame of its own: its scripts and styles touch nothing else of the notebook."""
        fields = self._native["fields"]
        page = _percuss.scene_page(fields, self._native["summary"]) if fields is not None else None
        if page is None:
            return ""
        return (
            f'<iframe srcdoc="{escape(page)}" sandbox="allow-scripts allow-downloads" title="The scene in motion" '
            'style="width: 100%; height: 560px; border: 0"></iframe>'
        )

    def _facts(self) -> Iterator[tuple[str, str]]:
        """What is worth a line."""
        run = self.summary
        yield "status", f"{run['status']} at t = {run['time']:.6g} s, {run['steps']} steps"
        if "error" in run:
            yield "error", f"{run['error']} [{run['error_code']}]" if "error_code" in run else run["error"]
        energy, momentum = run["energy"], run["momentum"]
        yield "energy", f"{engineering(energy['initial'], 'J')} to {engineering(energy['final'], 'J')}"
        yield (
            "balance, residuals (relative)",
            f"energy {energy['residual_max']:.1e}, linear momentum {momentum['linear_residual_max']:.1e}, "
            f"angular {momentum['angular_residual_max']:.1e}",
        )
        for name, contact in run["contact"].items():
            if "peak_force" in contact and contact["peak_force"]["value"] is not None:
                peak = contact["peak_force"]
                yield f"contact {name}", f"peak force {engineering(peak['value'], 'N')} at {engineering(peak['time'], 's')}"
            elif "impact_count" in contact:
                yield f"contact {name}", f"{contact['impact_count']} impacts"
        for name, point in run["point"].items():
            peaks = [point["displacement_max"][f"component_{i}"]["value"] or 0.0 for i in (1, 2)]
            # Beside the larger one, round-off is nothing.
            told = [engineering(peak if abs(peak) > 1e-9 * max(map(abs, peaks)) else 0.0, "m") for peak in peaks]
            yield f"point {name}", f"largest displacements {told[0]} along e1, {told[1]} along e2"
        yield "history", f"{len(self)} rows, {len(self.columns)} columns"

