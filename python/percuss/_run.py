"""One run: simulated, or read back."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from typing import Any

from . import _percuss
from ._errors import MissingRunError, PercussWarning, coded
from ._progress import Progress
from ._result import Result
from ._load import Scenarios, scenario_of


def run(
    scenario: Scenarios,
    *,
    progress: bool | Callable[[float, float], object] | None = None,
    out: str | os.PathLike[str] | None = None,
    report: bool = False,
    shapes: int | None = None,
    **overrides: Any,
) -> Result:
    """Simulates a scenario.

    What the audit of the run warns of, such as a balance error, is raised as a :class:`PercussWarning` with its code,
    unless the scenario allows it; ``result.summary["warnings"]`` has all of it.

    Parameters
    ----------
    scenario : str, path, mapping or Scenario
        A scenario, the path of its file, or nested dictionaries with the file's names.
    progress : bool or callable, optional
        Whether a bar is shown; by default in terminals and notebooks, once a run takes a second. A function is called with the
        time reached and that of the end [s].
    out : str or path, optional
        Directory for the files that ``percuss run`` writes.
    report : bool
        Write ``report.html`` too.
    shapes : int, optional
        Largest number of frames of the scene kept of either kind, those in which something touches and the others; by default
        ``record.shapes`` of the scenario says how much memory they get. 0 keeps none.
    **overrides
        Values to change for this run, as ``**{"projectile.mass.velocity": [0, 30]}`` or ``projectile__mass__velocity=[0, 30]``.

    Returns
    -------
    Result
        The run. Without convergence its ``status`` is ``"failed"``, with everything up to the last step.

    Raises
    ------
    ValueError
        If ``shapes`` is below zero, or a report is asked for without ``out``.
    ScenarioError
        If the scenario has faults: all of them.
    FileError
        If files cannot be written.
    KeyboardInterrupt
        On Ctrl-C; with ``out`` what there is has been written then.

    Examples
    --------
    >>> result = percuss.run("plank.toml")
    >>> round(result.summary["contact"]["bag"]["peak_force"]["value"])  # N
    2561
    >>> slow = percuss.run("plank.toml", projectile__bag__velocity=[0, "-1 m/s"])
    >>> round(slow["contact.bag.force"].max())
    512
    """
    if report and out is None:
        raise ValueError("report=True writes report.html: give its directory, out=...")
    if shapes is not None and shapes < 0:
        raise ValueError(f"shapes={shapes}: expected 0 or a number of frames")
    source = scenario_of(scenario)._source(overrides)
    with Progress(progress, unit="s", name="run") as bar:
        result = Result._of(_percuss.run(source, bar.to, out, report, shapes))
    _warn(result)
    return result


def _warn(result: Result) -> None:
    """Raises the warnings of the audit of a run, unless the scenario allows them."""
    for one in result.summary["warnings"]:
        if one["verdict"] == "warning":
            warning = PercussWarning(f"{one['text']} [{one['code']}]")
            warning.code = one["code"]
            warnings.warn(warning, stacklevel=3)


def open(directory: str | os.PathLike[str]) -> Result:
    """A finished run, read back.

    Parameters
    ----------
    directory : str or path
        What ``percuss run`` or ``run(..., out=directory)`` left.

    Returns
    -------
    Result
        The same as ``run`` gave.

    Raises
    ------
    MissingRunError
        If there is none.
    InputError
        If its files are not what they should be.

    Examples
    --------
    >>> result = percuss.run("plank.toml", out="runs/plank")
    >>> percuss.open("runs/plank").status
    'completed'
    """
    path = os.fspath(directory)
    if not os.path.isfile(os.path.join(path, "summary.json")):
        what = "is not the directory of a run (it has no summary.json)" if os.path.isdir(path) else "no such directory"
        raise coded(MissingRunError, f"{path}: {what}; give the directory that `percuss run` has written", "E209")
    return Result._of(_percuss.open(path))
