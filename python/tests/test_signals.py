"""Ctrl-C: every call looks for signals while it works, and raises KeyboardInterrupt."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import SCENARIOS

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")

CODE = """
import os, signal, sys, threading, time
import percuss

sent = []


def send():
    sent.append(time.monotonic())
    os.kill(os.getpid(), signal.SIGINT)


path, place = sys.argv[1:3]
weight = {{"kind": "distributed", "on": "girder", "force": [0, "-1 kN/m"]}}
long = {{"time.end": "1e4 s", "record.every": 1000}}
fine = percuss.load(path)
fine["beam.girder.elements"] = 100_000
fine["load.weight"] = weight
slow = percuss.load(path)
slow["time.end"] = "1e4 s"
study = {{
    "scenario": slow,
    "parameters": {{"speed": {{"path": "projectile.mass.velocity[1]", "range": {{"from": 10, "to": 30}}}}}},
    "design": {{"kind": "sobol", "runs": 64}},
    "results": {{"peak": "contact.mass.peak_force.value"}},
}}
f = percuss.function(study)
mass = {{"mass": {{"path": "projectile.mass.mass", "bounds": ("400 kg", "600 kg")}}}}
record = percuss.Measured({{"t": [0, 1, 2], "F": [0, 1, 2]}}, {{"F": "contact.mass.force"}}, time="t", sigma="1 N")
law = percuss.Potential(lambda p: 3e5 * p**2, lambda p: 6e5 * p)
timer = threading.Timer(0.3, send)
timer.start()
try:
    {call}
    print("finished before the signal")
except KeyboardInterrupt:
    print(time.monotonic() - sent[0])
"""

CALLS = {
    "run": "percuss.run(path, shapes=0, **long)",
    "run with files": "percuss.run(path, out=place, shapes=0, **long)",
    "run with a law": 'percuss.run(path, shapes=0, **long, **{"projectile.mass.law": law})',
    "sweep": "percuss.sweep(study)",
    "sweep with files": "percuss.sweep(study, out=place, jobs=1)",
    "shard": "f.study.run_shard(0)",
    "function": "f([[x] for x in range(10, 30)])",
    "jacobian": "f.jacobian([20])",
    "sensitivity": 'percuss.sensitivity(slow, ["projectile.mass.mass"])',
    "modes": "percuss.modes(fine, 1000, beam__girder__elements=2000)",
    "static": "percuss.static(fine)",
    "path": "percuss.static(fine, path=True)",
    "fit": "percuss.fit(slow, mass, record, jobs=2)",
    "fit from several starting points": "percuss.fit(slow, mass, record, starts=3, jobs=2)",
    "fit without SciPy": 'percuss.fit(slow, mass, record, starts=3, jobs=2, solver="basin")',
    "converge": "percuss.converge(path, 'contact.mass.peak_force.value', time__end='20 s')",
}


def interrupted(call: str, place: Path) -> subprocess.CompletedProcess:
    """A process in which the call is interrupted."""
    arguments = [str(SCENARIOS / "paper" / "elastic-clamped.toml"), str(place / "out")]
    command = [sys.executable, "-c", CODE.format(call=call), *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=100)


@pytest.mark.parametrize("call", list(CALLS))
def test_ctrl_c_raises_keyboard_interrupt_at_once(call, tmp_path):
    done = interrupted(CALLS[call], tmp_path)
    assert done.returncode == 0 and "panicked" not in done.stderr, done.stderr
    assert "finished" not in done.stdout
    # A tenth of a second, and what a busy machine adds.
    assert float(done.stdout) < 1.0


def test_a_handler_of_the_user_s_own_is_heard(tmp_path):
    code = 'signal.signal(signal.SIGINT, lambda *_: (_ for _ in ()).throw(KeyboardInterrupt("mine"))); percuss.modes(fine, 1000, beam__girder__elements=2000)'
    assert float(interrupted(code, tmp_path).stdout) < 1.0


def test_no_entry_of_the_native_module_works_without_looking_for_signals():
    """Only the helper that looks for signals lets go of the interpreter, and the command, whose signals are its own."""
    sources = Path(__file__).parents[2] / "crates" / "percuss-py" / "src"
    loose = {path.name for path in sources.glob("*.rs") if ".detach(" in path.read_text()}
    assert loose == {"watch.rs", "command.rs"}
