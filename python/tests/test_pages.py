"""The Python blocks of the documentation: those of a page run one after the other in one namespace, in a folder with the files that the
page speaks of. A block that cannot run here says why: ```` ```python,unrun=needs Slurm ````. One that asks a server has it started:
```` ```python,server=STUDY ````."""

from __future__ import annotations

import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

import book_files
import pytest
from book_files import ROOT, Block

BOOK = ROOT / "docs" / "book"
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), *sorted((BOOK / "src").rglob("*.md"))]
COMMAND = Path(sys.executable).with_name("percuss")
PORT = "4242"
"""The port that pages speak of; another stands there when their blocks run."""


def python_of(page: Path) -> list[Block]:
    return [block for block in book_files.blocks(page) if block.language == "python"]


BLOCKS = {page: found for page in PAGES if (found := python_of(page))}
UNRUN = [(page, block) for page, found in BLOCKS.items() for block in found if block.value("unrun") is not None]


@contextmanager
def served(study: str) -> Iterator[str]:
    """A server of a study; its port."""
    line = [COMMAND, "serve", study, "--port", "0"]
    with subprocess.Popen(line, stderr=subprocess.PIPE, text=True) as server:
        try:
            assert server.stderr is not None
            address = next(word for word in server.stderr.readline().split() if word.startswith("http"))
            yield address.rstrip("/").rpartition(":")[2]
        finally:
            server.send_signal(signal.SIGINT)


@pytest.mark.parametrize("page", BLOCKS, ids=lambda page: str(page.relative_to(ROOT)))
def test_the_blocks_of_a_page_run(page, tmp_path, monkeypatch):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    book_files.write(tmp_path)
    for example in (BOOK / "examples").iterdir():
        shutil.copy(example, tmp_path)
    shutil.copytree(ROOT / "scenarios", tmp_path / "scenarios")
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "page"}
    for block in BLOCKS[page]:
        if block.value("unrun") is not None:
            compile(block.text, page.name, "exec")
            continue
        study = block.value("server")
        # Lines of tracebacks are those of the page.
        text = "\n" * (block.line - 1) + block.text
        with served(study) if study else nullcontext(PORT) as port:
            exec(compile(text.replace(PORT, port), str(page), "exec"), names)
    pyplot.close("all")


def test_a_block_that_does_not_run_says_why():
    """Blocks that are only read: three ways to a cluster."""
    reasons = sorted(block.value("unrun") or "" for _, block in UNRUN)
    assert reasons == ["needs MPI", "needs Slurm", "needs a Dask cluster and a bucket"]
    assert sum(map(len, BLOCKS.values())) - len(UNRUN) >= 15


def test_marks_of_blocks_are_known():
    for found in BLOCKS.values():
        for block in found:
            assert all(mark.partition("=")[0] in ("unrun", "server") and mark.partition("=")[2] for mark in block.marks), block
