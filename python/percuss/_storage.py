"""Where the shards of a study are kept: ``study.toml``, ``shards/``, ``results.parquet``, ``report.html``.

``shards/`` is a partitioned Parquet dataset, one part a shard.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Protocol

from . import _percuss
from ._errors import InputError, MissingError, coded

Columns = list[tuple[str, str, str, str, Any]]


class Store(Protocol):
    """Keeps shards."""

    path: str
    results_path: str

    def has(self, index: int) -> bool:
        """Whether a shard is there, whole and of this study."""

    def keep(self, index: int, data: bytes) -> None:
        """Keeps a shard."""

    def finish(self) -> None:
        """Puts the shards together."""

    def report(self) -> None:
        """Writes ``report.html`` of the finished table, and ``indices.parquet`` of a study with Sobol indices."""

    def results(self) -> Columns:
        """Columns of the finished table."""


def _shard(index: int) -> str:
    return f"shards/shard-{index:06}.parquet"


class Local:
    """A directory, the one of ``percuss sweep --out``."""

    def __init__(self, path: str, study: _percuss.Study) -> None:
        self.path = os.fspath(path)
        self.results_path = os.path.join(self.path, "results.parquet")
        self._study = study
        study.open(self.path)

    def has(self, index: int) -> bool:
        return self._study.is_shard(self._read(index), index) if os.path.exists(self._place(index)) else False

    def keep(self, index: int, data: bytes) -> None:
        _replace(self._place(index), data)

    def finish(self) -> None:
        _replace(self.results_path, self._study.merge(self._read))

    def report(self) -> None:
        _replace(os.path.join(self.path, "report.html"), self._study.report(self.path).encode())
        indices = self._study.indices(self.path)
        if indices is not None:
            _replace(os.path.join(self.path, "indices.parquet"), indices)

    def results(self) -> Columns:
        return self._study.results(self.path)

    def _place(self, index: int) -> str:
        return os.path.join(self.path, *_shard(index).split("/"))

    def _read(self, index: int) -> bytes:
        with open(self._place(index), "rb") as file:
            return file.read()


def _files(place: str) -> tuple[Any, str]:
    """The file system of a location that fsspec knows, and the path there."""
    try:
        from fsspec.core import url_to_fs
    except ImportError as error:
        raise MissingError.of("fsspec", f"files at {place}", "dask") from error
    files, root = url_to_fs(place.rstrip("/"))
    return files, str(root)


def kept(place: str, name: str) -> bytes | None:
    """A file of a directory, or of a location that fsspec knows; None if it is not there."""
    if "://" not in place:
        path = os.path.join(place, name)
        if not os.path.isfile(path):
            return None
        with open(path, "rb") as file:
            return file.read()
    files, root = _files(place)
    path = f"{root}/{name}"
    return bytes(files.cat_file(path)) if files.exists(path) else None


def _replace(path: str, data: bytes) -> None:
    """Writes a file whole or not at all."""
    staging = os.path.join(os.path.dirname(path), f".{os.path.basename(path)}.{os.getpid()}")
    with open(staging, "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
    os.replace(staging, path)


class Remote:
    """Any location that fsspec knows: ``s3://bucket/study``, ``sftp://host/study``, ``memory://study``."""

    def __init__(self, path: str, study: _percuss.Study) -> None:
        self.path = path.rstrip("/")
        self.results_path = f"{self.path}/results.parquet"
        self._study = study
        self._files, self._root = _files(self.path)
        own = f"{self._root}/study.toml"
        text = study.text.encode()
        if self._files.exists(own):
            if self._files.cat_file(own) != text:
                reason = f"{path} belongs to another study, or to an earlier state of this one; choose another out"
                raise coded(InputError, reason, "E301")
        else:
            self._files.makedirs(f"{self._root}/shards", exist_ok=True)
            self._files.pipe_file(own, text)

    def has(self, index: int) -> bool:
        place = f"{self._root}/{_shard(index)}"
        return bool(self._files.exists(place)) and self._study.is_shard(self._read(index), index)

    def keep(self, index: int, data: bytes) -> None:
        self._files.pipe_file(f"{self._root}/{_shard(index)}", data)

    def finish(self) -> None:
        self._files.pipe_file(f"{self._root}/results.parquet", self._study.merge(self._read))

    def report(self) -> None:
        with self._here() as place:
            self._files.pipe_file(f"{self._root}/report.html", self._study.report(place).encode())
            indices = self._study.indices(place)
            if indices is not None:
                self._files.pipe_file(f"{self._root}/indices.parquet", indices)

    def results(self) -> Columns:
        with self._here() as place:
            return self._study.results(place)

    @contextmanager
    def _here(self) -> Iterator[str]:
        """A directory with the finished table."""
        with tempfile.TemporaryDirectory(prefix="percuss-") as place:
            local = Local(os.path.join(place, "study"), self._study)
            _replace(local.results_path, self._files.cat_file(f"{self._root}/results.parquet"))
            yield local.path

    def _read(self, index: int) -> bytes:
        data: bytes = self._files.cat_file(f"{self._root}/{_shard(index)}")
        return data
