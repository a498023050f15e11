"""Points of a study as columns: from arrays, tables and mappings."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

from ._named import named_columns
from ._nearest import nearest

Points = Union[ArrayLike, Mapping[str, Any], Any]
"""An array of shape (n_point, n_parameter), or columns by the names or paths of parameters: a table of pandas, polars or Arrow, a mapping."""


def columns_of(points: Points, parameters: Mapping[str, str]) -> dict[str, list[Any]]:
    """Values of each parameter by its name, or by its path where it has no name yet; ``parameters`` are names and paths."""
    if isinstance(points, (str, bytes)):
        raise TypeError('points is a text; give an array or a table, and a CSV file as design={"kind": "points", "file": ...}')
    named = named_columns(points)
    columns = _in_order(points, list(parameters)) if named is None else _matched(named, parameters)
    counts = {len(column) for column in columns.values()}
    if counts == {0} or not columns:
        raise ValueError("points: none; give one row or more")
    if len(counts) > 1:
        raise ValueError(f"points: columns of {' and '.join(map(str, sorted(counts)))} rows")
    return columns


def name_of(path: str) -> str:
    """The name of a parameter that has only its path: ``projectile_mass_velocity_1``."""
    return "_".join(part for part in re.split(r"[^\w-]+", path) if part)


def _in_order(points: Points, names: Sequence[str]) -> dict[str, list[Any]]:
    """Columns of an array in the order of the parameters."""
    array = np.asarray(points)
    if array.ndim != 2 or array.shape[1] != len(names):
        wanted = f"(n_point, {len(names)}), one column for each of {', '.join(names) or 'no parameters'}"
        raise ValueError(f"points: found an array of shape {array.shape}, expected {wanted}")
    return {name: array[:, k].tolist() for k, name in enumerate(names)}


def _matched(named: Mapping[str, Any], parameters: Mapping[str, str]) -> dict[str, list[Any]]:
    """Columns of a table, by the names or paths of parameters."""
    by_path = {path: name for name, path in parameters.items()}
    columns: dict[str, list[Any]] = {}
    for header, values in named.items():
        name = header if header in parameters else by_path.get(header)
        if name is None and "." not in header:
            known = [*parameters, *by_path]
            expected = f"; expected {', '.join(parameters)}, or paths of the scenario" if parameters else "; expected paths of the scenario"
            raise ValueError(f"points: {header!r} is no parameter{nearest(header, known, expected)}")
        if (name or header) in columns:
            raise ValueError(f"points: {header!r} is a second column of one parameter")
        columns[name or header] = np.atleast_1d(np.asarray(values)).tolist()
    missing = [name for name in parameters if name not in columns]
    if missing:
        raise ValueError(f"points: no column for {', '.join(missing)}")
    order = [*parameters, *(name for name in columns if name not in parameters)]
    return {name: columns[name] for name in order}
