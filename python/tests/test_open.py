"""Runs and sweeps read back, and what is the same through Python and through the command."""

import json
import pickle
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import percuss
import pytest
import xarray

from conftest import SCENARIOS

SPEED = {
    "title": "speed",
    "parameters": {"speed": {"path": "projectile.mass.velocity[1]", "range": {"from": -10, "to": -30, "count": 5}}},
    "design": {"kind": "grid"},
    "results": {"peak_force": "contact.mass.peak_force.value"},
}


@pytest.fixture
def speeds(elastic):
    """A small study on a grid."""
    elastic["time.step"] = "1 ms"
    return {**SPEED, "scenario": elastic}


def command(*arguments, **more):
    return subprocess.run([Path(sys.executable).with_name("percuss"), *arguments], capture_output=True, text=True, **more)


def same(one, other):
    assert one.columns == other.columns and one.units == other.units and one.descriptions == other.descriptions
    for name in one.columns:
        assert np.array_equal(one[name], other[name], equal_nan=one[name].dtype.kind == "f"), name


def test_a_sweep_opens_as_it_was(speeds, tmp_path):
    table = percuss.sweep(speeds, out=tmp_path / "speeds")
    again = percuss.open(tmp_path / "speeds")
    assert isinstance(again, percuss.Sweep) and repr(again) == repr(table) and again.path == table.path
    same(again, table)
    assert again.study.fingerprint == table.study.fingerprint
    assert {name: again.role(name) for name in again.columns} == {name: table.role(name) for name in table.columns}
    # Reading writes nothing, and needs nothing but the study and its table.
    (tmp_path / "copy").mkdir()
    for name in ("study.toml", "results.parquet"):
        shutil.copy(tmp_path / "speeds" / name, tmp_path / "copy")
    same(percuss.open(tmp_path / "copy"), table)
    assert {path.name for path in (tmp_path / "copy").iterdir()} == {"study.toml", "results.parquet"}


def test_a_sweep_of_the_command_opens(speeds, tmp_path):
    table = percuss.sweep(speeds)
    (tmp_path / "study.toml").write_text(table.study.text)
    done = command("sweep", str(tmp_path / "study.toml"), "--out", str(tmp_path / "out"))
    assert done.returncode == 0, done.stderr
    same(percuss.open(tmp_path / "out"), table)


def test_a_sweep_at_a_location_of_fsspec_opens(speeds):
    table = percuss.sweep(speeds, out="memory://opened/speeds")
    again = percuss.open("memory://opened/speeds")
    same(again, table)
    assert again.path == table.path == "memory://opened/speeds/results.parquet"


def test_what_is_no_finished_sweep_is_refused(speeds, tmp_path):
    percuss.sweep(speeds, out=tmp_path / "speeds")
    table = tmp_path / "speeds" / "results.parquet"
    table.rename(tmp_path / "kept.parquet")
    with pytest.raises(percuss.MissingRunError, match="not finished.*same `out`"):
        percuss.open(tmp_path / "speeds")
    table.write_bytes((tmp_path / "kept.parquet").read_bytes()[:-30])
    with pytest.raises(percuss.InputError, match="damaged"):
        percuss.open(tmp_path / "speeds")
    other = {**speeds, "results": {"exit": "projectile.mass.velocity_final[1]"}}
    percuss.sweep(other, out=tmp_path / "other")
    shutil.copy(tmp_path / "other" / "results.parquet", table)
    with pytest.raises(percuss.InputError, match="other columns"):
        percuss.open(tmp_path / "speeds")


def test_a_sweep_is_a_data_set(speeds, tmp_path):
    table = percuss.sweep(speeds, out=tmp_path / "speeds")
    for data in (table.to_xarray(), percuss.open(tmp_path / "speeds").to_xarray()):
        assert isinstance(data, xarray.Dataset) and dict(data.sizes) == {"run": 5}
        assert data["peak_force"].attrs["units"] == "N" and data["peak_force"].attrs["role"] == "result"
        assert data["speed"].attrs["units"].replace(" ", "") in ("m/s", "ms-1") and "speed" in data.coords
        assert np.array_equal(data["peak_force"].values, table["peak_force"])
        fastest = data.set_xindex("speed").sel(speed=-30.0)["peak_force"]
        assert float(fastest) == table["peak_force"].max()
        assert set(data["status"].values) == {"completed"} and data.attrs["title"] == "speed"


def test_a_run_without_frames_is_a_data_set_wherever_it_comes_from(elastic, tmp_path):
    result = percuss.run(elastic, out=tmp_path / "run", shapes=0)
    again = percuss.open(tmp_path / "run")
    assert again.to_xarray().identical(result.to_xarray())
    whole = percuss.run(elastic, out=tmp_path / "whole", shapes=5)
    assert percuss.open(tmp_path / "whole").to_xarray().identical(whole.to_xarray())


def arrays(value):
    """All arrays in nested lists, tuples and dictionaries."""
    if isinstance(value, np.ndarray):
        yield value
    for entry in value.values() if isinstance(value, dict) else value if isinstance(value, (list, tuple)) else ():
        yield from arrays(entry)


def test_no_array_of_results_can_be_written_to(elastic, speeds):
    objects = [percuss.run(elastic), percuss.sweep(speeds), percuss.modes(elastic, 2), percuss.static(elastic)]
    objects.append(percuss.sensitivity(elastic, ["projectile.mass.mass"]))
    objects += [pickle.loads(pickle.dumps(one)) for one in objects]
    for one in objects:
        own = list(arrays(one._native))
        assert own and not any(array.flags.writeable for array in own), type(one)
    table = percuss.sweep(speeds)
    assert table["run"].dtype.kind == "i"
    with pytest.raises(ValueError, match="read-only"):
        table["run"][0] = 7


def test_a_summary_is_the_same_from_python_and_from_the_command(tmp_path):
    file = str(SCENARIOS / "paper" / "rigid-clamped-e0.toml")
    percuss.run(file, out=tmp_path / "python", time__end="1 ms", shapes=5)
    # Bare text for quantities, as on a command line.
    done = command("run", file, "--out", str(tmp_path / "command"), "--set", "time.end=1 ms", "--no-report", "--quiet")
    assert done.returncode == 0, done.stderr
    ours, theirs = (json.loads((tmp_path / name / "summary.json").read_text()) for name in ("python", "command"))
    assert list(ours) == list(theirs)
    for summary in (ours, theirs):
        assert summary.pop("wall_seconds") > 0 and summary["provenance"].pop("started").endswith("Z")
        assert summary["provenance"]["scenario"] == file
        (change,) = summary["provenance"].pop("overrides")
        assert change.replace('"', "") == "time.end=1 ms"
    assert ours == theirs and ours["advice"] and ours["provenance"]["machine"]
