"""Tables and lists of a scenario, which write what is set in them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping, MutableSequence, Sequence
from typing import TYPE_CHECKING, Any, overload

if TYPE_CHECKING:
    from ._scenario import Scenario


class TableView(MutableMapping[str, Any]):
    """A table of a scenario: what is set in it is set in the scenario.

    Examples
    --------
    >>> scenario = percuss.load("plank.toml")
    >>> bag = scenario["projectile.bag"]
    >>> bag["mass"] = "12 kg"
    >>> scenario["projectile.bag.mass"]
    '12 kg'
    """

    def __init__(self, scenario: Scenario, path: str) -> None:
        self._scenario, self._path = scenario, path

    def _keys(self) -> dict[str, Any]:
        found: dict[str, Any] = self._scenario._plain(self._path)
        return found

    def __getitem__(self, key: str) -> Any:
        """What stands behind a key.

        Parameters
        ----------
        key : str
            The key.

        Returns
        -------
        object
            As of the scenario.

        Raises
        ------
        KeyError
            If the table says nothing there.

        Examples
        --------
        >>> percuss.load("plank.toml")["time"]["end"]
        '0.15 s'
        """
        if key not in self._keys():
            raise KeyError(key)
        return self._scenario[f"{self._path}.{key}"]

    def __setitem__(self, key: str, value: Any) -> None:
        self._scenario[f"{self._path}.{key}"] = value

    def __delitem__(self, key: str) -> None:
        del self._scenario[f"{self._path}.{key}"]

    def __iter__(self) -> Iterator[str]:
        return iter(list(self._keys()))

    def __len__(self) -> int:
        return len(self._keys())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Mapping) and bool(plain(self) == plain(other))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return repr(plain(self))


class ListView(MutableSequence[Any]):
    """A list of a scenario: what is set in it is set in the scenario.

    Examples
    --------
    >>> scenario = percuss.load("plank.toml")
    >>> scenario["projectile.bag.velocity"][1] = "-7 m/s"
    >>> scenario["projectile.bag.velocity"]
    [0, '-7 m/s']
    """

    def __init__(self, scenario: Scenario, path: str) -> None:
        self._scenario, self._path = scenario, path

    def _entries(self) -> list[Any]:
        found: list[Any] = self._scenario._plain(self._path)
        return list(found)

    @overload
    def __getitem__(self, index: int) -> Any: ...
    @overload
    def __getitem__(self, index: slice) -> list[Any]: ...
    def __getitem__(self, index: int | slice) -> Any:
        """An entry, or entries as a list of their own.

        Parameters
        ----------
        index : int or slice
            As of any list.

        Returns
        -------
        object
            As of the scenario.

        Raises
        ------
        IndexError
            If the list is shorter.

        Examples
        --------
        >>> percuss.load("plank.toml")["projectile.bag.velocity"][-1]
        '-5 m/s'
        """
        places = range(len(self))[index]
        if isinstance(places, range):
            return [plain(self._at(place)) for place in places]
        return self._at(places)

    def _at(self, place: int) -> Any:
        return self._scenario[f"{self._path}[{place}]"]

    def __setitem__(self, index: int | slice, value: Any) -> None:
        entries = [plain(entry) for entry in self._entries()]
        entries[index] = value
        self._scenario[self._path] = entries

    def __delitem__(self, index: int | slice) -> None:
        entries = self._entries()
        del entries[index]
        self._scenario[self._path] = entries

    def insert(self, index: int, value: Any) -> None:
        """Inserts an entry.

        Parameters
        ----------
        index : int
            Where it will be.
        value : object
            The entry.

        Examples
        --------
        >>> scenario = percuss.load("plank.toml").set("record.points", ["plank.mid"])
        >>> scenario["record.points"].append("plank.end")
        >>> scenario["record.points"]
        ['plank.mid', 'plank.end']
        """
        entries = self._entries()
        entries.insert(index, value)
        self._scenario[self._path] = entries

    def __len__(self) -> int:
        return len(self._entries())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Sequence) or isinstance(other, str):
            return False
        return bool(plain(self) == [plain(one) for one in other])

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return repr(plain(self))


def view(scenario: Scenario, path: str, found: Any) -> Any:
    """What is returned for a value found at a path."""
    if isinstance(found, dict):
        return TableView(scenario, path)
    return ListView(scenario, path) if isinstance(found, list) else found


def plain(value: Any) -> Any:
    """Dictionaries and lists of their own in the place of views."""
    if isinstance(value, Mapping):
        return {key: plain(inner) for key, inner in value.items()}
    if isinstance(value, (ListView, list)):
        return [plain(inner) for inner in value]
    return value
