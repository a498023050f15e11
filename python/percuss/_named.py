"""Columns of tables by their names, of whatever package."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

_BY_DEFAULT = re.compile(r"[A-Za-z]\d+")
"""What OpenTURNS calls columns without names: v0, v1; X0, X1."""


def named_columns(x: Any) -> dict[str, Any] | None:
    """Columns by name; None of what has no names, such as an array, or a table whose columns are numbered."""
    names = _names(x)
    if names is None or names == list(range(len(names))):
        return None
    if len(set(names)) < len(names):
        raise ValueError(f"columns with the same name: {', '.join(map(str, names))}")
    return {str(name): _column(x, name, k) for k, name in enumerate(names)}


def _names(x: Any) -> list[Any] | None:
    if isinstance(x, Mapping):
        return list(x)
    if hasattr(x, "_asdict"):  # a named tuple
        return list(x._fields)
    fields = getattr(getattr(x, "dtype", None), "names", None)
    if fields is not None:  # a structured array
        return list(fields)
    for attribute in ("column_names", "columns"):  # Arrow; pandas, polars
        found = getattr(x, attribute, None)
        if found is not None and not callable(found) and hasattr(x, "__getitem__"):
            return list(found)
    if hasattr(x, "getDescription"):  # a sample or a point of OpenTURNS
        described = list(x.getDescription())
        return None if all(_BY_DEFAULT.fullmatch(name) for name in described) else described
    index = getattr(x, "index", None)
    if index is not None and not callable(index) and hasattr(x, "to_numpy"):  # a row of pandas
        return list(index)
    return None


def _column(x: Any, name: Any, k: int) -> Any:
    if hasattr(x, "_asdict"):
        return x[k]
    if hasattr(x, "getDescription"):
        return x.getMarginal(k).asPoint() if hasattr(x, "getMarginal") else x[k]
    return x[name]
