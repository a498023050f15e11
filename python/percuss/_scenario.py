"""Scenarios: the text of a file, and functions that a file cannot hold."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from . import _percuss, _toml
from ._given import Potential, holds_tables, split, without_laws, word
from ._review import Advice, Review

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


Source = tuple[str, str, list[str], dict[str, list[Callable[[float], float]]], bool]
"""What the native module takes: text, name, changes, functions."""


class Scenario:
    """A scenario, with the names of the file: ``scenario["projectile.mass.velocity"] = [0, "30 m/s"]``.

    It is the text of a file; what is set here is written into it, comments stay. Nothing is checked before :meth:`check` or a
    run, which report all errors together, with the line in :attr:`text`.

    Parameters
    ----------
    text : str
        The text of a file; empty for a scenario that is filled path by path.
    name : str
        Name of the file in messages; files that the text names are relative to its folder.
    allow_outside : bool
        Let it name files in any folder.

    Examples
    --------
    >>> scenario = percuss.load("plank.toml")
    >>> scenario["projectile.bag.velocity"]
    [0, '-5 m/s']
    >>> scenario["projectile.bag.velocity"] = [0, "-7 m/s"]
    >>> "load.wind" in scenario
    False
    """

    def __init__(self, text: str = "", name: str = "scenario", *, allow_outside: bool = False) -> None:
        self._text = text
        self._name = name
        self._outside = allow_outside
        self._given: dict[str, list[Callable[[float], float]]] = {}
        self._tree: dict[str, Any] | None = None

    @classmethod
    def from_toml(cls, text: str, name: str = "scenario", *, allow_outside: bool = False) -> Scenario:
        """From the text of a file.

        Parameters
        ----------
        text : str
            The text.
        name : str
            Name of the file in messages; files that the text names are relative to its folder.
        allow_outside : bool
            Let it name files in any folder.

        Returns
        -------
        Scenario
            Not checked yet.

        Examples
        --------
        >>> with open("plank.toml") as file:
        ...     scenario = percuss.Scenario.from_toml(file.read())
        >>> scenario["title"]
        'A sandbag falls on a plank'
        """
        return cls(text, name, allow_outside=allow_outside)

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], name: str = "scenario") -> Scenario:
        """From nested dictionaries.

        Parameters
        ----------
        tables : mapping
            With the names of the file: ``{"time": {"end": "0.15 s", "step": 1e-4}, "beam": {"girder": {...}}, ...}``.
        name : str
            Name of the file in messages.

        Returns
        -------
        Scenario
            Not checked yet.

        Examples
        --------
        >>> scenario = percuss.Scenario.from_dict({"time": {"end": "0.1 s", "step": 1e-4}})
        >>> print(scenario.text)
        [time]
        end = "0.1 s"
        step = 0.0001
        """
        scenario = cls(name=name)
        for key, value in tables.items():
            scenario[key] = value
        return scenario

    @property
    def text(self) -> str:
        """The scenario as a file.

        Returns
        -------
        str
            TOML, with the comments of the file that it came from.

        Examples
        --------
        >>> percuss.load("plank.toml").text.splitlines()[0]
        'title = "A sandbag falls on a plank"'
        """
        return self._text

    @property
    def name(self) -> str:
        """Name of the file in messages.

        Returns
        -------
        str
            Its path, where it came from a file.

        Examples
        --------
        >>> percuss.load("plank.toml").name
        'plank.toml'
        """
        return self._name

    def to_dict(self) -> dict[str, Any]:
        """The scenario as nested dictionaries.

        Returns
        -------
        dict
            With the names and values of the file.

        Examples
        --------
        >>> percuss.load("plank.toml").to_dict()["time"]
        {'end': '0.15 s', 'step': '0.2 ms'}
        """
        return tomllib.loads(self._text)

    def to_toml(self) -> str:
        """The scenario as a file in SI units with every default written out.

        Returns
        -------
        str
            TOML.

        Raises
        ------
        ScenarioError
            If it has faults.

        Examples
        --------
        >>> "stiffness = 40000  # N/m" in percuss.load("plank.toml").to_toml()
        True
        """
        return _percuss.written(self._source())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes :attr:`text` to a file.

        Parameters
        ----------
        path : str or path
            Where to.

        Raises
        ------
        OSError
            If it cannot be written.

        Examples
        --------
        >>> scenario = percuss.load("plank.toml").set("time.end", "0.1 s")
        >>> scenario.save("shorter.toml")
        >>> percuss.load("shorter.toml")["time.end"]
        '0.1 s'
        """
        with open(path, "w", encoding="utf-8", newline="\n") as file:
            file.write(self._text)

    def copy(self) -> Scenario:
        """One that can be changed without changing this one.

        Returns
        -------
        Scenario
            With the same text and functions.

        Examples
        --------
        >>> scenario = percuss.load("plank.toml")
        >>> scenario.copy().set("time.end", "0.1 s") == scenario
        False
        """
        other = Scenario(self._text, self._name, allow_outside=self._outside)
        other._given = {path: list(code) for path, code in self._given.items()}
        return other

    def set(self, path: str, value: Any) -> Scenario:
        """The same as ``scenario[path] = value``.

        Parameters
        ----------
        path : str
            Where, with dots.
        value : object
            A number in SI units, a text with its unit, a list, a dictionary, a function or a :class:`Potential`.

        Returns
        -------
        Scenario
            This one.

        Raises
        ------
        KeyError
            If the way to the path leads through a value.

        Examples
        --------
        >>> percuss.load("plank.toml").set("beam.plank.elements", 16)["beam.plank.elements"]
        16
        """
        self[path] = value
        return self

    def check(self) -> Review:
        """What the advisor says before a run.

        Returns
        -------
        Review
            A list of :class:`Advice`.

        Raises
        ------
        ScenarioError
            If anything is wrong: every fault at once.

        Examples
        --------
        >>> percuss.load("plank.toml").check()[1].text
        'the contact lasts about 43.1 ms, 216 steps'
        """
        return Review(Advice(*one) for one in _percuss.check(self._source()))

    def __getitem__(self, path: str) -> Any:
        """What the file says at a path.

        Parameters
        ----------
        path : str
            Where, with dots.

        Returns
        -------
        object
            A value or a dictionary as the file has it, or a function that was given.

        Raises
        ------
        KeyError
            If the file says nothing there.

        Examples
        --------
        >>> percuss.load("plank.toml")["projectile.bag.mass"]
        '10 kg'
        """
        if path in self._given:
            code = self._given[path]
            return Potential(*code) if len(code) == 2 else code[0]
        if self._tree is None:
            self._tree = self.to_dict()
        found: Any = self._tree
        for part in path.split("."):
            if not isinstance(found, dict) or part not in found:
                raise KeyError(path)
            found = found[part]
        return found

    def __setitem__(self, path: str, value: Any) -> None:
        if isinstance(value, Mapping) and holds_tables(path, value):
            for key, inner in value.items():
                self[f"{path}.{key}"] = inner
            return
        text = self._text if isinstance(value, Mapping) else _percuss.set(self._text, path, _toml.value(word(value)))
        given = {p: code for p, code in self._given.items() if p != path and not p.startswith(f"{path}.")}
        if isinstance(value, Mapping):
            plain, functions = split(value, path)
            text = _percuss.set(self._text, path, _toml.value(plain))
            given.update(functions)
        elif isinstance(value, Potential):
            given[path] = [value.energy, value.force]
            text = without_laws(text, path)
        elif callable(value):
            given[path] = [value]
        self._text, self._given, self._tree = text, given, None

    def __delitem__(self, path: str) -> None:
        self._text = _percuss.remove(self._text, path)
        self._given = {p: code for p, code in self._given.items() if p != path and not p.startswith(f"{path}.")}
        self._tree = None

    def __contains__(self, path: str) -> bool:
        try:
            self[path]
        except KeyError:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return iter(self.to_dict())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scenario) and (self._text, self._given) == (other._text, other._given)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<percuss.Scenario {self._name}: {self._text.count(chr(10))} lines>"

    def _repr_html_(self) -> str:
        from html import escape

        return f"<b>{escape(self._name)}</b><pre>{escape(self._text)}</pre>"

    def _source(self, changes: Mapping[str, Any] | None = None) -> Source:
        """What the native module takes; ``changes`` are made strictly, to what is there."""
        text, given, lines = self._text, dict(self._given), []
        for path, value in (changes or {}).items():
            if isinstance(value, Potential):
                given[path] = [value.energy, value.force]
                text = without_laws(text, path)
            elif callable(value):
                given[path] = [value]
            lines.append(f"{path}={_toml.value(word(value))}")
        return (text, self._name, lines, given, self._outside)
