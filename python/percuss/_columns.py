"""Columns by their names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

Kind = TypeVar("Kind", bound=np.generic)
"""What a column's entries are."""


class Columns(Generic[Kind]):
    """A mapping of columns, which a subclass keeps in ``_columns``."""

    _columns: Mapping[str, Any]

    def __getitem__(self, name: str) -> NDArray[Kind]:
        try:
            return np.asarray(self._columns[name])
        except KeyError:
            raise KeyError(f"no column {name!r}{nearest(name, self._columns)}") from None

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def keys(self) -> tuple[str, ...]:
        """The same as :attr:`columns`: this is a mapping of columns."""
        return tuple(self._columns)


def nearest(name: str, names: Iterable[str]) -> str:
    """What to say of names like an unknown one."""
    from difflib import get_close_matches

    close = get_close_matches(name, names, n=3)
    return f"; did you mean {' or '.join(map(repr, close))}?" if close else "; `columns` lists them"
