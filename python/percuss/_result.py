"""Results of a run."""

from __future__ import annotations

import json
import os
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _percuss
from ._columns import read_only
from ._errors import InputError, coded
from ._fields import Fields
from ._history import History
from ._outcome import raise_for_status
from ._structure import Shapes

if TYPE_CHECKING:
    import xarray
    from matplotlib.animation import FuncAnimation

    from ._plot import Plots


class Result(History):
    """A run: ``result["contact.mass.force"]`` is a column of its history as an array.

    Arrays are those that the run filled, without a copy, and cannot be written to. pyarrow, pandas and polars take a result
    as a table: ``pyarrow.table(result)``, ``polars.DataFrame(result)``, ``result.to_pandas()``.

    Examples
    --------
    >>> percuss.run("plank.toml")
    <percuss.Result A sandbag falls on a plank: completed, 751 rows, 50 columns, energy residual ...>
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
        self._columns = dict(zip(state["names"], state["columns"]))
        read_only([state["columns"], state["fields"]])

    def __reduce__(self) -> tuple[Any, ...]:
        return (Result, (self._native,))

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Summary of the run, as in ``summary.json``; see docs/results.md.

        Returns
        -------
        dict
            By the names of docs/results.md, in SI units.

        Examples
        --------
        >>> peak = percuss.run("plank.toml").summary["contact"]["bag"]["peak_force"]
        >>> round(peak["value"]), round(peak["time"], 4)  # N, s
        (2561, 0.0305)
        """
        summary: dict[str, Any] = json.loads(self._native["summary"])
        return summary

    @property
    def status(self) -> str:
        """Status at the end of the run.

        Returns
        -------
        str
            ``completed``, ``interrupted`` or ``failed``.

        Examples
        --------
        >>> percuss.run("plank.toml").status
        'completed'
        """
        return str(self.summary["status"])

    @property
    def path(self) -> str:
        """Directory of the files of the run.

        A run that did not complete does not replace a complete one: its files lie beside it, in ``plank.incomplete``.

        Returns
        -------
        str
            Where they lie; empty if nowhere.

        Examples
        --------
        >>> percuss.run("plank.toml", out="runs/plank").path.endswith("runs/plank")
        True
        """
        path = self._native.get("path")
        return "" if path is None else os.fspath(path)

    def raise_for_status(self) -> Result:
        """Raises an exception unless the run completed.

        Returns
        -------
        Result
            This one.

        Raises
        ------
        FailedRunError
            If it did not complete.

        Examples
        --------
        >>> percuss.run("plank.toml", check=False).raise_for_status().status
        'completed'
        """
        raise_for_status(self)
        return self

    @property
    def scenario(self) -> str:
        """The scenario that was run, as a file with every default written out.

        Returns
        -------
        str
            TOML, in SI units.

        Examples
        --------
        >>> print(percuss.run("plank.toml").scenario.splitlines()[0])
        title = "A sandbag falls on a plank"
        """
        return str(self._native["scenario"])

    @property
    def shapes(self) -> Shapes:
        """Shapes of the structure over time, those of the frames that were kept.

        Returns
        -------
        Shapes
            Centre lines of the beams.

        Raises
        ------
        InputError
            If no frames were kept.

        Examples
        --------
        >>> len(percuss.run("plank.toml").shapes)
        751
        """
        fields = self.fields
        return Shapes(fields.centre_lines(), fields.time, fields.displacement[:, : fields.stations].astype(np.float64))

    @cached_property
    def fields(self) -> Fields:
        """The scene and its motion, for drawings, animations and exports.

        Returns
        -------
        Fields
            The frames that were kept.

        Raises
        ------
        InputError
            If the run has none.

        Examples
        --------
        >>> percuss.run("plank.toml").fields.displacement.shape  # frames, nodes, (u1, u2, u1', u2')
        (751, 10, 4)
        """
        if self._native["fields"] is None:
            raise coded(InputError, "this run has no fields/: run its scenario again with record.shapes above 0", "E210")
        return Fields(self._native["fields"])

    @property
    def story(self) -> str:
        """Summary text of the run.

        Returns
        -------
        str
            The sentences of the terminal and the report.

        Examples
        --------
        >>> percuss.run("plank.toml").story.split(" at ")[0]
        "'plank.mid' was struck by projectile 'bag'"
        """
        return _percuss.story(self._native["summary"])

    def _instant(self) -> float:
        """The instant at which a page opens, as a drawing shows it [s]."""
        named = _percuss.instant(self._native["summary"])
        peak = self.fields.largest[1] if named is None else named
        first, last = float(self.fields.time[0]), float(self.fields.time[-1])
        # An impact at the very end is later than the last frame by half of its interval.
        return self.fields.instant_shown(first if peak is None else min(max(peak, first), last))

    @property
    def plot(self) -> Plots:
        """Figures: ``result.plot()`` draws the scene; ``result.plot.energy()``, ``.force()``, ``.displacement()`` draw curves.

        Returns
        -------
        Plots
            To be called, or asked for a figure.

        Examples
        --------
        >>> percuss.run("plank.toml").plot.force().get_ylabel()
        'contact force [N]'
        """
        from ._plot import Plots

        return Plots(self)

    def animate(self, path: str | os.PathLike[str] | None = None, **options: Any) -> FuncAnimation:
        """The scene in motion.

        Parameters
        ----------
        path : str or path, optional
            Keeps it as a film (``hit.gif``, ``hit.mp4``).
        **options
            Those of :meth:`Plots.animation`.

        Returns
        -------
        matplotlib.animation.FuncAnimation
            The animation.

        Raises
        ------
        MissingError
            If matplotlib is not installed.
        InputError
            If the run has no frames, or the format needs ffmpeg and there is none.

        Examples
        --------
        >>> import os
        >>> animation = percuss.run("plank.toml").animate("hit.gif", frames=3)
        >>> os.path.getsize("hit.gif") > 0
        True
        """
        return self.plot.animation(path=path, **options)

    def export(self, directory: str | os.PathLike[str], *, format: str = "vtkhdf") -> list[str]:
        """Writes the motion of the scene for ParaView into a directory of its own.

        Parameters
        ----------
        directory : str or path
            Where to; it is made.
        format : {"vtkhdf", "pvd"}
            ``vtkhdf`` is for ParaView 5.12 and later, ``pvd``, a file an instant, for all.

        Returns
        -------
        list of str
            Names of the files to open.

        Raises
        ------
        InputError
            If the run has no frames, or there is no such format.
        FileError
            If the files cannot be written.

        Examples
        --------
        >>> percuss.run("plank.toml", shapes=10).export("paraview")
        ['beams.vtkhdf', ...]
        """
        if self._native["fields"] is None:
            self.fields  # says why there are none
        return _percuss.export(self._native["fields"], directory, format)

    def to_xarray(self) -> xarray.Dataset:
        """The history over ``time`` and the frames over ``instant`` as a data set of xarray.

        Returns
        -------
        xarray.Dataset
            With units and descriptions as attributes.

        Raises
        ------
        MissingError
            If xarray is not installed.

        Examples
        --------
        >>> data = percuss.run("plank.toml").to_xarray()
        >>> data["contact.bag.force"].attrs["units"], data.sizes["station"]
        ('N', 9)
        """
        from ._tables import dataset

        return dataset(self)

    def __repr__(self) -> str:
        residual = self.summary["energy"]["residual_max"]
        title = self.summary["title"]
        return (
            f"<percuss.Result {title + ': ' if title else ''}{self.status}, {len(self)} rows, "
            f"{len(self.columns)} columns, energy residual {residual:.1e}>"
        )

    def _repr_html_(self) -> str:
        from ._notebook import shown

        return shown(self)
