"""Scenarios: the text of a file, and functions that a file cannot hold."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping
from html import escape
from typing import Any, NamedTuple, Union

from . import _percuss, _toml

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_OF_OTHER_LAWS = ("stiffness", "hertz_stiffness", "hertz", "penetrations", "forces", "file")
"""Keys whose place a potential takes."""

Source = tuple[str, str, list[str], dict[str, list[Callable[[float], float]]], bool]
"""What the native module takes: text, name, changes, functions."""


class Potential:
    """A contact potential of your own: energy [J] and force [N] at a penetration [m] of zero or above.

    The force is the derivative of the energy, zero at no penetration and never a pull; both are checked. The work over a step is
    the difference of energies, so the balances close as with any other law::

        scenario["projectile.mass.law"] = percuss.Potential(
            energy=lambda p: 1e7 * p**3, force=lambda p: 3e7 * p**2
        )

    It takes the place of the law's other keys, such as ``stiffness``.
    """

    def __init__(self, energy: Callable[[float], float], force: Callable[[float], float]) -> None:
        self.energy = energy
        self.force = force


class Advice(NamedTuple):
    """What the advisor says before a run."""

    verdict: str
    """``fine``, ``note``, ``warning`` or, where the scenario says so in ``[allow]``, ``allowed``."""
    contact: str
    """Name of the contact it is about."""
    text: str
    """What it means and, unless it is fine, what to do."""
    code: str
    """``W002``; ``percuss explain W002`` says what it stands for."""
    reason: str | None
    """Why it is allowed, where it is."""


class Review(list[Advice]):
    """What the advisor says before a run: a list of :class:`Advice` that prints as lines and, in a notebook, as a table."""

    @property
    def warnings(self) -> list[Advice]:
        """What deserves attention: notes and allowed ones are left out."""
        return [one for one in self if one.verdict == "warning"]

    def __repr__(self) -> str:
        if not self:
            return "<percuss.Review: sound, nothing to say>"
        lines = (f"{one.verdict}: {one.text}" + (f" [{one.code}]" if one.code and one.code not in one.text else "") for one in self)
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        if not self:
            return "<p>sound, nothing to say</p>"
        cells = ((one.verdict, one.contact, one.text, one.code, one.reason or "") for one in self)
        rows = "".join("<tr>" + "".join(f"<td style='text-align:left'>{escape(text)}</td>" for text in row) + "</tr>" for row in cells)
        heads = "".join(f"<th>{name}</th>" for name in ("verdict", "about", "what it says", "code", "allowed because"))
        return f"<table><tr>{heads}</tr>{rows}</table>"


class Scenario:
    """A scenario, with the names of the file: ``scenario["projectile.mass.velocity"] = [0, "30 m/s"]``.

    It is the text of a file; what is set here is written into it, comments stay. Nothing is checked before :meth:`check` or a
    run, which then tell every fault at once, with the line in :attr:`text`.
    """

    def __init__(self, text: str = "", name: str = "scenario", *, allow_outside: bool = False) -> None:
        self._text = text
        self._name = name
        self._outside = allow_outside
        self._given: dict[str, list[Callable[[float], float]]] = {}
        self._tree: dict[str, Any] | None = None

    @classmethod
    def from_toml(cls, text: str, name: str = "scenario", *, allow_outside: bool = False) -> Scenario:
        """From the text of a file; ``name`` stands for the file in messages, and files that it names lie where it lies or, with
        ``allow_outside``, anywhere."""
        return cls(text, name, allow_outside=allow_outside)

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], name: str = "scenario") -> Scenario:
        """From nested dictionaries: ``{"time": {"end": "0.15 s", "step": 1e-4}, "beam": {"girder": {...}}, ...}``."""
        scenario = cls(name=name)
        for key, value in tables.items():
            scenario[key] = value
        return scenario

    @property
    def text(self) -> str:
        """The scenario as a file."""
        return self._text

    @property
    def name(self) -> str:
        """What stands for the file in messages."""
        return self._name

    def to_dict(self) -> dict[str, Any]:
        """The scenario as nested dictionaries."""
        return tomllib.loads(self._text)

    def to_toml(self) -> str:
        """The scenario as a file in SI units with every default written out."""
        return _percuss.written(self._source())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes :attr:`text` to a file."""
        with open(path, "w", encoding="utf-8", newline="\n") as file:
            file.write(self._text)

    def copy(self) -> Scenario:
        """One that can be changed without changing this one."""
        other = Scenario(self._text, self._name, allow_outside=self._outside)
        other._given = {path: list(code) for path, code in self._given.items()}
        return other

    def set(self, path: str, value: Any) -> Scenario:
        """The same as ``scenario[path] = value``, and returns the scenario."""
        self[path] = value
        return self

    def check(self) -> Review:
        """Raises :class:`ScenarioError` if anything is wrong; else what the advisor says."""
        return Review(Advice(*one) for one in _percuss.check(self._source()))

    def __getitem__(self, path: str) -> Any:
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
        if isinstance(value, Mapping) and _holds_tables(path, value):
            for key, inner in value.items():
                self[f"{path}.{key}"] = inner
            return
        text = self._text if isinstance(value, Mapping) else _percuss.set(self._text, path, _toml.value(_word(value)))
        given = {p: code for p, code in self._given.items() if p != path and not p.startswith(f"{path}.")}
        if isinstance(value, Mapping):
            plain, functions = _split(value, path)
            text = _percuss.set(self._text, path, _toml.value(plain))
            given.update(functions)
        elif isinstance(value, Potential):
            given[path] = [value.energy, value.force]
            text = _without_laws(text, path)
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
                text = _without_laws(text, path)
            elif callable(value):
                given[path] = [value]
            lines.append(f"{path}={_toml.value(_word(value))}")
        return (text, self._name, lines, given, self._outside)


Scenarios = Union[Scenario, str, "os.PathLike[str]", Mapping[str, Any]]
"""A scenario, the path of its file, or nested dictionaries."""


def load(path: str | os.PathLike[str], *, allow_outside: bool = False) -> Scenario:
    """A scenario from a file. CSV files that it names lie in its folder or below or, with ``allow_outside``, anywhere."""
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
    """What the advisor says of a scenario before a run, as ``percuss check`` does.

    Parameters
    ----------
    scenario : str, path, mapping or Scenario
        A scenario, the path of its file, or nested dictionaries with the file's names.
    **overrides
        Values to change, with ``__`` for the dots of a path: ``time__step="1e-5 s"``.

    Raises
    ------
    ScenarioError
        If anything is wrong: every fault at once, with the lines of the file.

    Examples
    --------
    >>> percuss.check("scenarios/paper/elastic-clamped.toml").warnings
    []
    """
    given = scenario_of(scenario)
    return Review(Advice(*one) for one in _percuss.check(given._source(changes_of(overrides))))


def changes_of(overrides: Mapping[str, Any]) -> dict[str, Any]:
    """Paths of keywords: ``projectile__mass__velocity`` stands for ``projectile.mass.velocity``."""
    return {path.replace("__", "."): value for path, value in overrides.items()}


def _without_laws(text: str, path: str) -> str:
    """The text without what other laws than the one at ``path`` are made of."""
    table = path.removesuffix(".law")
    for key in _OF_OTHER_LAWS:
        try:
            text = _percuss.remove(text, f"{table}.{key}")
        except KeyError:
            pass
    return text


def _word(value: Any) -> Any:
    """What stands in the text for a value."""
    return "given" if isinstance(value, Potential) or callable(value) else value


def _holds_tables(path: str, value: Mapping[str, Any]) -> bool:
    """Whether it is a collection: ``{"left": {...}, "right": {...}}`` of supports."""
    return "." not in path and bool(value) and all(isinstance(inner, Mapping) for inner in value.values())


def _split(table: Mapping[str, Any], path: str) -> tuple[dict[str, Any], dict[str, list[Callable[[float], float]]]]:
    """A table with words in the place of functions, and the functions by path."""
    plain: dict[str, Any] = {}
    functions: dict[str, list[Callable[[float], float]]] = {}
    for key, value in table.items():
        if isinstance(value, Mapping):
            plain[key], inner = _split(value, f"{path}.{key}")
            functions.update(inner)
            continue
        plain[key] = _word(value)
        if isinstance(value, Potential):
            functions[f"{path}.{key}"] = [value.energy, value.force]
        elif callable(value):
            functions[f"{path}.{key}"] = [value]
    return plain, functions
