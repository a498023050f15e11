"""The history of a run: its columns over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _arrow
from ._columns import Columns

if TYPE_CHECKING:
    import pandas
    import xarray

Column = NDArray[np.float64]


class History(Columns[np.float64]):
    """Columns of a run over time, with units and descriptions; a :class:`Result` is one.

    Examples
    --------
    >>> percuss.run("plank.toml")["contact.bag.force"].shape
    (751,)
    """

    _native: dict[str, Any]
    _columns: dict[str, Column]

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
        (751, 50)
        """
        return self._to_pandas(self.units, self.descriptions)

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
