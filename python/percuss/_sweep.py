"""Studies on one machine, on an executor, on a Dask cluster: the same shards, the same bytes."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, as_completed
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from . import _percuss
from ._errors import MissingError, PercussWarning, StudyError, coded
from ._options import threads
from ._outcome import NOT_FINAL, warn
from ._progress import Progress
from ._storage import Local, Remote, Store
from ._points import Points
from ._study import StudySource, Sweep, run_shard, study_at, study_of

if TYPE_CHECKING:
    from distributed import Client


def sweep(
    study: StudySource | None = None,
    *,
    points: Points | None = None,
    out: str | os.PathLike[str] | None = None,
    client: Client | None = None,
    executor: Executor | None = None,
    jobs: int = -1,
    progress: bool | Callable[[float, float], object] | None = None,
    allow_outside: bool = False,
    **tables: Any,
) -> Sweep:
    """Computes every run of a study and returns its table.

    By default it runs on all cores of this machine; the table has the same bytes wherever it is computed.

    Parameters
    ----------
    study : str, path, mapping or Study, optional
        A study, the path of its file, or nested dictionaries with its names; or give its tables as keywords.
    points : array of shape (n_run, n_parameter), or table, optional
        Points chosen elsewhere in place of the sampling design, in SI units: an array, its columns in the order of the parameters, or a
        table of pandas, polars or Arrow, a mapping, a structured array or a sample of OpenTURNS, its columns by the names or paths of the
        parameters; another path makes a parameter.
    out : str or path, optional
        Keeps the study: shards as they are done, ``results.parquet`` and ``report.html`` at the end. What was interrupted or killed
        goes on from there. A directory, or with a cluster any location that fsspec knows, such as ``s3://bucket/study``.
    client : distributed.Client, optional
        Run it on a Dask cluster.
    executor : concurrent.futures.Executor, optional
        Run it on an executor: a process pool, mpi4py's.
    jobs : int
        Number of threads; -1 (or 0) for one a core, -2 for one less, as in joblib.
    progress : bool or callable, optional
        Whether a bar is shown; by default on a terminal and in notebooks. A function is called with the runs done and their number.
    allow_outside : bool
        Let the study and its scenario name files that lie anywhere, and not only in their folders or below.
    **tables
        Tables of the study: ``scenario``, ``parameters``, ``design``, ``results``, ``seed``, ``correlations``.

    Returns
    -------
    Sweep
        One row a run.

    Raises
    ------
    TypeError
        If a keyword is no table of a study, ``jobs`` or ``progress`` is something else, a client and an executor are given, points and a
        design, or tables beside a study file.
    ValueError
        If points have columns that no parameter has, or lack one.
    ScenarioError
        If the study has faults.
    StudyError
        If the sweep ended early; the same call goes on from what is kept.
    MissingError
        If a cluster is asked for and Dask is not installed.

    Warns
    -----
    PercussWarning
        If a contact is still closed at the end of runs: which results are not final, and in how many.

    Examples
    --------
    >>> round(percuss.sweep("speed.toml")["peak_force"].max())  # N
    4610
    >>> table = percuss.sweep(
    ...     scenario=percuss.load("plank.toml"),
    ...     parameters={"speed": {"path": "projectile.bag.velocity[1]", "range": {"from": -1, "to": -9, "count": 5}}},
    ...     design={"kind": "grid"},
    ...     results={"peak": "contact.bag.peak_force.value"},
    ... )
    >>> table["speed"]
    array([-1., -3., -5., -7., -9.])
    >>> percuss.sweep("speed.toml", points=[[-2.5], [-7.5]])["peak_force"].round()
    array([1280., 3842.])
    """
    if client is not None and executor is not None:
        raise TypeError("client and executor: give one of the two")
    read = study_of(study, tables, allow_outside) if points is None else study_at(points, study, tables, allow_outside)
    with _directory(out) as place:
        store = _store(place, read)
        with Progress(progress, read.run_count, "runs", "sweep") as bar:
            if client is None and executor is None and isinstance(store, Local):
                read.sweep(store.path, threads(jobs), bar.to)
            else:
                _collect(read, store, _source(client, executor), bar)
        if out is not None:
            store.report()
        table = Sweep(read, store.results(), "" if out is None else store.results_path)
    if table.not_final:
        each = ", ".join(f"`{name}` in {count}" for name, count in table.not_final.items())
        text = f"{each} of {len(table)} runs not final: a contact is still closed at their end, set a later time.end"
        warn(PercussWarning, text, NOT_FINAL)
    return table


@contextmanager
def _directory(out: str | os.PathLike[str] | None) -> Iterator[str]:
    """``out``, or one that goes away afterwards."""
    if out is not None:
        yield os.fspath(out)
        return
    # Threads of a sweep that was interrupted may write for a moment yet.
    with tempfile.TemporaryDirectory(prefix="percuss-", ignore_cleanup_errors=True) as place:
        yield os.path.join(place, "study")


def _store(place: str, study: _percuss.Study) -> Store:
    return Remote(place, study) if "://" in place else Local(place, study)


class _Here:
    """Shards one after the other in this process."""

    def shards(self, text: str, wanted: list[int]) -> Iterator[tuple[int, bytes]]:
        for index in wanted:
            yield index, run_shard(text, index)


class _OnExecutor:
    """Shards on an executor."""

    def __init__(self, executor: Executor) -> None:
        self._executor = executor

    def shards(self, text: str, wanted: list[int]) -> Iterator[tuple[int, bytes]]:
        futures = {self._executor.submit(run_shard, text, index): index for index in wanted}
        try:
            for future in as_completed(futures):
                yield futures[future], future.result()
        finally:
            for future in futures:
                future.cancel()


class _OnDask:
    """Shards on a Dask cluster, which repeats those of workers that die."""

    def __init__(self, client: Client) -> None:
        self._client = client

    def shards(self, text: str, wanted: list[int]) -> Iterator[tuple[int, bytes]]:
        try:
            from distributed import as_completed as as_dask_completes
        except ImportError as error:
            raise MissingError.of("distributed", "a sweep on a cluster", "dask") from error
        futures = {}
        for index in wanted:
            # Each call has keys of its own: nothing that failed or was cancelled before is asked for again.
            future = self._client.submit(run_shard, text, index, pure=False, retries=2)
            futures[future.key] = (index, future)
        try:
            waiting = [future for _, future in futures.values()]
            for future in as_dask_completes(waiting, loop=self._client.loop):
                index, _ = futures.pop(future.key)
                yield index, future.result()
        finally:
            self._client.cancel([future for _, future in futures.values()])


def _source(client: Client | None, executor: Executor | None) -> _Here | _OnExecutor | _OnDask:
    if client is not None:
        return _OnDask(client)
    return _Here() if executor is None else _OnExecutor(executor)


def _collect(study: _percuss.Study, store: Store, source: _Here | _OnExecutor | _OnDask, bar: Progress) -> None:
    """Has the shards that are missing done, keeps each as it comes, and puts them together."""
    wanted = [index for index in range(study.shard_count) if not store.has(index)]
    done = study.run_count - _runs(study, wanted)
    left = set(wanted)
    shards: Iterable[tuple[int, bytes]] = source.shards(study.text, wanted) if wanted else ()
    try:
        for index, data in shards:
            store.keep(index, data)
            left.discard(index)
            done += _runs(study, [index])
            bar.to(done)
    except (KeyboardInterrupt, MissingError):
        raise
    except Exception as error:
        kept = study.shard_count - len(left)
        text = (
            f"the sweep ended early, with {kept} of {study.shard_count} shards kept in {store.path}: "
            f"{type(error).__name__}: {error}; the same call goes on from there"
        )
        raise coded(StudyError, text, "E303") from error
    store.finish()


def _runs(study: _percuss.Study, shards: Iterable[int]) -> int:
    return sum(end - start for start, end in map(study.runs_of, shards))
