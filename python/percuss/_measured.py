"""Records of tests, and what they are compared with."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from typing import Any, Literal

import numpy as np

from . import _toml
from ._load import Scenarios
from ._named import named_columns
from ._nearest import nearest


class Measured:
    """A record of a test: measured curves, and the columns of the history that they are compared with.

    Parameters
    ----------
    source : str, path or mapping
        A CSV file whose first row names the columns and their units (``t [ms]``, ``F [kN]``), or columns by such headers: a dictionary
        of arrays, a table of pandas, polars or Arrow, a structured array, a :class:`Result`.
    channels : mapping
        Columns of the history by columns of the record: ``{"F": "contact.bag.force"}``; the unit in the header may be left out.
        Accelerations follow from velocities: ``point.tip.acceleration_2``.
    time : str
        The column of times.
    sigma : mapping or str or float, optional
        Standard deviation of the measured values, for every channel or by columns of the record: ``"50 N"``. Left out in all channels of
        all records of a fit it follows from the residuals; a fit refuses records that have it in some channels only.
    cfc : mapping or int, optional
        Channel frequency class in which both curves are filtered, for every channel or by columns of the record.
    factor : mapping or float, optional
        Factor on measured values, such as -1 for the other direction.
    align : {"none", "onset", "fit"}, optional
        How times of the record become those of the run; that of :func:`percuss.fit` if it is left out.
    offset : str or float, optional
        Time of the record at which the run starts; the first guess if it is fitted.
    offset_bounds : (str or float, str or float), optional
        Smallest and largest offset if it is fitted.
    window : (str or float or None, str or float or None)
        First and last time of the record that are compared.
    hold_out : bool
        Keep the test out of the fit, and only compare it with the result.
    name : str, optional
        Name of the test; ``test``, or ``test1`` and so on, if it is left out.
    set : mapping, optional
        Values of the scenario that differ in this test, by their paths.
    scenario : str, path, mapping or Scenario, optional
        Another scenario for this test.

    Raises
    ------
    TypeError
        If ``source`` or ``channels`` are something else.
    KeyError
        If ``sigma``, ``cfc`` or ``factor`` are given for a column that is no channel.
    ValueError
        If a column is no array of numbers, one a row.

    Examples
    --------
    >>> record = {"t [ms]": [0, 1, 2], "F [kN]": [0, 1.2, 2.1]}
    >>> percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma="50 N")
    <percuss.Measured: contact.bag.force from F>
    """

    def __init__(
        self,
        source: Any,
        channels: Mapping[str, str],
        *,
        time: str = "time",
        sigma: Any = None,
        cfc: Any = None,
        factor: Any = None,
        align: Literal["none", "onset", "fit"] | None = None,
        offset: str | float | None = None,
        offset_bounds: tuple[str | float, str | float] | None = None,
        window: tuple[str | float | None, str | float | None] = (None, None),
        hold_out: bool = False,
        name: str | None = None,
        set: Mapping[str, Any] | None = None,
        scenario: Scenarios | None = None,
    ) -> None:
        if isinstance(channels, str) or not isinstance(channels, Mapping):
            raise TypeError('channels are columns of the history by columns of the record: {"F": "contact.bag.force"}')
        self._path = os.path.abspath(source) if isinstance(source, (str, os.PathLike)) else ""
        self._columns = None if self._path else _columns_of(source)
        self._channels = dict(channels)
        self._each = {"sigma": sigma, "cfc": cfc, "factor": factor}
        for option, each in self._each.items():
            for data in each if isinstance(each, Mapping) else ():
                if data not in self._channels:
                    raise KeyError(f"{option}: {data!r} is no channel{nearest(data, self._channels)}")
        self._table = {
            "data": self._path,
            "time": time,
            "align": align,
            "offset": offset,
            "offset_bounds": None if offset_bounds is None else list(offset_bounds),
            "from": window[0],
            "to": window[1],
            "hold_out": hold_out or None,
            "set": [f"{path}={_toml.value(value)}" for path, value in (set or {}).items()] or None,
        }
        self._name = name
        self._scenario = scenario

    def __repr__(self) -> str:
        both = ", ".join(f"{column} from {data}" for data, column in self._channels.items())
        return f"<percuss.Measured: {both}>"

    def _text(self, name: str, align: str) -> str:
        """The test as tables of a file."""
        given = {key: value for key, value in self._table.items() if value is not None}
        text = table_text(f"test.{_toml.key(name)}", {"align": align, **given})
        names: set[str] = set()
        for data, column in self._channels.items():
            each = {key: value.get(data) if isinstance(value, Mapping) else value for key, value in self._each.items()}
            channel = {"column": column, "data": data, **{key: value for key, value in each.items() if value is not None}}
            text += table_text(f"test.{_toml.key(name)}.channel.{_toml.key(simple_name(data, names))}", channel)
        return text


def _columns_of(source: Any) -> list[tuple[str, list[float]]]:
    """Headers and numbers of a record that is no file."""
    named = named_columns(source)
    if named is None:
        raise TypeError(f"source is a {type(source).__name__}; expected the path of a CSV file, or columns by their headers")
    columns = []
    for header, values in named.items():
        array = np.asarray(values, dtype=float)
        if array.ndim != 1:
            raise ValueError(f"{header}: found an array of shape {array.shape}, expected numbers, one a row")
        columns.append((header, array.tolist()))
    return columns


def table_text(header: str, table: Mapping[str, Any]) -> str:
    """A table of a file."""
    return f"[{header}]\n" + "".join(f"{key} = {_toml.value(value)}\n" for key, value in table.items())


def simple_name(text: str, taken: set[str]) -> str:
    """A name for a header or a path, of letters, digits and underscores, that is not ``taken``; it is then."""
    name = base = re.sub(r"\W+", "_", re.split(r"[\[(/]", text)[0]).strip("_") or "unnamed"
    number = 1
    while name in taken:
        number += 1
        name = f"{base}_{number}"
    taken.add(name)
    return name
