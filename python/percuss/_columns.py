"""Columns by their names."""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, KeysView, Mapping, ValuesView
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from ._nearest import LISTED, nearest

if TYPE_CHECKING:
    import pandas

Kind = TypeVar("Kind", bound=np.generic)
"""Type of the entries of a column."""


class Columns(Generic[Kind]):
    """A mapping of columns, which a subclass keeps in ``_columns``."""

    _columns: Mapping[str, Any]

    def __array__(self, dtype: object = None, copy: bool | None = None) -> NDArray[Any]:
        # NumPy, and pandas with it, would make an array of the names.
        raise TypeError(f"a {type(self).__name__} has columns by name: use to_pandas() for a table, or a column for an array")

    def __getitem__(self, name: str) -> NDArray[Kind]:
        """A column by its name.

        Parameters
        ----------
        name : str
            Its name; ``columns`` lists all.

        Returns
        -------
        ndarray of shape (n_row,)
            The column [its unit in ``units``].

        Raises
        ------
        KeyError
            If there is none of that name; the text says which are like it.

        Examples
        --------
        >>> result = percuss.run("plank.toml")
        >>> round(result["contact.bag.force"].max())  # N
        2561
        """
        try:
            return np.asarray(self._columns[name])
        except KeyError:
            raise KeyError(f"no column {name!r}{nearest(name, self._columns, LISTED)}") from None

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def keys(self) -> KeysView[str]:
        """Names of the columns: this is a mapping.

        Returns
        -------
        KeysView of str
            In the order of the table.

        Examples
        --------
        >>> list(percuss.run("plank.toml").keys())[:2]
        ['time', 'projectile.bag.position_1']
        """
        return self._columns.keys()

    def values(self) -> ValuesView[NDArray[Kind]]:
        """The columns.

        Returns
        -------
        ValuesView of ndarray
            Each of shape (n_row,) [its unit in ``units``].

        Examples
        --------
        >>> len(percuss.run("plank.toml").values())
        50
        """
        return self._columns.values()

    def items(self) -> ItemsView[str, NDArray[Kind]]:
        """Names and columns.

        Returns
        -------
        ItemsView of (str, ndarray)
            Each column of shape (n_row,) [its unit in ``units``].

        Examples
        --------
        >>> name, column = list(percuss.run("plank.toml").items())[0]
        >>> name, column.shape
        ('time', (751,))
        """
        return self._columns.items()

    def get(self, name: str, default: Any = None) -> Any:
        """A column, or a default if there is none.

        Parameters
        ----------
        name : str
            Its name.
        default : object
            What is returned where there is none.

        Returns
        -------
        ndarray of shape (n_row,), or ``default``
            The column [its unit in ``units``].

        Examples
        --------
        >>> percuss.run("plank.toml").get("contact.brick.force") is None
        True
        """
        return self._columns.get(name, default)

    def _to_pandas(self, units: dict[str, str], descriptions: dict[str, str]) -> pandas.DataFrame:
        """A table of copies, with units and descriptions as attributes."""
        try:
            import pandas
        except ImportError as error:
            from ._errors import MissingError

            raise MissingError.of("pandas", "a table for pandas", "tables") from error
        table = pandas.DataFrame({name: np.array(values) for name, values in self.items()})
        table.attrs.update(units=units, descriptions=descriptions)
        return table


Mapping.register(Columns)


def read_only(value: Any) -> None:
    """Makes the arrays in nested dictionaries, lists and tuples read-only: pickles lose that."""
    if isinstance(value, np.ndarray):
        value.flags.writeable = False
    elif isinstance(value, Mapping):
        for entry in value.values():
            read_only(entry)
    elif isinstance(value, (list, tuple)):
        for entry in value:
            read_only(entry)
