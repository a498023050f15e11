"""Results of a run."""

from __future__ import annotations

import json
import os
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _arrow, _percuss
from ._columns import Columns, read_only
from ._errors import InputError, coded
from ._fields import Fields
from ._outcome import raise_for_status
from ._structure import Shapes

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.animation import FuncAnimation

    from ._plot import Plots

Column = NDArray[np.float64]


class Result(Columns[np.float64]):
    """A run: ``result["contact.mass.force"]`` is a column of its history as an array.

    Arrays are those that the run filled, without a copy, and cannot be written to. pyarrow, pandas and polars take a result
    as a table: ``pyarrow.table(result)``, ``polars.DataFrame(result)``, ``result.to_pandas()``.

    Examples
    --------
    >>> percuss.run("plank.toml")
    <percuss.Result A sandbag falls on a plank: completed, 751 rows, 49 columns, energy residual ...>
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
        read_only([state["columns"], state["fields"]])

    def __reduce__(self) -> tuple[Any, ...]:
        return (Result, (self._native,))

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns of the history.

        Returns
        -------
        tuple of str
            In the order of the file.

        Examples
        --------
        >>> [name for name in percuss.run("plank.toml").columns if name.startswith("contact.")]
        ['contact.bag.gap', 'contact.bag.force', 'contact.bag.impulse']
        """
        return tuple(self._native["names"])

    @property
    def units(self) -> dict[str, str]:
        """Unit of every column.

        Returns
        -------
        dict of str
            By the column's name; ``"1"`` of a pure number.

        Examples
        --------
        >>> percuss.run("plank.toml").units["contact.bag.force"]
        'N'
        """
        return dict(zip(self._native["names"], self._native["units"]))

    @property
    def descriptions(self) -> dict[str, str]:
        """Description of every column.

        Returns
        -------
        dict of str
            By the column's name.

        Examples
        --------
        >>> percuss.run("plank.toml").descriptions["contact.bag.force"]
        'Contact force at this instant'
        """
        return dict(zip(self._native["names"], self._native["descriptions"]))

    @property
    def time(self) -> Column:
        """Times of the rows.

        Returns
        -------
        ndarray of shape (n_row,)
            Times [s].

        Examples
        --------
        >>> percuss.run("plank.toml").time[[0, -1]]
        array([0.  , 0.15])
        """
        return self._columns["time"]

    def __len__(self) -> int:
        """Number of rows."""
        return len(self.time)

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

    def to_pandas(self) -> pandas.DataFrame:
        """The history as a table of pandas, one row a recorded step.

        Returns
        -------
        pandas.DataFrame
            With units and descriptions in ``attrs``.

        Raises
        ------
        MissingError
            If pandas is not installed.

        Examples
        --------
        >>> percuss.run("plank.toml").to_pandas().shape
        (751, 49)
        """
        return self._to_pandas(self.units, self.descriptions)

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

    def filtered(self, column: str, cfc: int | None = 180) -> xarray.DataArray:
        """A signal in a channel frequency class of SAE J211 and ISO 6487.

        Accelerations are means over recorded steps, at the middle of them; forces and other columns have the values of the rows. Where
        rows are not evenly spaced, they are interpolated first.

        Parameters
        ----------
        column : str
            An acceleration, such as ``point.tip.acceleration_2``, or a column with a force, moment, stress, displacement or velocity,
            such as ``contact.bag.force``.
        cfc : {60, 180, 600, 1000, None}
            The class; None leaves it as it is.

        Returns
        -------
        xarray.DataArray of shape (n_row - 1,), or (n_row,) of a column
            The signal [m/s^2, or the unit of the column] over time [s].

        Raises
        ------
        InputError
            If the column is no signal, such as an impulse, the class is unknown, or the rows are too far apart for it.
        MissingError
            If xarray is not installed.

        Examples
        --------
        >>> result = percuss.run("plank.toml")
        >>> round(float(abs(result.filtered("point.plank.mid.acceleration_2", 60)).max()))  # m/s^2
        176
        >>> force = result.filtered("contact.bag.force", None)
        >>> round(float(force.max())), force.attrs["units"]
        (2561, 'N')
        """
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
        """Shock response spectrum of an acceleration over natural frequencies.

        Parameters
        ----------
        column : str
            Such as ``point.tip.acceleration_2``.
        damping : float
            Share of critical damping of the oscillators [1].
        from_, to : float
            First and last frequency [Hz]; the last by default 10 kHz, or a tenth of the sampling where that is less.
        per_octave : float
            Frequencies an octave [1].
        cfc : {60, 180, 600, 1000}, optional
            Filter the acceleration in this class first.

        Returns
        -------
        xarray.Dataset
            Primary, residual and maximax absolute accelerations [m/s^2], pseudo-velocities [m/s] and relative displacements [m].

        Raises
        ------
        InputError
            If the column is no acceleration, or the band or the damping is out of range.
        MissingError
            If xarray is not installed.

        Examples
        --------
        >>> spectrum = percuss.run("plank.toml").shock_spectrum("point.plank.mid.acceleration_2")
        >>> round(float(spectrum.acceleration_maximax.max()))  # m/s^2
        493
        """
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
        from ._notebook import shown

        return shown(self)
