"""What can be wrong."""

from __future__ import annotations

from typing import NamedTuple


class Fault(NamedTuple):
    """One fault of a scenario."""

    message: str
    """What was found."""
    help: str
    """What would be right."""
    field: str
    """Dotted path of the key, ``section.plank.area``; empty where there is none."""
    line: int | None
    """Line of the file, from 1; none where the fault is no place in it."""
    column: int | None
    """Column in characters, from 1."""


class ScenarioError(ValueError):
    """A scenario has faults: all of them, in the order of the file."""

    def __init__(self, text: str, faults: list[tuple[str, str, str, int | None, int | None]]) -> None:
        super().__init__(text, faults)
        self.faults = [Fault(*fault) for fault in faults]

    def __str__(self) -> str:
        return str(self.args[0])

    @property
    def line(self) -> int | None:
        """Line of the first fault."""
        return self.faults[0].line

    @property
    def column(self) -> int | None:
        """Column of the first fault."""
        return self.faults[0].column

    @property
    def field(self) -> str:
        """Path of the first fault's key."""
        return self.faults[0].field


class AnalysisError(RuntimeError):
    """An analysis found no solution."""


class MissingError(ImportError):
    """An optional package is needed."""

    @classmethod
    def of(cls, package: str, what: str, extra: str) -> MissingError:
        """``package`` is needed for ``what`` and comes with ``extra``."""
        return cls(f'{what} needs {package}: pip install {package}, or pip install "percuss[{extra}]"', name=package)


class StudyError(RuntimeError):
    """A sweep ended before every run was done; what is done is kept."""
