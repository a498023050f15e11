"""How a run ended and what was found in it, as exceptions and warnings."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ._errors import AnalysisError, PercussWarning

if TYPE_CHECKING:
    from ._result import Result

_PACKAGE = os.path.dirname(os.path.abspath(__file__)) + os.sep


class FailedRunError(AnalysisError):
    """A run did not complete; also an ``AnalysisError``.

    Attributes
    ----------
    result : Result
        The run up to its last step.

    Examples
    --------
    >>> coarse = {"time.step": "20 ms", "time.end": "20 s", "integrator.scheme": "midpoint"}
    >>> try:
    ...     percuss.run("plank.toml", **coarse)
    ... except percuss.FailedRunError as error:
    ...     print(error.code, round(error.result.time[-1], 2))
    E108 0.64
    """

    result: Result


class FailedRunWarning(PercussWarning):
    """A run that is used did not complete: its results are those up to its last step.

    Examples
    --------
    >>> import warnings
    >>> warnings.simplefilter("error", percuss.FailedRunWarning)  # never use one
    >>> percuss.run("plank.toml", check=False).status
    'completed'
    """


class AdviceWarning(PercussWarning):
    """A warning of the model checks, as ``percuss run`` prints it.

    Examples
    --------
    >>> import warnings
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     result = percuss.run("plank.toml", time__step="50 ms")
    >>> sorted({one.message.code for one in caught if one.category is percuss.AdviceWarning})
    ['W002']
    """


def raise_for_status(result: Result) -> None:
    """Raises unless a run completed."""
    if result.status == "completed":
        return
    text, code = _failure(result)
    error = FailedRunError(_coded(text, code))
    error.code = code
    error.result = result
    raise error


#: Code of what says that results are not final: a contact is still closed at the end of a run, or is still to come.
NOT_FINAL = "W016"


def tell(result: Result, check: bool) -> None:
    """Issues the warnings of a run, and raises or warns of one that did not complete.

    A note that results are not final is one of them: it changes what their numbers are.
    """
    found = (one for one in result.summary["advice"] if one["verdict"] == "warning" or one["verdict"] == "note" and one["code"] == NOT_FINAL)
    warn_of_advice((one["contact"], one["topic"], one["text"], one["code"]) for one in found)
    warn_of_audit(result)
    if check:
        raise_for_status(result)
    else:
        warn_of_status(result)


def warn_of_advice(found: Iterable[tuple[str, str, str, str]]) -> None:
    """Issues warnings of the model checks (contact, topic, text, code), those of several contacts once."""
    contacts: dict[tuple[str, str, str], list[str]] = {}
    for contact, topic, text, code in found:
        contacts.setdefault((topic, text, code), []).append(contact)
    for (topic, text, code), of in contacts.items():
        more = f" and {len(of) - 1} more" if len(of) > 1 else ""
        warn(AdviceWarning, f"{of[0]}{more}, {topic}: {text}", code)


def warn_of_audit(result: Result) -> None:
    """Issues what the audit of a run warns of."""
    for one in result.summary["warnings"]:
        if one["verdict"] == "warning":
            warn(PercussWarning, one["text"], one["code"])


def warn_of_status(result: Result) -> None:
    """Warns of a run that did not complete."""
    if result.status != "completed":
        text, code = _failure(result)
        warn(FailedRunWarning, f"{text}; the results are those up to this time", code)


def warn(kind: type[PercussWarning], text: str, code: str | None) -> None:
    """Issues a warning with its code, at the line outside the package that led to it."""
    warning = kind(_coded(text, code))
    warning.code = code
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_PACKAGE):
        level, frame = level + 1, frame.f_back
    warnings.warn(warning, stacklevel=level)


def _coded(text: str, code: str | None) -> str:
    return text if code is None else f"{text} [{code}]"


def _failure(result: Result) -> tuple[str, str | None]:
    """Why a run did not complete, and its code."""
    run = result.summary
    why = run.get("error") or f"{run['status']} at t = {run['time']:.6g} s"
    place = f" ({result.path})" if result.path else ""
    return f"the run did not complete{place}: {why}", run.get("error_code")
