"""Exceptions and warnings."""

from __future__ import annotations

from typing import NamedTuple, TypeVar


class PercussError(Exception):
    """Base class of all exceptions of the package.

    Attributes
    ----------
    code : str or None
        Its code in the catalogue, ``E101``; ``percuss explain E101`` explains it. None if there is none.

    Examples
    --------
    >>> try:
    ...     percuss.open("runs/nothing")
    ... except percuss.PercussError as error:
    ...     print(error.code)
    E209
    """

    code: str | None = None


_Kind = TypeVar("_Kind", bound=PercussError)


def coded(kind: type[_Kind], text: str, code: str | None) -> _Kind:
    """An exception with its code, appended to its text."""
    error = kind(text if code is None else f"{text} [{code}]")
    error.code = code
    return error


class Fault(NamedTuple):
    """One fault of a scenario.

    Attributes
    ----------
    message : str
        What was found.
    help : str
        The valid values.
    field : str
        Dotted path of the key, ``section.plank.area``; empty where there is none.
    line : int or None
        Line of the file, from 1; None where the fault is no place in it.
    column : int or None
        Column in characters, from 1.
    code : str
        ``E006``; ``percuss explain E006`` explains it.

    Examples
    --------
    >>> try:
    ...     percuss.check("plank.toml", projectile__bag__mass="10 s")
    ... except percuss.ScenarioError as error:
    ...     print(error.faults[0].help)
    a mass (kg), such as "500 kg"
    """

    message: str
    help: str
    field: str
    line: int | None
    column: int | None
    code: str


class ScenarioError(PercussError, ValueError):
    """A scenario has faults: all of them, in the order of the file; its code is that of the first.

    Attributes
    ----------
    faults : list of Fault
        All of them.
    excerpt : str
        The lines of the file at fault, underlined, with what would be right; also below the traceback from Python 3.11 on.

    Examples
    --------
    >>> percuss.run("plank.toml", projectile__bag__mass="10 s")
    Traceback (most recent call last):
    percuss._errors.ScenarioError: plank.toml:27:8: projectile.bag.mass: found "10 s", which is a time (s), ...
    """

    def __init__(
        self, text: str, faults: list[tuple[str, str, str, int | None, int | None, str]], excerpt: str = ""
    ) -> None:
        super().__init__(text, faults, excerpt)
        self.excerpt = excerpt
        if excerpt and hasattr(self, "add_note"):
            self.add_note(excerpt)
        self.faults = [Fault(*fault) for fault in faults]
        self.code = self.faults[0].code

    def __str__(self) -> str:
        return str(self.args[0])

    @property
    def line(self) -> int | None:
        """Line of the first fault.

        Returns
        -------
        int or None
            From 1; None where the fault is no place in the file.

        Examples
        --------
        >>> try:
        ...     percuss.check("plank.toml", projectile__bag__mass="10 s")
        ... except percuss.ScenarioError as error:
        ...     print(error.line)
        27
        """
        return self.faults[0].line

    @property
    def column(self) -> int | None:
        """Column of the first fault.

        Returns
        -------
        int or None
            In characters, from 1.

        Examples
        --------
        >>> try:
        ...     percuss.check("plank.toml", projectile__bag__mass="10 s")
        ... except percuss.ScenarioError as error:
        ...     print(error.column)
        8
        """
        return self.faults[0].column

    @property
    def field(self) -> str:
        """Path of the first fault's key.

        Returns
        -------
        str
            With dots; empty where there is none.

        Examples
        --------
        >>> try:
        ...     percuss.check("plank.toml", projectile__bag__mass="10 s")
        ... except percuss.ScenarioError as error:
        ...     print(error.field)
        projectile.bag.mass
        """
        return self.faults[0].field


class PathError(ScenarioError, KeyError):
    """A path of a scenario leads nowhere; also a ``KeyError``.

    Examples
    --------
    >>> scenario = percuss.load("plank.toml")
    >>> scenario["projectile.bag.velocty"] = [0, "-7 m/s"]
    Traceback (most recent call last):
    percuss._errors.PathError: plank.toml: projectile.bag.velocty: found the unknown key `velocty`, expected one of ...
    """


class AnalysisError(PercussError, RuntimeError):
    """An analysis found no solution; also a ``RuntimeError``.

    Examples
    --------
    >>> issubclass(percuss.FailedRunError, percuss.AnalysisError)
    True
    """


class FileError(PercussError, OSError):
    """An I/O error; also an ``OSError``.

    Examples
    --------
    >>> issubclass(percuss.FileError, OSError)
    True
    """


class InputError(PercussError, ValueError):
    """A request that cannot be met, or an invalid file or directory; also a ``ValueError``.

    Examples
    --------
    >>> percuss.converge("plank.toml", levels=2)
    Traceback (most recent call last):
    percuss._errors.InputError: levels=2: expected 3 or more, an order needs three values [E311]
    """


class MissingRunError(PercussError, FileNotFoundError):
    """There is no run at a path; also a ``FileNotFoundError``.

    Examples
    --------
    >>> percuss.open("runs/nothing")
    Traceback (most recent call last):
    percuss._errors.MissingRunError: runs/nothing: no such directory; give the directory ... [E209]
    """


class MissingError(PercussError, ImportError):
    """An optional package is needed; also an ``ImportError``.

    Examples
    --------
    >>> print(percuss.MissingError.of("matplotlib", "plotting", "plot"))
    plotting needs matplotlib: pip install matplotlib, or pip install "percuss[plot]"
    """

    @classmethod
    def of(cls, package: str, what: str, extra: str) -> MissingError:
        """That ``package`` is needed for ``what`` and comes with ``extra``.

        Parameters
        ----------
        package : str
            Its name.
        what : str
            What it is for.
        extra : str
            The extra of this package that brings it.

        Returns
        -------
        MissingError
            To be raised.

        Examples
        --------
        >>> percuss.MissingError.of("distributed", "a sweep on a cluster", "dask").code
        'E304'
        """
        error = cls(f'{what} needs {package}: pip install {package}, or pip install "percuss[{extra}]"', name=package)
        error.code = "E304" if extra == "dask" else None
        return error


class StudyError(PercussError, RuntimeError):
    """A sweep ended before every run was done; finished runs are kept. Also a ``RuntimeError``.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> pool = ThreadPoolExecutor()
    >>> pool.shutdown()
    >>> percuss.sweep("speed.toml", executor=pool)
    Traceback (most recent call last):
        ...
    percuss._errors.StudyError: the sweep ended early, with 0 of 2 shards kept in ...
    """


class PercussWarning(UserWarning):
    """A warning: of the audit of a finished run, of a fit, or one of the subclasses.

    Attributes
    ----------
    code : str or None
        Its code in the catalogue, ``W105``; ``[allow]`` in the scenario takes it away, with a reason.

    Examples
    --------
    >>> import warnings
    >>> warnings.filterwarnings("error", ".*balance error", percuss.PercussWarning)
    >>> percuss.run("plank.toml").status
    'completed'
    """

    code: str | None = None
