"""Suggestions for unknown names."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

LISTED = "; `columns` lists them"
"""The end of a message about an unknown column where none is like it: there are too many to name."""


def nearest(name: object, names: Iterable[str], otherwise: str | None = None) -> str:
    """The end of a message about an unknown name: names that are like it, else ``otherwise``, all of them by default."""
    known = list(names)
    close = get_close_matches(str(name), known, n=3)
    if close:
        return f"; did you mean {' or '.join(map(repr, close))}?"
    return f"; expected {'one of ' if len(known) > 1 else ''}{', '.join(known)}" if otherwise is None else otherwise
