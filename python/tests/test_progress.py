"""Progress leaves one line, wherever it is shown."""

import subprocess
import sys

import nbformat
import pytest
from nbclient import NotebookClient
from percuss._progress import Progress

from conftest import SCENARIOS

CODE = """
import percuss, percuss._progress
percuss._progress._PATIENCE = 0.0
percuss.run({path!r}, progress=True, **{{"time.end": "20 s"}})
None
""".format(path=str(SCENARIOS / "paper" / "elastic-clamped.toml"))


@pytest.mark.parametrize("tqdm", [True, False])
def test_a_terminal_keeps_one_line(tqdm):
    code = CODE if tqdm else "import sys; sys.modules['tqdm'] = None\n" + CODE
    left = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stderr.decode()
    assert left.count("\n") == 1 and left.count("\r") > 2
    assert "100 %" in left.rsplit("\r", 1)[-1]


def test_a_notebook_keeps_one_line():
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(CODE)])
    NotebookClient(notebook, timeout=120).execute()
    (output,) = notebook.cells[0].outputs
    assert output.output_type == "display_data"
    text = output.data["text/plain"]
    assert "100 %" in text and "\n" not in text and "\r" not in text


def test_a_run_is_listened_to_where_something_is_shown_of_it():
    """The estimate of the time left, a line of its own, is logged of the other runs."""
    heard = []
    listener = Progress(lambda done, total: heard.append((done, total))).listener
    assert listener is not None and Progress(True).listener is not None and Progress(False).listener is None
    listener(1.0, 2.0)
    assert heard == [(1.0, 2.0)]
