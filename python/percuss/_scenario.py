"""Scenarios: the text of a file, and functions that a file cannot hold."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from . import _percuss, _toml
from ._errors import PathError
from ._given import Potential, split, without_laws
from ._options import refuse_option
from ._review import Advice, Review
from ._view import view

Given = dict[str, list[Callable[[float], float]]]
"""Functions by their paths; of a law energy and force."""

Source = tuple[str, str, list[tuple[str, str]], Given, bool]
"""Arguments of the native module: text, name, changes, functions, whether files may lie in any folder."""


class Scenario:
    """A scenario, with the names of the file: ``scenario["projectile.mass.velocity"] = [0, "30 m/s"]``.

    It is the text of a file; what is set here is written into it, comments stay. Paths are those of ``--set``: names between dots,
    indices of lists from zero, ``projectile.bag.velocity[1]``; a path that no scenario can have is refused when it is set. Values are
    not checked before :meth:`check` or a run, which report all errors together, with the line in :attr:`text`.

    A table or a list that is read writes what is set in it: ``scenario["projectile.bag"]["mass"] = "12 kg"``. A table that is set takes
    the place of the whole table before; ``scenario["support"].update(...)`` adds to it.

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
        self._given: Given = {}
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
        scenario._put(tables)
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
        return _toml.read(self._text)

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
        """An independent copy.

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
        PathError
            If no scenario can have a value there.

        Examples
        --------
        >>> percuss.load("plank.toml").set("beam.plank.elements", 16)["beam.plank.elements"]
        16
        """
        self[path] = value
        return self

    def check(self) -> Review:
        """Model checks before a run.

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
        """The value at a path of the file.

        Parameters
        ----------
        path : str
            Where, with dots.

        Returns
        -------
        object
            A value as the file has it, a table or a list of the scenario, or a function that was given.

        Raises
        ------
        PathError
            If the file says nothing there; also a ``KeyError``.

        Examples
        --------
        >>> percuss.load("plank.toml")["projectile.bag.mass"]
        '10 kg'
        """
        found = self._plain(path)
        given = self._given.get(self._spelled(path))
        if given is not None:
            return Potential(*given) if len(given) == 2 else given[0]
        return view(self, path, found)

    def _plain(self, path: str) -> Any:
        """What the text has at a path."""
        if self._tree is None:
            self._tree = self.to_dict()
        found: Any = self._tree
        for step in _percuss.steps(path, self._name):
            if isinstance(found, dict) and step in found:
                found = found[step]
            elif isinstance(found, list) and step.isdecimal() and int(step) < len(found):
                found = found[int(step)]
            else:
                _percuss.steps(path, self._name, self._text)  # says where the path leads nowhere
                raise KeyError(path)
        return found

    def _spelled(self, path: str) -> str:
        """The path as functions are kept by: names have no dots."""
        return ".".join(_percuss.steps(path, self._name))

    def __setitem__(self, path: str, value: Any) -> None:
        self._put({path: value})

    def _put(self, values: Mapping[str, Any]) -> None:
        """Sets values, all of them or none."""
        changes: list[tuple[str, str]] = []
        given: Given = {}
        for path, value in values.items():
            simple, functions = split(value, path)
            changes.append((path, _toml.value(simple)))
            given.update(functions)
        text = _percuss.set(self._text, self._name, changes)
        for path, code in given.items():
            text = without_laws(text, self._name, path) if len(code) == 2 else text
        kept = self._given
        for path in values:
            kept = self._without(kept, path)
        self._given = {**kept, **{self._spelled(path): code for path, code in given.items()}}
        self._text, self._tree = text, None

    def _without(self, given: Given, path: str) -> Given:
        """Functions without those at a path or below."""
        own = self._spelled(path)
        return {p: code for p, code in given.items() if p != own and not p.startswith(f"{own}.")}

    def __delitem__(self, path: str) -> None:
        self._text = _percuss.remove(self._text, self._name, path)
        self._given = self._without(self._given, path)
        self._tree = None

    def __contains__(self, path: str) -> bool:
        try:
            self._plain(path)
        except PathError:
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

    def _is_path(self, path: str) -> bool:
        """Whether scenarios may have something there."""
        try:
            _percuss.steps(path, self._name)
        except PathError:
            return False
        return True

    def _source(self, changes: Mapping[str, Any] | None = None) -> Source:
        """Arguments of the native module; ``changes`` apply to existing values only, by paths or keywords."""
        text, given = self._text, dict(self._given)
        lines: list[tuple[str, str]] = []
        for keyword, value in (changes or {}).items():
            path = self._path(keyword)
            simple, functions = split(value, path)
            for at, code in functions.items():
                given[self._spelled(at)] = code
                text = without_laws(text, self._name, at) if len(code) == 2 else text
            lines.append((path, _toml.value(simple)))
        return (text, self._name, lines, given, self._outside)

    def _path(self, keyword: str) -> str:
        """The path that a keyword means: ``__`` stands for a dot, but within a name that the scenario has."""
        if "." in keyword or "[" in keyword:
            return keyword
        if "__" not in keyword:
            if not self._is_path(keyword):
                refuse_option(keyword)
            return keyword  # what is like no option is refused with the other faults of the scenario
        kind, _, rest = keyword.partition("__")
        try:
            names = self.to_dict().get(kind, {})
        except ValueError:  # no TOML, of which the run says more
            names = {}
        own = [name for name in names if rest == name or rest.startswith(f"{name}__")] if isinstance(names, dict) else []
        name = max(own, key=len, default="")
        return f"{kind}.{name}" + rest[len(name) :].replace("__", ".") if name else keyword.replace("__", ".")
