"""Results as Arrow tables, without a copy; units and descriptions are metadata of the fields."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import arro3.core as arro3

if TYPE_CHECKING:
    from ._history import History
    from ._study import Sweep


def table(history: History) -> Any:
    """The history as a table."""
    units, descriptions = history.units, history.descriptions
    fields = []
    for name in history.columns:
        about = {"unit": units[name], "description": descriptions[name]}
        fields.append(arro3.Field(name, arro3.DataType.float64(), nullable=False, metadata=about))
    arrays = [arro3.Array.from_numpy(history[name]) for name in history.columns]
    return arro3.Table.from_arrays(arrays, schema=arro3.Schema(fields))


def study_table(sweep: Sweep) -> Any:
    """The table of a study."""
    fields, arrays = [], []
    for name in sweep.columns:
        values = sweep[name]
        about = {"unit": sweep.units[name], "description": sweep.descriptions[name]}
        if values.dtype.kind in "fi":
            array = arro3.Array.from_numpy(values)
        else:
            array = arro3.Array(values.tolist(), type=arro3.DataType.string())
        arrays.append(array)
        fields.append(arro3.Field(name, array.type, nullable=values.dtype.kind not in "fi", metadata=about))
    return arro3.Table.from_arrays(arrays, schema=arro3.Schema(fields))
