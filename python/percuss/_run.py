"""One run: simulated, or read back."""

from __future__ import annotations

import glob
import os
from collections.abc import Callable
from typing import Any

from . import _percuss
from ._errors import MissingRunError, coded
from ._outcome import FailedRunWarning, tell, warn, warn_of_status
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
    check: bool = True,
    **overrides: Any,
) -> Result:
    """Simulates a scenario.

    What the model checks and the audit of the run warn of, such as a coarse step or a balance error, is issued as an
    :class:`AdviceWarning` or a :class:`PercussWarning` with its code, unless the scenario allows it; ``result.summary["advice"]`` and
    ``result.summary["warnings"]`` have all of it.

    Parameters
    ----------
    scenario : str, path, mapping or Scenario
        A scenario, the path of its file, or nested dictionaries with the file's names.
    progress : bool or callable, optional
        Whether a bar is shown; by default in terminals and notebooks, once a run takes a second. A function is called with the
        time reached and that of the end [s], the last time when the run is done.
    out : str or path, optional
        Directory for the files that ``percuss run`` writes.
    report : bool
        Write ``report.html`` too.
    shapes : int, optional
        Largest number of frames of the scene kept of either kind, those in which something touches and the others; by default
        ``record.shapes`` of the scenario says how much memory they get. 0 keeps none.
    check : bool
        Raise an exception if the run does not complete. Without it the result, whose ``status`` is then ``"failed"``, is returned up
        to the last step with a :class:`FailedRunWarning`.
    **overrides
        Values to change for this run, as ``**{"projectile.mass.velocity": [0, 30]}`` or ``projectile__mass__velocity=[0, 30]``.

    Returns
    -------
    Result
        The run.

    Raises
    ------
    ValueError
        If ``shapes`` is below zero, or a report is asked for without ``out``.
    ScenarioError
        If the scenario has faults: all of them.
    FailedRunError
        If the run does not complete and ``check`` is true; its ``result`` is the run up to the last step. With ``out`` the files are written,
        beside those of an earlier complete run (``error.result.path``).
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
        result = Result._of(_percuss.run(source, bar.listener, out, report, shapes))
    tell(result, check)
    return result


def open(directory: str | os.PathLike[str]) -> Result:
    """A finished run, read back, with warnings as of :func:`percuss.open`."""
    path = os.fspath(directory)
    if not os.path.isfile(os.path.join(path, "summary.json")):
        what = "is not the directory of a run (it has no summary.json)" if os.path.isdir(path) else "no such directory"
        raise coded(MissingRunError, f"{path}: {what}; give the directory that `percuss run` has written", "E209")
    result = Result._of({**_percuss.open(path), "path": path})
    warn_of_status(result)
    later = _later_incomplete(path)
    if later:
        warn(FailedRunWarning, f"{path} has the last run that completed; a later one did not, and its results are in {later}", None)
    return result


def _later_incomplete(path: str) -> str | None:
    """Where the latest run to a directory lies if it did not complete and the one there did."""
    place = os.path.normpath(path)
    found = [os.path.join(one, "summary.json") for one in glob.glob(f"{glob.escape(place)}.incomplete*")]
    later = [one for one in found if os.path.isfile(one) and os.path.getmtime(one) > os.path.getmtime(os.path.join(place, "summary.json"))]
    return os.path.dirname(max(later, key=os.path.getmtime)) if later else None
