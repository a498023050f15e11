"""One run."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from . import _percuss
from ._progress import Progress
from ._result import Result
from ._scenario import Scenarios, changes_of, scenario_of


def run(
    scenario: Scenarios,
    progress: bool | Callable[[float, float], object] | None = None,
    out: str | os.PathLike[str] | None = None,
    report: bool = False,
    shapes: int = 500,
    **overrides: Any,
) -> Result:
    """Simulates a scenario.

    ``scenario`` is a :class:`Scenario`, the path of a file, or nested dictionaries; ``overrides`` change it for this run, as
    ``**{"projectile.mass.velocity": [0, 30]}`` or ``projectile__mass__velocity=[0, 30]``.

    ``progress`` shows a bar: in terminals and notebooks by default, once a run takes a second; a function is called with the
    time reached and that of the end [s]. ``out`` is a directory for the files that ``percuss run`` writes, ``report`` adds ``report.html``. ``shapes`` is the largest number of shapes of the structure kept for ``result.plot.beam`` and ``.animation``.

    A run that the solver gives up is a result whose ``status`` is ``"failed"``; it holds everything up to the last step. Ctrl-C
    raises ``KeyboardInterrupt``; with ``out`` what there is has been written then.
    """
    source = scenario_of(scenario)._source(changes_of(overrides))
    if callable(progress):
        return Result._of(_percuss.run(source, progress, out, report, shapes))
    with Progress(progress, unit="s", name="run") as bar:
        return Result._of(_percuss.run(source, bar.to, out, report, shapes))
