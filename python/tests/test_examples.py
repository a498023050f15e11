"""The notebooks of examples/, each run from end to end."""

import os
import re
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
    NotebookClient(notebook, timeout=600, resources={"metadata": {"path": str(EXAMPLES)}}).execute()


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_notebook_is_kept_with_its_outputs(path):
    """`python scripts/run-notebooks.py` makes them."""
    notebook = nbformat.read(path, as_version=4)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    outputs = [output for cell in cells for output in cell.outputs]
    assert all(cell.execution_count for cell in cells)
    assert not [output for output in outputs if output.output_type == "error" or output.get("name") == "stderr"]
    if any("plt." in cell.source or ".plot" in cell.source for cell in cells):
        assert sum("image/png" in output.get("data", {}) for output in outputs) >= 2
    text = path.read_text()
    assert len(text) < 3e6 and not re.search(r"/(home|work|root|tmp|Users)/", text)
