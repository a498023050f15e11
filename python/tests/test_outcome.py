"""How a run ended: failed runs are not taken for others, warnings of the model checks are heard."""

import os
import pickle
import warnings

import pytest

import percuss

from conftest import SCENARIOS

COARSE = {"integrator.scheme": "midpoint", "time.step": "0.4 s"}


@pytest.fixture
def flying() -> percuss.Scenario:
    return percuss.load(SCENARIOS / "flying-beam.toml")


def failed(scenario, **options) -> percuss.Result:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", percuss.PercussWarning)
        return percuss.run(scenario, check=False, **options, **COARSE)


@pytest.mark.filterwarnings("ignore::percuss.PercussWarning")
def test_a_failed_run_is_raised_with_what_there_is_of_it(flying):
    with pytest.raises(percuss.FailedRunError, match=r"the run did not complete: .*\[E108\]$") as caught:
        percuss.run(flying, **COARSE)
    assert isinstance(caught.value, percuss.AnalysisError) and caught.value.code == "E108"
    assert caught.value.result.status == "failed" and len(caught.value.result) > 1
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.code, again.result.status) == ("E108", "failed")


def test_a_failed_run_that_is_wanted_comes_with_a_warning_of_its_own(flying):
    with pytest.warns(percuss.FailedRunWarning, match=r"did not complete.*up to this time \[E108\]$") as caught:
        result = percuss.run(flying, check=False, **COARSE)
    (own,) = [one for one in caught if one.category is percuss.FailedRunWarning]
    assert own.message.code == "E108" and own.filename == __file__, "the warning points at the caller"
    with pytest.raises(percuss.FailedRunError):
        result.raise_for_status()


def test_a_run_that_completed_passes(elastic, tmp_path):
    elastic["allow.W016"] = "the first milliseconds are what I look at"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = percuss.run(elastic, out=tmp_path / "run")
        assert result.raise_for_status() is result
        again = percuss.open(tmp_path / "run")
    assert result.path == again.path == os.fspath(tmp_path / "run")
    assert pickle.loads(pickle.dumps(result)).path == result.path
    assert percuss.run(elastic).path == ""


def test_an_earlier_run_is_not_taken_for_the_failed_one(flying, tmp_path):
    out = tmp_path / "run"
    percuss.run(flying, out=out)
    result = failed(flying, out=out)
    assert result.path == f"{out}.incomplete"
    with pytest.warns(percuss.FailedRunWarning, match=r"a later one did not, and its results are in .*run\.incomplete$"):
        assert percuss.open(out).status == "completed"
    with pytest.warns(percuss.FailedRunWarning, match=r"\[E108\]$"):
        assert percuss.open(result.path).status == "failed"
    later = os.path.getmtime(os.path.join(result.path, "summary.json")) + 10
    percuss.run(flying, out=out)
    os.utime(out / "summary.json", (later, later))
    with warnings.catch_warnings():
        warnings.simplefilter("error", percuss.FailedRunWarning)
        assert percuss.open(out).status == "completed"


def test_warnings_of_the_model_checks_are_heard_once_and_can_be_allowed(elastic):
    elastic["time.end"], elastic["time.step"] = "1 s", "20 ms"
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        percuss.run(elastic)
    own = [one for one in caught if one.category is percuss.AdviceWarning]
    assert [one.message.code for one in own] == ["W002"]
    assert str(own[0].message).startswith("mass, contact duration: the contact lasts about") and own[0].filename == __file__
    elastic["allow.W002"] = "a coarse step is what I look at"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        percuss.run(elastic)


ARM = """
[material.steel]
preset = "S235"
[section.s]
shape = "rectangle"
width = "10 cm"
depth = "10 cm"
[beam.arm]
points = [[0, 0], [1, 0]]
elements = 4
material = "steel"
section = "s"
[support.left]
at = "arm.start"
kind = "clamp"
[load.push]
kind = "point"
at = "arm.end"
force = [0, "-100 kN"]
[time]
end = 1e-3
step = 1e-4
"""


def test_a_static_equilibrium_warns_of_what_the_command_warns_of():
    arm = percuss.Scenario(ARM)
    with pytest.warns(percuss.AdviceWarning, match=r"beam arm, usual strength exceeded: .* \[W018\]$") as caught:
        percuss.static(arm)
    assert [one.message.code for one in caught] == ["W018"]
    arm["allow.W018"] = "the strength is known to be higher"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        percuss.static(arm)
