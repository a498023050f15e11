"""What can be wrong."""

from __future__ import annotations

from typing import NamedTuple, TypeVar


class PercussError(Exception):
    """What all exceptions of the package are."""

    code: str | None = None
    """Its code in the catalogue, ``E101``; ``percuss explain E101`` says what it stands for. None where there is none."""


_Kind = TypeVar("_Kind", bound=PercussError)


def coded(kind: type[_Kind], text: str, code: str | None) -> _Kind:
    """An exception with its code, which stands behind its text."""
    error = kind(text if code is None else f"{text} [{code}]")
    error.code = code
    return error


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
    code: str
    """``E006``; ``percuss explain E006`` says what it stands for."""


class ScenarioError(PercussError, ValueError):
    """A scenario has faults: all of them, in the order of the file; its code is that of the first."""

    def __init__(
        self, text: str, faults: list[tuple[str, str, str, int | None, int | None, str]], excerpt: str = ""
    ) -> None:
        super().__init__(text, faults, excerpt)
        self.excerpt = excerpt
        """The lines of the file at fault, underlined, with what would be right; also below the traceback from Python 3.11 on."""
        if excerpt and hasattr(self, "add_note"):
            self.add_note(excerpt)
        self.faults = [Fault(*fault) for fault in faults]
        self.code = self.faults[0].code

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


class AnalysisError(PercussError, RuntimeError):
    """An analysis found no solution."""


class FileError(PercussError, OSError):
    """The system did not let a file be read or written."""


class InputError(PercussError, ValueError):
    """What is asked for cannot be had, or a file or directory is not what it should be."""


class MissingRunError(PercussError, FileNotFoundError):
    """There is no run at a path."""


class MissingError(PercussError, ImportError):
    """An optional package is needed."""

    @classmethod
    def of(cls, package: str, what: str, extra: str) -> MissingError:
        """``package`` is needed for ``what`` and comes with ``extra``."""
        error = cls(f'{what} needs {package}: pip install {package}, or pip install "percuss[{extra}]"', name=package)
        error.code = "E304" if extra == "dask" else None
        return error


class StudyError(PercussError, RuntimeError):
    """A sweep ended before every run was done; what is done is kept."""


class PercussWarning(UserWarning):
    """Something of a finished run that deserves attention."""

    code: str | None = None
    """Its code in the catalogue, ``W105``; ``[allow]`` in the scenario takes it away, with a reason."""
