"""Codes of exceptions and warnings: each kind has one."""

import pickle
import warnings

import pytest

import percuss

from conftest import SCENARIOS


def midpoint(scenario):
    scenario["integrator.scheme"] = "midpoint"
    return scenario


def test_faults_have_codes_of_their_own_and_the_error_that_of_the_first(elastic):
    elastic["projectile.mass.mass"] = "5 s"
    elastic["beam.girder.material"] = "paper"
    with pytest.raises(percuss.ScenarioError, match=r"\[E006\]") as caught:
        elastic.check()
    codes = {fault.code for fault in caught.value.faults}
    assert codes == {"E006", "E007"}
    assert caught.value.code == caught.value.faults[0].code
    assert isinstance(caught.value, percuss.PercussError) and isinstance(caught.value, ValueError)


def test_analyses_that_give_up_have_codes(elastic):
    with pytest.raises(percuss.AnalysisError, match=r"\[E112\]$") as caught:
        percuss.sensitivity(midpoint(elastic), ["projectile.mass.mass"], [])
    assert caught.value.code == "E112"


def test_modes_without_mass_have_a_code(elastic):
    elastic["material.composite.density"] = 0
    with pytest.raises(percuss.PercussError) as caught:
        percuss.modes(elastic)
    assert caught.value.code in {"E110", "E013"}


def test_a_run_that_fails_has_its_code_in_the_summary():
    flying = midpoint(percuss.load(SCENARIOS / "flying-beam.toml"))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", percuss.PercussWarning)
        result = percuss.run(flying, time__step="0.4 s", check=False)
    assert (result.status, result.summary["error_code"]) == ("failed", "E108")


def test_directories_and_files_have_codes(elastic, tmp_path):
    with pytest.raises(percuss.MissingRunError, match=r"\[E209\]$") as missing:
        percuss.open(tmp_path)
    assert missing.value.code == "E209" and isinstance(missing.value, FileNotFoundError)
    (tmp_path / "mine").write_text("mine")
    with pytest.raises(percuss.InputError, match=r"\[E203\]$") as refused:
        percuss.run(elastic, out=tmp_path / "mine")
    assert refused.value.code == "E203" and isinstance(refused.value, ValueError)
    (tmp_path / "summary.json").write_text("{")
    with pytest.raises(percuss.InputError) as damaged:
        percuss.open(tmp_path)
    assert damaged.value.code == "E202"
    with pytest.raises(percuss.InputError) as shapeless:
        percuss.run(elastic, shapes=0).animate()
    assert shapeless.value.code == "E210"


def test_the_system_s_refusal_has_a_code(elastic, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(percuss.FileError) as caught:
        percuss.run(elastic, out=tmp_path / "file" / "below")
    assert caught.value.code == "E201" and isinstance(caught.value, OSError)


def test_studies_have_codes(study, tmp_path):
    percuss.sweep(study, out=tmp_path / "out")
    study["title"] = "another"
    with pytest.raises(percuss.InputError, match="another study") as caught:
        percuss.sweep(study, out=tmp_path / "out")
    assert caught.value.code == "E301"


def test_codes_travel_between_processes(elastic):
    elastic["projectile.mass.mass"] = "5 s"
    with pytest.raises(percuss.ScenarioError) as caught:
        elastic.check()
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.code, again.faults) == (caught.value.code, caught.value.faults)
    with pytest.raises(percuss.MissingRunError) as missing:
        percuss.open("nowhere")
    again = pickle.loads(pickle.dumps(missing.value))
    assert (again.code, str(again)) == ("E209", str(missing.value))


def test_warnings_of_the_audit_are_raised_with_their_codes(elastic):
    with pytest.warns(percuss.PercussWarning, match=r"energy balance error.*\[W105\]$") as caught:
        result = percuss.run(midpoint(elastic))
    assert [one.message.code for one in caught if one.category is percuss.PercussWarning] == ["W105"]
    assert result.summary["warnings"][0]["code"] == "W105"
    elastic["allow.W105"] = "the midpoint rule is what I look at"
    elastic["allow.W016"] = "the first milliseconds are what I look at"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        allowed = percuss.run(elastic)
    assert allowed.summary["warnings"][0]["verdict"] == "allowed"
