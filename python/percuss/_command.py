"""The ``percuss`` command of the wheel."""

from __future__ import annotations

import sys


def main() -> int:
    """Does what the command line asks for; the exit status."""
    from ._percuss import command

    return command(["percuss", *sys.argv[1:]])
