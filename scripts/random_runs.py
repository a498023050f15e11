"""What scripts that run random scenes share: their arguments, and the program."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def arguments(count: int) -> tuple[int, int, str]:
    """COUNT, SEED and PROGRAM of the command line, by default some scenes from seed 0 with the program that cargo built."""
    given = sys.argv[1:]
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    return (
        int(given[0]) if given else count,
        int(given[1]) if len(given) > 1 else 0,
        given[2] if len(given) > 2 else str(target / "debug" / "percuss"),
    )
