"""Finished runs and sweeps, read back."""

from __future__ import annotations

import os
from typing import Any

from . import _percuss, _run
from ._errors import MissingRunError, coded
from ._result import Result
from ._storage import kept
from ._study import Sweep


# The type of what a directory contains is known to its reader: `Any` beside `Result` spares type checkers a test of it.
def open(directory: str | os.PathLike[str]) -> Result | Any:
    """A finished run or sweep, read back; nothing is written.

    A :class:`FailedRunWarning` tells of a run that did not complete, and of a later one to the same directory that did not: it lies beside
    it (``plank.incomplete``), as it does not replace a complete run.

    Parameters
    ----------
    directory : str or path
        The output directory of ``percuss run`` or ``percuss sweep``, of ``run(..., out=directory)`` or ``sweep(..., out=directory)``.
        That of a sweep may be any location that fsspec knows, such as ``s3://bucket/study``.

    Returns
    -------
    Result or Sweep
        The same as ``run`` or ``sweep`` gave. A sweep is read whichever version of the program computed it.

    Raises
    ------
    MissingRunError
        If there is neither, or the sweep is not finished.
    InputError
        If its files are not what they should be.

    Examples
    --------
    >>> result = percuss.run("plank.toml", out="runs/plank")
    >>> percuss.open("runs/plank").status
    'completed'
    >>> table = percuss.sweep("speed.toml", out="runs/speed")
    >>> percuss.open("runs/speed")
    <percuss.Sweep The bag, from 1 to 9 m/s: 9 runs; peak_force, deflection, stress>
    """
    place = os.fspath(directory)
    text = kept(place, "study.toml")
    return _run.open(place) if text is None else _sweep(place, text)


def _sweep(place: str, text: bytes) -> Sweep:
    """The table of a finished study."""
    results = kept(place, "results.parquet")
    path = f"{place.rstrip('/')}/results.parquet" if "://" in place else os.path.join(place, "results.parquet")
    if results is None:
        what = "the sweep is not finished (it has no results.parquet)"
        raise coded(MissingRunError, f"{place}: {what}; run it again with the same `out`, it goes on from there", "E209")
    study = _percuss.Study(text.decode("utf-8"), f"{place}/study.toml")
    return Sweep(study, study.columns(results), path)
