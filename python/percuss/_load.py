"""Scenarios from wherever they are."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, Union

from . import _percuss
from ._options import own_options
from ._review import Advice, Review
from ._scenario import Scenario

Scenarios = Union[Scenario, str, "os.PathLike[str]", Mapping[str, Any]]
"""A scenario, the path of its file, or nested dictionaries."""


@own_options
def load(path: str | os.PathLike[str], *, allow_outside: bool = False) -> Scenario:
    """A scenario from a file.

    Parameters
    ----------
    path : str or path
        The file.
    allow_outside : bool
        Let CSV files that it names lie anywhere, and not only in its folder or below.

    Returns
    -------
    Scenario
        Not checked yet.

    Raises
    ------
    ValueError
        If the file is not saved as UTF-8.
    OSError
        If it cannot be read.

    Examples
    --------
    >>> percuss.load("plank.toml")
    <percuss.Scenario plank.toml: 35 lines>
    """
    name = os.fspath(path)
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            return Scenario(file.read(), name, allow_outside=allow_outside)
    except UnicodeDecodeError as error:
        raise ValueError(f"{name}: is not saved as UTF-8: {error.reason} at byte {error.start}") from None


def scenario_of(scenario: Scenarios) -> Scenario:
    """The scenario meant."""
    if isinstance(scenario, Scenario):
        return scenario
    return Scenario.from_dict(scenario) if isinstance(scenario, Mapping) else load(scenario)


def check(scenario: Scenarios, **overrides: Any) -> Review:
    """Model checks of a scenario before a run, as in ``percuss check``.

    Parameters
    ----------
    scenario : str, path, mapping or Scenario
        A scenario, the path of its file, or nested dictionaries with the file's names.
    **overrides
        Values to change, with ``__`` for the dots of a path: ``time__step="1e-5 s"``.

    Returns
    -------
    Review
        A list of :class:`Advice`.

    Raises
    ------
    ScenarioError
        If anything is wrong: every fault at once, with the lines of the file.

    Examples
    --------
    >>> percuss.check("plank.toml").warnings
    []
    """
    given = scenario_of(scenario)
    return Review(Advice(*one) for one in _percuss.check(given._source(overrides)))
