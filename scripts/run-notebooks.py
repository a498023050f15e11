"""Runs the notebooks of examples/ and keeps their outputs: `python scripts/run-notebooks.py`, with the package and its `test` extras."""

import os
from pathlib import Path

import nbformat
from nbclient import NotebookClient

EXAMPLES = Path(__file__).parents[1] / "examples"

os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
for path in sorted(EXAMPLES.glob("*.ipynb")):
    notebook = nbformat.read(path, as_version=4)
    NotebookClient(notebook, timeout=1800, resources={"metadata": {"path": str(EXAMPLES)}}).execute()
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)  # when it ran, on which machine, is nobody's concern
    notebook.metadata = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    nbformat.write(notebook, path)
    print(path.name, path.stat().st_size)
