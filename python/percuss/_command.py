"""The ``percuss`` command of the wheel."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path


def main() -> int:
    """Does what the command line asks for; the exit status."""
    from ._percuss import command

    # Python's own handler would raise after the command has dealt with Ctrl-C.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # The program is the interpreter here, so the command cannot find the book of the wheel beside it.
    book = Path(__file__).parent / "book"
    if (book / "index.html").is_file():
        os.environ.setdefault("PERCUSS_BOOK", str(book))
    return command(["percuss", *sys.argv[1:]])
