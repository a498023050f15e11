"""Studies: many runs of one scenario with varying parameters."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import cached_property, lru_cache
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _arrow, _percuss, _toml
from ._columns import Columns, read_only
from ._nearest import LISTED, nearest
from ._options import OF_STUDIES
from ._points import Points, columns_of, name_of
from ._scenario import Scenario

if TYPE_CHECKING:
    import pandas
    import xarray

StudySource = Union[_percuss.Study, str, "os.PathLike[str]", Mapping[str, Any]]
"""A study, the path of its file, or nested dictionaries with the file's names."""


_TABLES = ("title", "base", "scenario", "seed", "parameter", "correlation", "design", "results")
_PLURALS = {"parameters": "parameter", "correlations": "correlation"}


def _refuse_unknown(tables: Mapping[str, Any]) -> None:
    for key in tables:
        if key not in _TABLES and key not in _PLURALS:
            expected = f"; expected one of {', '.join((*_TABLES, *_PLURALS))}"
            raise TypeError(f"{key!r} is no part of a study{nearest(key, (*_TABLES, *_PLURALS, *OF_STUDIES), expected)}")


def _merged(study: Mapping[str, Any] | None, parts: Mapping[str, Any]) -> dict[str, Any]:
    """The tables of a study by their names in files; ``parts`` override those of ``study``."""
    merged: dict[str, Any] = {}
    for tables in (study or {}, parts):
        _refuse_unknown(tables)
        for plural, key in _PLURALS.items():
            if plural in tables and key in tables:
                raise TypeError(f"{plural} and {key}: one table in two spellings")
        merged.update({_PLURALS.get(key, key): value for key, value in tables.items()})
    return merged


def study_of(study: StudySource | None, parts: Mapping[str, Any], allow_outside: bool = False) -> _percuss.Study:
    """The study; ``parts`` are its tables, which override those of ``study``."""
    _refuse_unknown(parts)
    if isinstance(study, _percuss.Study) and not parts:
        return study
    if study is None:
        return _percuss.Study(_text(_merged(None, parts)), "study", allow_outside)
    if isinstance(study, _percuss.Study):
        raise TypeError("a study that has been read takes no further tables")
    if isinstance(study, Mapping):
        return _percuss.Study(_text(_merged(study, parts)), "study", allow_outside)
    if parts:
        raise TypeError(f"{', '.join(parts)}: the study's file says this; give one or the other")
    path = Path(study)
    return _percuss.Study(path.read_text(encoding="utf-8-sig"), os.fspath(path), allow_outside)


def study_at(points: Points, study: StudySource | None, parts: Mapping[str, Any], allow_outside: bool = False) -> _percuss.Study:
    """The study at points chosen elsewhere; a column with a path that no parameter has makes one."""
    for key in ("design", "correlation", "correlations"):
        if key in parts:
            raise TypeError(f"{key} and points: the points are the design; give one of the two")
    tables, name = _tables(study, parts)
    given = tables.pop("parameter", None) or {}
    declared = {key: str(table["path"]) for key, table in given.items()}
    listed = columns_of(points, declared)
    tables["parameter"] = {
        key if key in declared else name_of(key): {"path": declared.get(key, key), "values": values} for key, values in listed.items()
    }
    tables["design"] = {"kind": "points"}
    tables.pop("correlation", None)
    return _percuss.Study(_text(tables), name, allow_outside)


def _tables(study: StudySource | None, parts: Mapping[str, Any]) -> tuple[dict[str, Any], str]:
    """The tables of a study, and its name in messages."""
    if study is None or isinstance(study, Mapping):
        return _merged(study, parts), "study"
    if parts:
        raise TypeError(f"{', '.join(parts)}: the study says this; give one or the other")
    if isinstance(study, _percuss.Study):
        return _toml.read(study.text), "study"
    path = Path(study)
    text = path.read_text(encoding="utf-8-sig")
    try:
        return _toml.read(text), os.fspath(path)
    except ValueError:
        _percuss.Study(text, os.fspath(path))  # raises every fault with its place
        raise


def _text(tables: Mapping[str, Any]) -> str:
    """A study as a file."""
    text = ""
    for key, value in sorted(tables.items(), key=lambda item: isinstance(item[1], Mapping)):
        if key == "scenario":
            value = value if isinstance(value, str) else _base(value)
        if key == "base":
            value = os.fspath(value)
        text += f"{key} = {_toml.value(value)}\n"
    return text


def _base(scenario: Any) -> str:
    """The text of a base scenario, which then names no file."""
    base = scenario if isinstance(scenario, Scenario) else Scenario.from_dict(scenario)
    if base._given:
        paths = ", ".join(base._given)
        raise ValueError(f"{paths}: functions of Python have no place in a study, whose text goes to other processes")
    return base.to_toml()


class Sweep(Columns[Any]):
    """The table of a study: one row a run. pyarrow, pandas and polars take it as a table.

    Attributes
    ----------
    study : Study
        The study.
    path : str
        Where ``results.parquet`` lies; empty if nowhere.

    Examples
    --------
    >>> percuss.sweep("speed.toml")
    <percuss.Sweep The bag, from 1 to 9 m/s: 9 runs; peak_force, deflection, stress>
    """

    def __init__(self, study: _percuss.Study, columns: list[tuple[str, str, str, str, Any]], path: str) -> None:
        self.study = study
        self.path = path
        self._native = columns
        self._columns = {name: values for name, _, _, _, values in columns}
        read_only([values for values in self._columns.values() if isinstance(values, np.ndarray)])

    def __reduce__(self) -> tuple[Any, ...]:
        return (Sweep, (self.study, self._native, self.path))

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns: ``run``, parameters, results, ``status``, ``reason``, audit.

        Returns
        -------
        tuple of str
            In the order of the table.

        Examples
        --------
        >>> percuss.sweep("speed.toml").columns[:3]
        ('run', 'speed', 'peak_force')
        """
        return tuple(self._columns)

    @property
    def units(self) -> dict[str, str]:
        """Unit of every column.

        Returns
        -------
        dict of str
            By the column's name; ``"1"`` of a pure number.

        Examples
        --------
        >>> percuss.sweep("speed.toml").units["peak_force"]
        'N'
        """
        return {name: unit for name, unit, _, _, _ in self._native}

    @property
    def descriptions(self) -> dict[str, str]:
        """Description of every column.

        Returns
        -------
        dict of str
            By the column's name; of a parameter and a result its path.

        Examples
        --------
        >>> percuss.sweep("speed.toml").descriptions["speed"]
        'projectile.bag.velocity[1]'
        """
        return {name: about for name, _, _, about, _ in self._native}

    def names(self, role: str) -> tuple[str, ...]:
        """Columns of a role.

        Parameters
        ----------
        role : {"input", "result", "audit", "open"}
            Parameters, results, what says how far a run can be trusted, or what results had come to where a contact was still closed at
            the end.

        Returns
        -------
        tuple of str
            Their names.

        Examples
        --------
        >>> percuss.sweep("speed.toml").names("result")
        ('peak_force', 'deflection', 'stress')
        """
        return tuple(name for name, _, own, _, _ in self._native if own == role)

    def role(self, name: str) -> str:
        """Role of a column.

        Parameters
        ----------
        name : str
            Its name.

        Returns
        -------
        str
            ``run``, ``input``, ``result``, ``status``, ``reason``, ``audit`` or ``open``.

        Raises
        ------
        KeyError
            If there is none of that name.

        Examples
        --------
        >>> percuss.sweep("speed.toml").role("speed")
        'input'
        """
        roles = {own: role for own, _, role, _, _ in self._native}
        if name not in roles:
            raise KeyError(f"no column {name!r}{nearest(name, roles, LISTED)}")
        return roles[name]

    def __len__(self) -> int:
        """Number of runs."""
        return len(self._columns["run"])

    @cached_property
    def failures(self) -> dict[int, str]:
        """Runs that did not complete, and why.

        Returns
        -------
        dict of str
            By the number of the run.

        Examples
        --------
        >>> percuss.sweep("speed.toml").failures
        {}
        """
        ends = zip(self["run"].tolist(), self["status"].tolist(), self["reason"].tolist())
        return {run: f"{status}: {reason}" for run, status, reason in ends if status != "completed"}

    @cached_property
    def not_final(self) -> dict[str, int]:
        """Results that are not final in some runs, since a contact is still closed at their end: they are what they have come to by then.

        Returns
        -------
        dict of int
            The number of such runs, by the name of the result.

        Examples
        --------
        >>> percuss.sweep("speed.toml").not_final
        {}
        """
        counts = {name.removeprefix("open."): int(np.isfinite(self[name]).sum()) for name in self.names("open")}
        return {name: count for name, count in counts.items() if count > 0}

    def to_pandas(self) -> pandas.DataFrame:
        """The table as one of pandas.

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
        >>> percuss.sweep("speed.toml").to_pandas()["peak_force"].round(0).tolist()[:3]
        [512.0, 1024.0, 1537.0]
        """
        return self._to_pandas(self.units, self.descriptions)

    def to_xarray(self) -> xarray.Dataset:
        """The table as a data set of xarray over ``run``.

        Returns
        -------
        xarray.Dataset
            Numbers of the runs and values of the parameters are coordinates; units, descriptions and roles are attributes.

        Raises
        ------
        MissingError
            If xarray is not installed.

        Examples
        --------
        >>> data = percuss.sweep("speed.toml").to_xarray()
        >>> data.sizes["run"], data["peak_force"].attrs["units"], round(float(data["peak_force"].sel(run=0)))
        (9, 'N', 512)
        """
        from ._tables import study_dataset

        return study_dataset(self)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return _arrow.study_table(self).__arrow_c_stream__(requested_schema)

    def __arrow_c_schema__(self) -> object:
        return _arrow.study_table(self).schema.__arrow_c_schema__()

    def __repr__(self) -> str:
        failed = f", {len(self.failures)} of them not completed" if self.failures else ""
        still_open = self.not_final
        left = f", not final in some: {', '.join(still_open)}" if still_open else ""
        return f"<percuss.Sweep {self.study.title}: {len(self)} runs{failed}; {', '.join(self.names('result'))}{left}>"

    def _repr_html_(self) -> str:
        rows = ""
        for name in self.names("input") + self.names("result"):
            values = self[name]
            if values.dtype.kind == "f" and np.isfinite(values).any():
                low, mid, high = np.nanmin(values), np.nanmean(values), np.nanmax(values)
                cells = f"<td>{low:.6g}</td><td>{mid:.6g}</td><td>{high:.6g}</td>"
                rows += f"<tr><th>{escape(name)}</th>{cells}<td>{escape(self.units[name])}</td></tr>"
        head = "<tr><th></th><th>smallest</th><th>mean</th><th>largest</th><th></th></tr>"
        return f"<table><caption>{escape(repr(self)[1:-1])}</caption>{head}{rows}</table>"


@lru_cache(maxsize=4)
def _read(text: str) -> _percuss.Study:
    """A study on a worker, read once."""
    return _percuss.Study(text, "study")


def run_shard(text: str, index: int) -> bytes:
    """The runs of a shard: what workers do, wherever they are."""
    return _read(text).run_shard(index)
