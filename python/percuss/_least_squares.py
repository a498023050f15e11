"""Minima of a fit by SciPy, from several starting points side by side."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_EXCEPTION, Future, ThreadPoolExecutor, wait
from typing import Any, TypeVar

import numpy as np

from . import _percuss
from ._errors import AnalysisError, MissingError

Item = TypeVar("Item")
Made = TypeVar("Made")

_LOOK = 0.1
"""Signals are looked for this often [s]: some systems let no signal end a wait."""


def least_squares() -> Callable[..., Any]:
    """SciPy's function, or a word on where to find it."""
    try:
        from scipy.optimize import least_squares as solve
    except ImportError as error:
        raise MissingError.of("scipy", 'a fit with solver="scipy"', "fit") from error
    found: Callable[..., Any] = solve
    return found


def minima_of(problem: _percuss.FitProblem, solve: Callable[..., Any], options: dict[str, Any], threads: int) -> list[_percuss.FoundMinimum]:
    """Minima from all starting points, in their order, on so many threads."""
    low, high = np.array(problem.bounds()).T

    def descend(start: list[float]) -> _percuss.FoundMinimum:
        why = problem.residuals(start)[1]
        if why is not None:
            return start, start, float("nan"), False, f"the run at the starting point fails: {why}", 1
        try:
            found = solve(
                lambda z: problem.residuals(z.tolist())[0],
                start,
                jac=lambda z: problem.jacobian(z.tolist()),
                bounds=(low, high),
                **options,
            )
        except AnalysisError as error:  # other starting points may lead to a minimum
            return start, start, float("nan"), False, f"the iteration fails: {error}", 1
        outcome = "converged" if found.success else "not converged"
        return start, found.x.tolist(), float(found.cost), bool(found.success), f"{outcome}: {found.message}", int(found.nfev)

    return side_by_side(descend, problem.starts(), threads, problem.stop)


def side_by_side(work: Callable[[Item], Made], items: Sequence[Item], threads: int, stop: Callable[[], object]) -> list[Made]:
    """What ``work`` makes of each item, in their order, on so many threads.

    An exception of one, or a signal, ends all: ``stop`` is called to end those that are at work, and the others are not begun.
    """
    threads = min(threads, len(items))
    if threads <= 1:
        return [work(item) for item in items]
    pool = ThreadPoolExecutor(threads, thread_name_prefix="percuss")
    try:
        futures = [pool.submit(work, item) for item in items]
        pending: set[Future[Made]] = set(futures)
        while pending:
            done, pending = wait(pending, _LOOK, FIRST_EXCEPTION)
            for future in futures:
                if future in done:
                    future.result()
        return [future.result() for future in futures]
    except BaseException:
        stop()
        raise
    finally:
        pool.shutdown(cancel_futures=True)
