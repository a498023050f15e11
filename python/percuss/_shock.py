"""Columns of a run filtered in a channel frequency class, and accelerations as shock response spectra."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _percuss
from ._errors import InputError, coded
from ._nearest import nearest
from ._tables import xarray_module
from ._words import unit_words

if TYPE_CHECKING:
    import xarray

    from ._history import History

_ANSWERS = {
    "acceleration": ("m/s^2", "Absolute acceleration of the oscillator"),
    "pseudo_velocity": ("m/s", "Angular natural frequency times relative displacement"),
    "displacement": ("m", "Displacement of the oscillator relative to its base"),
}
_WHEN = {"primary": "while the signal lasts", "residual": "after it", "maximax": "at any time"}


_SAMPLED = ("N", "N*m", "Pa", "m", "m/s", "rad", "rad/s")
"""Units of columns that are signals: forces, moments, stresses, displacements, velocities. Impulses are sums over output intervals."""


def filtered(history: History, column: str, cfc: int | None) -> xarray.DataArray:
    """An acceleration, a force or another signal over time."""
    arrays = xarray_module()
    if history.units.get(column) in _SAMPLED:
        native, unit = _percuss.samples(history.time.tolist(), history[column].tolist(), cfc), history.units[column]
        times = "Time"
    elif column in history:
        text = f"{column}: is no signal that can be filtered; expected an acceleration, force, moment, stress, displacement or velocity"
        raise coded(InputError, text, "E320")
    else:
        native, unit = _percuss.acceleration(*_velocity(history, column), cfc), "m/s^2"
        times = "Middle of the step"
    suffix = "" if cfc is None else f" (CFC {cfc})"
    if _absolute(history, column) is not None:
        suffix = f" relative to the accelerated base{suffix}"
    about = {"units": unit_words(unit), "long_name": f"{column}{suffix}", "resampled": int(native["resampled"])}
    time = ("time", native["time"], {"units": "s", "long_name": times})
    array: xarray.DataArray = arrays.DataArray(native["values"], {"time": time}, ("time",), column, about)
    return array


def shock_spectrum(
    history: History, column: str, damping: float, band: tuple[float, float | None, float], cfc: int | None
) -> xarray.Dataset:
    """Answers over the natural frequency."""
    arrays = xarray_module()
    absolute = _absolute(history, column)
    if absolute is not None:
        text = f"{column}: is relative to the accelerated base, and an oscillator responds to the absolute acceleration; expected {absolute}"
        raise coded(InputError, text, "E320")
    native = _percuss.shock_spectrum(_velocity(history, column), damping, band, cfc)
    variables: dict[str, Any] = {}
    for name, (unit, words) in _ANSWERS.items():
        for when, then in _WHEN.items():
            about = {"units": unit_words(unit), "long_name": f"{words}, largest {then}"}
            variables[f"{name}_{when}"] = ("frequency", native[f"{name}_{when}"], about)
    frequency = ("frequency", native["frequency"], {"units": "Hz", "long_name": "Undamped natural frequency"})
    attributes = {"column": column, "damping": damping, "resampled": int(native["resampled"])}
    if cfc is not None:
        attributes["cfc"] = cfc
    data: xarray.Dataset = arrays.Dataset(variables, {"frequency": frequency}, attributes)
    return data


def _absolute(history: History, column: str) -> str | None:
    """The absolute acceleration beside one that is relative to an accelerated base."""
    absolute = column.replace(".acceleration_", ".absolute_acceleration_")
    velocity = absolute.replace("acceleration_", "velocity_")
    return absolute if absolute != column and velocity in history.columns else None


def _velocity(history: History, column: str) -> tuple[list[float], list[float]]:
    """Times, and the velocity that an acceleration follows from."""
    known = {}
    for name in history.columns:
        for what in (".velocity_", ".absolute_velocity_"):
            if what in name:
                known[name.replace(what, what.replace("velocity", "acceleration"))] = name
    if column not in known:
        what = "is no acceleration" if column in history else "the run has no such column"
        expected = nearest(column, known) if known else "; no velocities were recorded that one follows from: record points"
        raise coded(InputError, f"{column}: {what}{expected}", "E320")
    return history.time.tolist(), history[known[column]].tolist()
