"""``python -m percuss sweep STUDY --scheduler tcp://...``: a study on a Dask cluster. ``percuss sweep`` calls it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from . import ScenarioError, sweep
from ._errors import MissingError, StudyError

_PATIENCE = 8
"""So long a scheduler may take to answer [s]."""


def main(arguments: list[str] | None = None) -> int:
    """Runs the command; its exit status is that of ``percuss``."""
    parser = argparse.ArgumentParser(prog="python -m percuss", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    command = commands.add_parser("sweep", help="run a study on a Dask cluster")
    command.add_argument("study", help="study file")
    command.add_argument("--scheduler", required=True, metavar="ADDRESS", help="Dask scheduler, such as tcp://host:8786")
    command.add_argument("--out", metavar="DIR", help="directory or fsspec location [default: runs/ and the name of STUDY]")
    command.add_argument("--allow-outside", action="store_true", help="let the study and its scenario name files outside their folders")
    command.add_argument("--quiet", "-q", action="store_true", help="say nothing unless something is wrong")
    given = parser.parse_args(arguments)
    out = given.out or str(Path("runs") / Path(given.study).stem)
    try:
        return _sweep(given.study, given.scheduler, out, given.quiet, given.allow_outside)
    except ScenarioError as error:
        return _fail(str(error), 2)
    except KeyboardInterrupt:
        return _fail(f"interrupted; finished runs are kept in {out}, the same command continues [W107]", 130, "warning")
    except (MissingError, StudyError, OSError, ValueError) as error:
        code = f" [{error.code}]" if isinstance(error, MissingError) and error.code else ""
        return _fail(f"{error}{code}", 2 if isinstance(error, (MissingError, ValueError)) else 1)


def _sweep(study: str, scheduler: str, out: str, quiet: bool, allow_outside: bool) -> int:
    from ._study import study_of

    read = study_of(study, {}, allow_outside)  # faults of the study before those of the network
    try:
        from distributed import Client
    except ImportError as error:
        raise MissingError.of("distributed", "a sweep on a cluster", "dask") from error
    try:
        client = Client(scheduler, timeout=_PATIENCE, set_as_default=False)
    except Exception as error:
        text = f"no Dask scheduler answers at {scheduler} within {_PATIENCE} s ({type(error).__name__}: {error})"
        return _fail(f"{text}; is the address right, and the scheduler running? Nothing was begun, nothing is lost [E304]", 1)
    with client:
        table = sweep(read, client=client, out=out, progress=False if quiet else None)
    if not quiet:
        failed = f", {len(table.failures)} not completed" if table.failures else ""
        print(f"{len(table)} runs{failed}: {table.path}", file=sys.stderr)
    return 0


def _fail(text: str, status: int, kind: str = "error") -> int:
    print(f"{kind}: {text}", file=sys.stderr)
    return status


if __name__ == "__main__":
    sys.exit(main())
