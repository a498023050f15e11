"""Placeholders for Python functions in scenarios."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from . import _percuss
from ._errors import PathError

_OF_OTHER_LAWS = ("stiffness", "hertz_stiffness", "hertz", "penetrations", "forces", "file")
"""Keys whose place a potential takes."""


class Potential:
    """A contact potential of your own: energy and force at a penetration of zero or above.

    The force is the derivative of the energy, zero at no penetration and never a pull; both are checked. The work over a step is
    the difference of energies, so the energy balance holds to round-off, as with every law. It takes the place of the law's other keys, such as
    ``stiffness``.

    Parameters
    ----------
    energy : callable
        Energy [J] at a penetration [m].
    force : callable
        Force [N] at a penetration [m].

    Attributes
    ----------
    energy : callable
        The same.
    force : callable
        The same.

    Examples
    --------
    >>> scenario = percuss.load("plank.toml")
    >>> scenario["projectile.bag.law"] = percuss.Potential(lambda p: 2e4 * p**2, lambda p: 4e4 * p)
    >>> round(percuss.run(scenario)["contact.bag.force"].max())  # N, as with a stiffness of 40 kN/m
    2561
    """

    def __init__(self, energy: Callable[[float], float], force: Callable[[float], float]) -> None:
        self.energy = energy
        self.force = force


def without_laws(text: str, name: str, path: str) -> str:
    """The text without what other laws than the one at ``path`` are made of."""
    table = path.removesuffix(".law")
    for key in _OF_OTHER_LAWS:
        try:
            text = _percuss.remove(text, name, f"{table}.{key}")
        except PathError:
            pass
    return text


def split(value: Any, path: str) -> tuple[Any, dict[str, list[Callable[[float], float]]]]:
    """A value with words in the place of functions, and the functions by path."""
    if isinstance(value, Potential):
        return "given", {path: [value.energy, value.force]}
    if isinstance(value, Mapping):
        simple: dict[str, Any] = {}
        functions: dict[str, list[Callable[[float], float]]] = {}
        for key, inner in value.items():
            simple[key], own = split(inner, f"{path}.{key}")
            functions.update(own)
        return simple, functions
    return ("given", {path: [value]}) if callable(value) else (value, {})
