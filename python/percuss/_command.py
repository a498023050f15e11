"""The ``percuss`` command of the wheel."""

from __future__ import annotations

import signal
import sys


def main() -> int:
    """Runs the command line; the exit status."""
    from ._percuss import command

    # Python's own handler would raise after the command has dealt with Ctrl-C.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return command(["percuss", *sys.argv[1:]])
