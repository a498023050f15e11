"""Scenarios: the file's names, the file's faults."""

import pickle
import sys

import numpy as np
import percuss
import pytest

from conftest import SCENARIOS

PLANK = {
    "title": "from a dictionary",
    "material": {"composite": {"young": "0.2e10 Pa", "density": 3000}},
    "section": {"plank": {"area": "1e3 cm^2", "inertia": "8330 cm^4"}},
    "beam": {
        "girder": {"points": [[0, 0], ["3 m", 0]], "elements": 6, "material": "composite", "section": "plank"}
    },
    "support": {
        "left": {"at": "girder.start", "kind": "clamp"},
        "right": {"at": "girder.end", "kind": "clamp"},
    },
    "projectile": {
        "mass": {
            "kind": "elastic", "mass": 500, "stiffness": 7.5e5, "velocity": [0, "20 m/s"],
            "strikes": "girder.mid", "standoff": "0.2 m",
        }
    },
    "time": {"end": "40 ms", "step": 1e-4},
}  # fmt: skip


def test_a_dictionary_and_a_file_of_the_same_content_give_the_same_bits(elastic):
    one, other = percuss.run(PLANK), percuss.run(elastic)
    assert one.columns == other.columns
    for name in one.columns:
        assert np.array_equal(one[name], other[name], equal_nan=True), name


def test_a_scenario_is_built_path_by_path():
    scenario = percuss.Scenario()
    for kind, value in PLANK.items():
        if isinstance(value, dict) and all(isinstance(inner, dict) for inner in value.values()):
            for name, table in value.items():
                for key, inner in table.items():
                    scenario[f"{kind}.{name}.{key}"] = inner
        else:
            scenario[kind] = value
    scenario.check()
    assert scenario["beam.girder.elements"] == 6
    assert "[support.left]" in scenario.text


def test_setting_a_value_keeps_comments_and_order():
    scenario = percuss.Scenario.from_toml("# first\n[time]\nend = 1 # last\nstep = 0.1\n")
    scenario["time.end"] = np.float64(2.5)
    assert scenario.text == "# first\n[time]\nend = 2.5 # last\nstep = 0.1\n"
    del scenario["time.step"]
    assert "time.step" not in scenario and "time.end" in scenario
    with pytest.raises(KeyError):
        scenario["time.step"]
    with pytest.raises(KeyError):
        scenario["time.end.more"] = 3


def test_a_copy_is_of_its_own(elastic):
    other = elastic.copy()
    other["time.end"] = 1.0
    assert elastic["time.end"] == "40 ms" and other["time.end"] == 1.0 and elastic != other


def test_every_fault_is_reported_with_its_place():
    text = (SCENARIOS / "paper" / "elastic-clamped.toml").read_text()
    text = text.replace('young = "0.2e10 Pa"', 'young = "0.2e10 m"').replace("elements = 6", "elemnts = 6")
    with pytest.raises(percuss.ScenarioError) as caught:
        percuss.Scenario.from_toml(text, "bad.toml").check()
    faults = {fault.field: fault for fault in caught.value.faults}
    young = faults["material.composite.young"]
    assert text.splitlines()[young.line - 1].startswith("young")
    assert young.column == 9 and "Pa" in young.help
    assert any("elements" in fault.help for fault in caught.value.faults)
    assert 'young = "0.2e10 m"' in caught.value.excerpt and "expected" in caught.value.excerpt
    if sys.version_info >= (3, 11):
        assert caught.value.__notes__ == [caught.value.excerpt]
    assert str(caught.value).startswith("bad.toml:")
    assert (caught.value.line, caught.value.field) == (caught.value.faults[0].line, caught.value.faults[0].field)
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.faults == caught.value.faults


def test_an_override_of_what_is_not_there_offers_the_nearest_name(elastic):
    with pytest.raises(percuss.ScenarioError, match="velocity"):
        percuss.run(elastic, **{"projectile.mass.velocty": [0, 1]})
    with pytest.raises(percuss.ScenarioError, match="mass"):
        percuss.run(elastic, projectile__mas__velocity=[0, 1])


def test_overrides_do_not_change_the_scenario(elastic):
    before = elastic.text
    fast = percuss.run(elastic, projectile__mass__velocity=[0, "30 m/s"])
    assert fast["projectile.mass.velocity_2"][0] == 30.0 and elastic.text == before


def test_a_file_that_is_not_there_is_named():
    with pytest.raises(FileNotFoundError, match="nowhere.toml"):
        percuss.load("nowhere.toml")


def test_a_value_without_a_place_is_refused(elastic):
    with pytest.raises(TypeError, match="no place in a scenario"):
        elastic["time.end"] = object()


def test_a_scenario_written_out_is_the_same(elastic):
    again = percuss.Scenario.from_toml(elastic.to_toml())
    assert percuss.run(again).summary["energy"] == percuss.run(elastic).summary["energy"]


def test_the_advisor_speaks(elastic):
    advice = elastic.check()
    assert advice and {one.verdict for one in advice} <= {"fine", "note", "warning"}
    assert percuss.check(elastic) == advice and not advice.warnings
    coarse = percuss.check(elastic, projectile__mass__stiffness="7.5e9 N/m")
    assert coarse.warnings and coarse.warnings[0].code in repr(coarse) and coarse.warnings[0].code in coarse._repr_html_()


def test_a_scenario_reads_files_outside_its_folder_only_if_allowed(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "pulse.csv").write_text("0, 0\n1, 1\n")
    scenario = percuss.Scenario.from_dict(PLANK)
    scenario["load.measured"] = {"kind": "point", "at": "girder.mid", "force": [0, 1]}
    scenario["load.measured.function"] = {"kind": "table", "file": "../pulse.csv"}
    file = tmp_path / "in" / "pull.toml"
    scenario.save(file)
    with pytest.raises(percuss.ScenarioError, match="outside the folder"):
        percuss.load(file).check()
    percuss.load(file, allow_outside=True).check()
    study = {
        "scenario": percuss.load(file, allow_outside=True),
        "parameters": {"step": {"path": "time.step", "values": [1e-4]}},
        "design": {"kind": "grid"},
        "results": {"energy": "energy.final"},
    }
    assert len(percuss.sweep(**study, progress=False)) == 1
