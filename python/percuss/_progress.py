"""Progress bars in terminals and notebooks."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, Literal

_PATIENCE = 1.0
"""Shorter runs show nothing [s]."""


class Progress:
    """A bar that appears once something takes a while, one line: tqdm's in a terminal if it is there, else plain text."""

    def __init__(
        self, wanted: bool | Callable[[float, float], object] | None, total: float = 1.0, unit: str = "", name: str = "percuss"
    ) -> None:
        if not (wanted is None or isinstance(wanted, bool) or callable(wanted)):
            raise TypeError(f"progress={wanted!r}: expected True, False or a function of what is done and the total; a path is given as out=")
        self.total = total
        self._listener = wanted if callable(wanted) else None
        self._wanted = _is_watched() if wanted is None else bool(wanted)
        self._begun = time.monotonic()
        self._bar: Any = None
        self._label = (name, unit)
        self._done = 0.0

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> Literal[False]:
        if self._bar is not None:
            if kind is None:
                self._show(self.total)
            self._bar.close()
        return False

    @property
    def listener(self) -> Callable[[float, float], None] | None:
        """What a run calls with its time; None if nobody follows it."""
        return self.to if self._wanted or self._listener is not None else None

    def to(self, done: float, total: float | None = None) -> None:
        """So much is done."""
        if total is not None:
            self.total = total
        if self._listener is not None:
            self._listener(done, self.total)
            return
        if not self._wanted or time.monotonic() - self._begun < _PATIENCE:
            return
        if self._bar is None:
            self._bar = _bar(*self._label, self.total)
        self._show(done)

    def _show(self, done: float) -> None:
        self._bar.update(done - self._done)
        self._done = done


def _is_watched() -> bool:
    return sys.stderr.isatty() or _in_notebook()


def _in_notebook() -> bool:
    return "ipykernel" in sys.modules


def _bar(name: str, unit: str, total: float) -> Any:
    if _in_notebook():
        return _Cell(name, unit, total)
    try:
        from tqdm import tqdm
    except ImportError:
        return _Line(name, unit, total)
    form = "{desc} {percentage:3.0f} %|{bar}| {n:.4g}/{total:.4g} {unit} [{elapsed}<{remaining}]"
    return tqdm(desc=name, total=total, unit=unit, bar_format=form)


class _Line:
    """A line of text on standard error."""

    def __init__(self, name: str, unit: str, total: float) -> None:
        self._name, self._unit, self._total = name, unit, total
        self._begun, self._done = time.monotonic(), 0.0

    def update(self, step: float) -> None:
        self._done += step
        self._write(self._text())

    def _text(self) -> str:
        share = min(self._done / self._total, 1.0)
        spent = time.monotonic() - self._begun
        left = f"{spent * (1 / share - 1):.0f} s left" if 0 < share < 1 else f"{spent:.1f} s"
        filled = "#" * round(24 * share)
        return f"{self._name} [{filled:24}] {100 * share:3.0f} % {left:12}"

    def _write(self, text: str) -> None:
        print(f"\r{text}", end="", file=sys.stderr, flush=True)

    def close(self) -> None:
        print(file=sys.stderr)


class _Cell(_Line):
    """A line below the cell of a notebook, replaced in place: what is saved of it is the last one. tqdm's bar for notebooks
    needs ipywidgets, and without them, or in a saved notebook, leaves a warning or a bar at its start."""

    def __init__(self, name: str, unit: str, total: float) -> None:
        super().__init__(name, unit, total)
        self._shown: Any = None

    def _write(self, text: str) -> None:
        from IPython.display import display

        content = {"text/plain": text.rstrip()}
        if self._shown is None:
            self._shown = display(content, raw=True, display_id=True)  # type: ignore[no-untyped-call, unused-ignore]
        else:
            self._shown.update(content, raw=True)

    def close(self) -> None:
        pass
