"""The notebooks of examples/, each run from end to end."""

import os
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_notebook_runs(path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "module://matplotlib_inline.backend_inline")
    monkeypatch.setenv("PERCUSS_EXAMPLE_PLACES", os.environ.get("PERCUSS_EXAMPLE_PLACES", "9"))
    monkeypatch.setenv("PERCUSS_EXAMPLE_RUNS", os.environ.get("PERCUSS_EXAMPLE_RUNS", "10000"))
    notebook = nbformat.read(path, as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "notebooks are kept without outputs"
    NotebookClient(notebook, timeout=600, resources={"metadata": {"path": str(EXAMPLES)}}).execute()
