"""Options of functions: what they may be, in one place."""

from __future__ import annotations

import functools
import inspect
import os
from collections.abc import Callable, Iterable
from difflib import get_close_matches
from typing import ParamSpec, TypeVar

Arguments = ParamSpec("Arguments")
Returned = TypeVar("Returned")

OF_SCENARIOS = ("about", "check", "count", "levels", "out", "parameters", "path", "progress", "quantity", "refine", "report", "results", "shapes")
"""Names of the options of functions that take changes of a scenario as further keywords."""

OF_STUDIES = ("allow_outside", "client", "executor", "jobs", "out", "points", "progress")
"""Names of the options of the function that takes tables of a study as further keywords."""


def refuse_option(keyword: str) -> None:
    """Refuses a keyword that is no key of scenarios, if it is like an option, or is one of another function."""
    if keyword in (*OF_SCENARIOS, *OF_STUDIES):
        raise TypeError(f"{keyword!r} is no option of this function, and no key of scenarios")
    near = get_close_matches(keyword, OF_SCENARIOS, n=1)
    if near:
        raise TypeError(f"{keyword!r} is neither an option nor a key of scenarios; did you mean {near[0]!r}?")


def own_options(function: Callable[Arguments, Returned]) -> Callable[Arguments, Returned]:
    """A function that names the nearest of its options where a keyword is none of them."""
    known = list(inspect.signature(function).parameters)

    @functools.wraps(function)
    def called(*arguments: Arguments.args, **options: Arguments.kwargs) -> Returned:
        for keyword in options:
            if keyword not in known:
                near = get_close_matches(keyword, known, n=1)
                expected = f"; did you mean {near[0]!r}?" if near else f"; it has {', '.join(known)}"
                raise TypeError(f"{function.__qualname__} has no option {keyword!r}{expected}")
        return function(*arguments, **options)

    return called


def texts(option: str, given: Iterable[str]) -> list[str]:
    """A list of texts: a single one would be taken letter by letter."""
    if isinstance(given, (str, bytes)):
        raise TypeError(f"{option}={given!r}: expected a list of texts, such as [{given!r}]")
    return list(given)


def threads(jobs: int) -> int:
    """Number of threads: 0 and -1 are one a core, -2 is one less, as in joblib."""
    if isinstance(jobs, bool) or not isinstance(jobs, int):
        raise TypeError(f"jobs={jobs!r}: expected a number of threads, or -1 for one a core")
    return jobs if jobs >= 0 else max(1, _cores() + 1 + jobs)


def _cores() -> int:
    """Cores that this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity is not None else os.cpu_count() or 1


def colour_of(colour: str, color: str | None) -> str:
    """One option in two spellings."""
    if color is None:
        return colour
    if colour not in ("none", color):
        raise TypeError(f"colour={colour!r} and color={color!r}: one option in two spellings")
    return color
