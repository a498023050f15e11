"""Results as xarray data sets: dimensions, coordinates, units and descriptions as attributes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import MissingError
from ._words import unit_words

if TYPE_CHECKING:
    import xarray

    from ._fields import Fields
    from ._result import Result
    from ._study import Sweep


def dataset(result: Result) -> xarray.Dataset:
    """The history over ``time``, and the frames over ``instant``."""
    arrays = xarray_module()
    units, descriptions = result.units, result.descriptions
    variables: dict[str, Any] = {}
    for name, values in result.items():
        if name != "time":
            about = {"units": unit_words(units[name]), "long_name": descriptions[name]}
            variables[name] = ("time", np.array(values), about)
    coordinates: dict[str, Any] = {"time": ("time", np.array(result.time), {"units": "s", "long_name": "Time"})}
    if result._native["fields"] is not None and len(result.fields):
        more, places = _fields(result.fields)
        variables.update(more)
        coordinates.update(places)
    attributes = {"title": result.summary["title"], "status": result.status, "scenario": result.scenario}
    data: xarray.Dataset = arrays.Dataset(variables, coordinates, attributes)
    return data


def study_dataset(sweep: Sweep) -> xarray.Dataset:
    """The table of a study over ``run``."""
    arrays = xarray_module()
    variables: dict[str, Any] = {}
    coordinates: dict[str, Any] = {}
    inputs = sweep.names("input")
    for name in sweep.columns:
        values = np.array(sweep[name])
        about = {"long_name": sweep.descriptions[name] or name, "role": sweep.role(name)}
        if values.dtype.kind in "fi":
            about["units"] = unit_words(sweep.units[name])
        (coordinates if name == "run" or name in inputs else variables)[name] = ("run", values, about)
    data: xarray.Dataset = arrays.Dataset(variables, coordinates, {"title": sweep.study.title, "study": sweep.study.text})
    return data


def xarray_module() -> Any:
    """xarray, or a word on where to find it."""
    try:
        import xarray
    except ImportError as error:
        raise MissingError.of("xarray", "a data set", "tables") from error
    return xarray


def _fields(fields: Fields) -> tuple[dict[str, Any], dict[str, Any]]:
    """Stations, intervals and bodies over the instants of the frames."""

    def about(unit: str, words: str) -> dict[str, str]:
        return {"units": unit, "long_name": words}

    stations = fields.stations
    names = np.array([beam.name for beam in fields.beams for _ in beam.s])
    s = np.concatenate([beam.s for beam in fields.beams]) if fields.beams else np.zeros(0)
    place = np.concatenate([beam.rest[:, :2] for beam in fields.beams]) if fields.beams else np.zeros((0, 2))
    ends = [np.stack([beam.s[beam.begins], beam.s[beam.begins + 1]], axis=1) for beam in fields.beams]
    between = [beam.name for beam in fields.beams for _ in beam.begins]
    coordinates: dict[str, Any] = {
        "instant": ("instant", fields.time, about("s", "Times of the frames")),
        "beam": ("station", names, {"long_name": "Beam of the station"}),
        "s": ("station", s, about("m", "Arc length from the start of the beam")),
        "x": ("station", place[:, 0], about("m", "Reference position in x")),
        "y": ("station", place[:, 1], about("m", "Reference position in y")),
        "interval_beam": ("interval", np.array(between), {"long_name": "Beam of the interval"}),
        "interval_s": (
            ("interval", "end"),
            np.concatenate(ends) if ends else np.zeros((0, 2)),
            about("m", "Arc lengths of the ends of the interval"),
        ),
        "end": ("end", np.array(["start", "end"]), {"long_name": "End of the interval"}),
    }
    variables: dict[str, Any] = {}
    kinds = [("displacement", fields.displacement, "m", "Displacement")]
    if fields.velocity.shape[1]:
        kinds.append(("velocity", fields.velocity, "m/s", "Velocity"))
    for name, values, unit, words in kinds:
        for i in (1, 2):
            own = values[:, :stations, i - 1]
            variables[f"{name}_{i}"] = (("instant", "station"), own, about(unit, f"{words} along e{i}"))
    for i, (name, unit) in enumerate([("axial_force", "N"), ("shear_force", "N"), ("moment", "N m")]):
        words = f"{name.replace('_', ' ').capitalize()} at the ends of the interval"
        variables[name] = (("instant", "interval", "end"), fields.section_forces[..., i], about(unit, words))
    bodies = fields.scene["bodies"]
    if bodies:
        coordinates["body"] = ("body", np.array([body["name"] for body in bodies]), {"long_name": "Body"})
        coordinates["body_kind"] = ("body", np.array([body["kind"] for body in bodies]), {"long_name": "Kind of the body"})
        for i in (1, 2):
            own = fields.displacement[:, stations:, i - 1]
            variables[f"body_displacement_{i}"] = (("instant", "body"), own, about("m", f"Displacement along e{i}"))
        own = fields.displacement[:, stations:, 2]
        variables["body_rotation"] = (("instant", "body"), own, about("rad", "Rotation"))
    return variables, coordinates
