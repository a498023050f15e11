"""Runs and what they leave."""

import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pandas
import percuss
import pyarrow
import pyarrow.parquet
import pytest
from PIL import Image, ImageSequence

from conftest import SCENARIOS


def test_the_books_close_and_the_summary_is_that_of_the_command(elastic):
    result = percuss.run(elastic)
    assert result.status == "completed"
    assert result.summary["energy"]["residual_max"] < 1e-10
    peak = result.summary["contact"]["mass"]["peak_force"]
    assert peak["value"] >= np.abs(result["contact.mass.force"]).max() > 0
    assert result.units["contact.mass.force"] == "N" and result.time[-1] == 0.04


def test_columns_share_memory_with_the_result(elastic):
    result = percuss.run(elastic)
    one, other = result["energy.total"], result["energy.total"]
    assert one.__array_interface__["data"] == other.__array_interface__["data"]
    assert np.shares_memory(one, other) and not one.flags.owndata and one.base is not None
    assert not one.flags.writeable
    del result
    assert np.isfinite(one).all()  # the array keeps its memory alive


def test_arrow_shares_memory_too_and_knows_units(elastic):
    result = percuss.run(elastic)
    table = pyarrow.table(result)
    assert table.column_names == list(result.columns)
    field = table.schema.field("contact.mass.force")
    assert field.metadata[b"unit"] == b"N"
    chunk = table["contact.mass.force"].chunk(0)
    assert chunk.buffers()[1].address == result["contact.mass.force"].__array_interface__["data"][0]
    assert np.array_equal(table["time"].to_numpy(), result.time)
    assert pyarrow.schema(result).field("time").metadata[b"unit"] == b"s"


def test_pandas_takes_a_result(elastic):
    result = percuss.run(elastic)
    frame = pyarrow.table(result).to_pandas()
    assert isinstance(frame, pandas.DataFrame) and len(frame) == len(result)


def test_a_result_survives_a_pickle(elastic):
    result = percuss.run(elastic)
    again = pickle.loads(pickle.dumps(result))
    assert again.summary == result.summary and again.columns == result.columns
    assert np.array_equal(again["energy.total"], result["energy.total"])
    assert not again["energy.total"].flags.writeable


def test_an_unknown_column_offers_the_nearest(elastic):
    with pytest.raises(KeyError, match="contact.mass.force"):
        percuss.run(elastic)["contact.mass.forc"]


def test_a_result_shows_itself(elastic):
    result = percuss.run(elastic)
    assert "completed" in repr(result) and "peak force" in result._repr_html_()
    assert "<th>status</th><td>Completed, t = " in result._repr_html_()


def test_a_directory_holds_what_the_command_writes(elastic, tmp_path):
    result = percuss.run(elastic, out=tmp_path / "run", report=True)
    names = {path.name for path in (tmp_path / "run").iterdir()}
    assert {"scenario.toml", "summary.json", "history.parquet", "report.html"} <= names
    assert json.loads((tmp_path / "run" / "summary.json").read_text()) == result.summary
    history = pyarrow.parquet.read_table(tmp_path / "run" / "history.parquet")
    assert np.array_equal(history["energy.total"].to_numpy(), result["energy.total"])
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("kept")
    with pytest.raises(ValueError, match="mine|not empty"):
        percuss.run(elastic, out=tmp_path / "full")


def test_other_threads_run_while_the_solver_steps(elastic):
    ticks, stop = [], threading.Event()

    def tick() -> None:
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    begun = time.perf_counter()
    percuss.run(elastic, time__end="0.4 s", shapes=0)
    ended = time.perf_counter()
    stop.set()
    thread.join()
    within = [t for t in ticks if begun < t < ended]
    assert len(within) >= 3  # a held lock would let none through


def test_progress_is_reported_and_an_exception_in_it_ends_the_run(elastic):
    seen = []

    def listen(reached: float, end: float) -> None:
        seen.append((reached, end))
        if len(seen) == 2:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        percuss.run(elastic, progress=listen, time__end="1e3 s")
    assert 0 < seen[0][0] < seen[1][0] < seen[0][1] == 1e3


LONG = """
import percuss, sys
print("begun", flush=True)
try:
    percuss.run(sys.argv[1], out=sys.argv[2], shapes=0, **{"time.end": "1e4 s", "record.every": 1000})
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_ctrl_c_ends_a_run_and_leaves_what_there_is(tmp_path):
    command = [sys.executable, "-c", LONG, str(SCENARIOS / "paper" / "elastic-clamped.toml"), str(tmp_path / "run")]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "begun\n"
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert out == "interrupted\n"
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["status"] == "interrupted"


def test_shapes_follow_the_beam(elastic):
    result = percuss.run(elastic, shapes=50)
    shapes = result.shapes
    # Up to fifty in which something touches, as many others, the last, and those of the largest force and impulse.
    assert 40 <= len(shapes) <= 103 and shapes.times[0] == 0.0 and shapes.times[-1] == result.time[-1]
    row = len(result) - 1
    curve = shapes.at(result.time[row])["girder"]
    middle = curve[np.abs(curve[:, 0] - 1.5).argmin()]
    # Frames are of single precision: 6e-8 of each displacement.
    assert middle[1] == pytest.approx(result["point.girder.mid.displacement_2"][row], rel=1e-6)
    with pytest.raises(ValueError, match="shapes"):
        percuss.run(elastic, shapes=0).plot.beam()


@pytest.mark.parametrize("name", ["energy", "momentum", "force", "displacement", "beam"])
@pytest.mark.parametrize("scenario", ["elastic", "rigid"])
def test_figures_are_drawn(request, scenario, name):
    result = percuss.run(request.getfixturevalue(scenario))
    ax = getattr(result.plot, name)()
    assert ax.lines or ax.collections


def test_an_animation_is_drawn(elastic, tmp_path):
    percuss.run(elastic).animate(tmp_path / "hit.gif", frames=4)
    with Image.open(tmp_path / "hit.gif") as film:
        assert film.n_frames == 4
        pictures = [np.asarray(frame.convert("RGB")) for frame in ImageSequence.Iterator(film)]
    assert all(np.any(a != b) for a, b in zip(pictures, pictures[1:]))


def test_a_film_that_needs_ffmpeg_says_so(elastic, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", "")
    with pytest.raises(ValueError, match="ffmpeg.*gif"):
        percuss.run(elastic).animate(tmp_path / "hit.mp4", frames=2)
    assert not list(tmp_path.iterdir())


def test_without_matplotlib_a_word_says_what_to_install(elastic):
    code = "import sys; sys.modules['matplotlib'] = None; sys.modules['matplotlib.pyplot'] = None; import percuss\n"
    code += f"try: percuss.run({str(SCENARIOS / 'paper' / 'elastic-clamped.toml')!r}).plot.energy()\n"
    code += "except ImportError as error: print(error)"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert "pip install" in out and "percuss[plot]" in out
