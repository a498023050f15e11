"""Studies: whoever does the runs, the table has the same bytes."""

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import percuss
import pyarrow
import pyarrow.parquet
import pytest


def table(path: Path) -> bytes:
    return (path / "results.parquet").read_bytes()


def test_a_sweep_is_a_table_of_runs(study, elastic, tmp_path):
    found = percuss.sweep(study, out=tmp_path / "study")
    assert len(found) == 100 and not found.failures
    assert found.names("input") == ("speed",) and set(found.names("result")) == {"peak_force", "exit"}
    assert found.units["peak_force"] == "N"
    order = found["speed"].argsort()
    assert (np.diff(found["peak_force"][order]) > 0).all()  # the faster, the harder
    one = percuss.run(elastic, projectile__mass__velocity=[0, float(found["speed"][7])])
    assert found["peak_force"][7] == pytest.approx(one.summary["contact"]["mass"]["peak_force"]["value"], rel=1e-9)
    assert pyarrow.table(found)["speed"].to_pylist() == found["speed"].tolist()
    assert pyarrow.parquet.read_table(found.path).num_rows == 100
    assert "smallest" in found._repr_html_() and "100 runs" in repr(found)


def test_keywords_and_a_dictionary_say_the_same(study):
    one, other = percuss.sweep(study), percuss.sweep(**study)
    assert one.study.fingerprint == other.study.fingerprint and one.path == ""
    assert np.array_equal(one["peak_force"], other["peak_force"])


@pytest.mark.parametrize("kind", ["processes", "threads"])
def test_an_executor_gives_the_same_bytes(study, tmp_path, kind):
    percuss.sweep(study, out=tmp_path / "here", jobs=1)
    pool = ProcessPoolExecutor(2, get_context("spawn")) if kind == "processes" else ThreadPoolExecutor(3)
    with pool:
        percuss.sweep(study, out=tmp_path / "there", executor=pool)
    assert table(tmp_path / "there") == table(tmp_path / "here")


def test_finished_shards_are_not_run_again(study, tmp_path):
    class Counting(ThreadPoolExecutor):
        calls = 0

        def submit(self, *arguments):
            Counting.calls += 1
            return super().submit(*arguments)

    percuss.sweep(study, out=tmp_path / "whole")
    shards = sorted((tmp_path / "whole" / "shards").iterdir())
    percuss.sweep(study, out=tmp_path / "part")
    (tmp_path / "part" / "results.parquet").unlink()
    gone = [tmp_path / "part" / "shards" / shards[k].name for k in (0, 3)]
    gone[0].unlink()
    gone[1].write_bytes(gone[1].read_bytes()[:-20])  # cut short, as a full disk does
    with Counting(2) as pool:
        percuss.sweep(study, out=tmp_path / "part", executor=pool)
    assert Counting.calls == 2 and table(tmp_path / "part") == table(tmp_path / "whole")


def test_a_pool_that_breaks_loses_nothing(study, tmp_path):
    class Breaking(ThreadPoolExecutor):
        calls = 0

        def submit(self, *arguments):
            Breaking.calls += 1
            return super().submit(*arguments) if Breaking.calls % 3 else super().submit(os.stat, "/nowhere")

    with Breaking(1) as pool, pytest.raises(percuss.StudyError, match="goes on from there"):
        percuss.sweep(study, out=tmp_path / "study", executor=pool)
    percuss.sweep(study, out=tmp_path / "study")
    percuss.sweep(study, out=tmp_path / "other")
    assert table(tmp_path / "study") == table(tmp_path / "other")


def test_a_location_of_fsspec_holds_a_partitioned_dataset(study, tmp_path):
    import fsspec

    percuss.sweep(study, out=tmp_path / "here")
    found = percuss.sweep(study, out="memory://studies/speed")
    files = fsspec.filesystem("memory")
    assert files.cat_file("/studies/speed/results.parquet") == table(tmp_path / "here")
    parts = files.ls("/studies/speed/shards", detail=False)
    assert len(parts) == found.study.shard_count
    rows = sum(pyarrow.parquet.read_table(files.open(part)).num_rows for part in parts)
    assert rows == 100 and found.path == "memory://studies/speed/results.parquet"
    study["seed"] = 1
    with pytest.raises(ValueError, match="another study"):
        percuss.sweep(study, out="memory://studies/speed")


def test_faults_of_a_study_are_reported(study):
    study["parameters"]["speed"]["path"] = "projectile.mass.velocty[1]"
    with pytest.raises(percuss.ScenarioError, match="velocity"):
        percuss.sweep(study)
    with pytest.raises(TypeError, match="parameter"):
        percuss.sweep(**{"paramter": {}})


def test_functions_have_no_place_in_a_study(study):
    study["scenario"]["projectile.mass.law"] = percuss.Potential(lambda p: p * p, lambda p: 2 * p)
    with pytest.raises(ValueError, match="functions of Python"):
        percuss.sweep(study)


@pytest.fixture
def cluster():
    """A scheduler and two worker processes."""
    from distributed import Client, LocalCluster

    with (
        LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        yield client


def test_a_killed_worker_of_a_cluster_loses_nothing(study, tmp_path, cluster):
    study["design"] = {"kind": "latin-hypercube", "runs": 2000}
    workers = cluster.run(os.getpid)
    assert len(workers) == 2
    done: list[percuss.Sweep] = []
    there = tmp_path / "there"
    thread = threading.Thread(target=lambda: done.append(percuss.sweep(study, client=cluster, out=there)))
    thread.start()
    until = time.monotonic() + 120
    while len(list(there.glob("shards/*.parquet"))) < 2 and time.monotonic() < until:
        time.sleep(0.005)
    kept = len(list(there.glob("shards/*.parquet")))
    os.kill(next(iter(workers.values())), signal.SIGKILL)
    thread.join(timeout=300)
    assert done and len(done[0]) == 2000 and kept < done[0].study.shard_count
    assert set(cluster.run(os.getpid).values()) != set(workers.values())  # a new one took its place
    percuss.sweep(study, out=tmp_path / "here")
    assert table(there) == table(tmp_path / "here")


def write_study(study: dict, path: Path) -> Path:
    study["scenario"].save(path / "base.toml")
    path = path / "speed.toml"
    path.write_text(percuss._study._text(percuss._study._merged(study, {})))
    return path


SWEEP = """
import percuss, sys
print("begun", flush=True)
try:
    percuss.sweep(sys.argv[1], out=sys.argv[2])
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_ctrl_c_ends_a_sweep_which_then_goes_on_from_there(study, tmp_path):
    study["design"] = {"kind": "latin-hypercube", "runs": 4000}
    path, there = write_study(study, tmp_path), tmp_path / "there"
    process = subprocess.Popen([sys.executable, "-c", SWEEP, str(path), str(there)], stdout=subprocess.PIPE, text=True)
    until = time.monotonic() + 60
    while not list(there.glob("shards/*.parquet")) and time.monotonic() < until:
        time.sleep(0.005)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert out == "begun\ninterrupted\n"
    kept = {shard.name: shard.stat().st_mtime_ns for shard in there.glob("shards/*.parquet")}
    done = percuss.sweep(path, out=there)
    assert len(done) == 4000 and 0 < len(kept) < done.study.shard_count
    assert all((there / "shards" / name).stat().st_mtime_ns == then for name, then in kept.items())
    percuss.sweep(path, out=tmp_path / "here")
    assert table(there) == table(tmp_path / "here")


def command(*arguments: str, **more) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "percuss", *arguments], capture_output=True, text=True, **more)


def test_the_command_runs_a_study_on_a_cluster(study, tmp_path, cluster):
    path = write_study(study, tmp_path)
    address = cluster.scheduler.address
    done = command("sweep", str(path), "--scheduler", address, "--out", str(tmp_path / "there"))
    assert done.returncode == 0, done.stderr
    percuss.sweep(path, out=tmp_path / "here")
    assert table(tmp_path / "there") == table(tmp_path / "here")


def test_a_scheduler_that_does_not_answer_is_reported_within_ten_seconds(study, tmp_path):
    path = write_study(study, tmp_path)
    begun = time.monotonic()
    done = command("sweep", str(path), "--scheduler", "tcp://127.0.0.1:1", "--out", str(tmp_path / "there"), timeout=60)
    assert done.returncode == 1 and "no Dask scheduler answers at tcp://127.0.0.1:1" in done.stderr
    assert "Traceback" not in done.stderr and not (tmp_path / "there").exists()
    assert time.monotonic() - begun < 30  # eight seconds of patience, and the start of an interpreter


def test_a_study_can_be_pickled_by_its_text(study):
    read = percuss.sweep(study).study
    assert percuss.Study(read.text, "again").fingerprint == read.fingerprint
    assert pickle.loads(pickle.dumps(read)).fingerprint == read.fingerprint
    with pytest.raises(IndexError, match="of"):
        read.run_shard(10_000)
