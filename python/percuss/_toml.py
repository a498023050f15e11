"""Python values as TOML."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Mapping, MutableSequence
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def value(x: Any) -> str:
    """A TOML value."""
    if isinstance(x, bool):
        return "true" if x else "false"
    if isinstance(x, int):
        return str(x)
    if isinstance(x, float):
        return repr(float(x))
    if isinstance(x, os.PathLike):
        x = os.fspath(x)
    if isinstance(x, str):
        return json.dumps(x, ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(x, Mapping):
        return "{ " + ", ".join(f"{key(k)} = {value(v)}" for k, v in x.items()) + " }" if x else "{}"
    if isinstance(x, (list, tuple, MutableSequence)):
        return "[" + ", ".join(value(v) for v in x) + "]"
    if hasattr(x, "tolist"):  # numbers and arrays of NumPy
        return value(x.tolist())
    raise TypeError(f"{x!r} has no place in a scenario: a {type(x).__name__} is neither number, text, list nor table")


def key(name: object) -> str:
    """A TOML key."""
    text = str(name)
    return text if _BARE.fullmatch(text) else json.dumps(text, ensure_ascii=False)


def read(text: str) -> dict[str, Any]:
    """The tables of a text."""
    return tomllib.loads(text)
