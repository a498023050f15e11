"""Paths of values: one grammar and one set of messages, whatever takes them."""

import json
import subprocess
import sys
from pathlib import Path

import percuss
import pytest

from test_scenario import PLANK

COMMAND = Path(sys.executable).with_name("percuss")

BASE = {
    **PLANK,
    "projectile": {"my__mass": PLANK["projectile"]["mass"]},
    "support": {"left__end": PLANK["support"]["left"], "right": PLANK["support"]["right"]},
    "time": {"end": "2 ms", "step": 1e-4},
}

GOOD = {
    "projectile.my__mass.velocity[1]": 25,
    "projectile.my__mass.velocity.1": 25,
    "projectile.my__mass.mass": 400,
    "beam.girder.points[1][0]": 3.1,
    "beam.girder.points.1.0": 3.1,
    "time.step": 2e-4,
}

INDEX = "the index of an entry, counted from zero, such as `[0]`"
NAME = "a name of letters, digits, `_` and `-`"
PATH = "a path of names and indices, such as `projectile.mass.velocity[1]`"
BAD = {
    "": ("an empty name", PATH),
    "time..end": ("an empty name", PATH),
    "projectile.my__mass.velocity[-1]": ("the index `[-1]`", INDEX),
    "projectile.my__mass.velocity.-1": ("the index `-1`", INDEX),
    "projectile.my__mass.velocity[1": ("the index `[1`", INDEX),
    "projectile.my__mass.velocity[2]": ("the entry `2` of a list of 2", "an entry from 0 to 1"),
    "projectile.my mass.mass": ("the name `my mass`", NAME),
    "projectile.my.mass.mass": ("`mass` behind `mass`", "the path `projectile.my.mass`"),
    "projectile.my_mass.mass": ("the unknown name `my_mass`", "`my__mass`"),
    "support.left.kind": ("the unknown name `left`", "one of `left__end`, `right`"),
    "projectle.my__mass.mass": ("the unknown key `projectle`", "(did you mean `projectile`?)"),
    "projectile.my__mass.velocty[1]": ("the unknown key `velocty`", "(did you mean `velocity`?)"),
    "time.end.more": ("`more` behind `end`", "the path `time.end`"),
    "time.end[0]": ("`0` behind `end`", "the path `time.end`"),
}
ADDED = ("projectile.my_mass.mass", "support.left.kind")
"""Refused where a value is changed; a scenario in the making gets a table of this name."""


def study_of(path, value=1) -> dict:
    """A study that varies the value at a path."""
    return {
        "scenario": percuss.Scenario.from_dict(BASE),
        "parameters": {"p": {"path": path, "values": [value]}},
        "design": {"kind": "grid"},
        "results": {"energy": "energy.final"},
    }


class Doors:
    """What takes a path and a value; each returns what it says against them, if anything."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.scenario = percuss.Scenario.from_dict(BASE)
        self.scenario.save(folder / "base.toml")

    def _raised(self, function, *arguments, **keywords) -> str:
        try:
            function(*arguments, **keywords)
        except percuss.ScenarioError as error:
            return str(error)
        return ""

    def _said(self, *arguments: str, text: str = "") -> str:
        done = subprocess.run([COMMAND, *arguments], cwd=self.folder, input=text, capture_output=True, text=True, timeout=60)
        assert done.returncode in (0, 2), done.stderr
        return done.stderr if done.returncode else ""

    def _study(self, path, value) -> str:
        lines = ['base = "base.toml"', "[parameter.p]", f"path = {json.dumps(path)}", f"values = [{value}]"]
        lines += ["[design]", 'kind = "grid"', "[results]", 'energy = "energy.final"', ""]
        (self.folder / "study.toml").write_text("\n".join(lines), encoding="utf-8")
        return "study.toml"

    def reading(self, path, value):
        return self._raised(lambda: self.scenario[path])

    def setting(self, path, value):
        return self._raised(self.scenario.copy().set, path, value)

    def changes(self, path, value):
        return self._raised(percuss.check, self.scenario, **{path: value})

    def running(self, path, value):
        return self._raised(percuss.run, self.scenario, progress=False, **{path: value})

    def differentiating(self, path, value):
        return self._raised(percuss.sensitivity, self.scenario, [path], ["projectile.my__mass.velocity_final[1]"])

    def studying(self, path, value):
        return self._raised(percuss.function, study_of(path, value))

    def command(self, path, value):
        return self._said("check", "base.toml", "--set", f"{path}={value}")

    def converging(self, path, value):
        return self._said("converge", "base.toml", "--quiet", "--result", "energy.final", "--set", f"{path}={value}")

    def dakota(self, path, value):
        return self._said("eval", self._study(path, value), "-", text=json.dumps({"p": value}))


DOORS = ("reading", "setting", "changes", "running", "differentiating", "studying", "command", "converging", "dakota")


@pytest.fixture
def doors(tmp_path) -> Doors:
    return Doors(tmp_path)


@pytest.mark.parametrize("door", DOORS)
def test_paths_that_lead_somewhere_are_taken_by_every_door(doors, door):
    # Not all that has a path has derivatives; of several runs each, one will do.
    few = {"differentiating": 3, "converging": 1}.get(door, len(GOOD))
    for path, value in list(GOOD.items())[:few]:
        assert getattr(doors, door)(path, value) == "", path


@pytest.mark.parametrize("door", DOORS)
def test_paths_that_lead_nowhere_are_refused_by_every_door_in_the_same_words(doors, door):
    for path, (found, expected) in BAD.items():
        message = getattr(doors, door)(path, 1)
        if door == "setting" and path in ADDED:
            assert message == "", path
            continue
        assert f"found {found}" in message and expected in message, f"{path}: {message}"


def test_um_bridge_and_openturns_refuse_them_too(doors):
    for path, (found, expected) in BAD.items():
        message = doors._said("serve", doors._study(path, 1), "--port", "0")
        assert f"found {found}" in message and expected in message, f"{path}: {message}"
    pytest.importorskip("openturns")
    for path, (found, expected) in BAD.items():
        with pytest.raises(percuss.ScenarioError) as caught:
            percuss.openturns(study_of(path))
        assert f"found {found}" in str(caught.value) and expected in str(caught.value), path


def test_paths_of_results_have_the_same_grammar(doors):
    indexed = "projectile.my__mass.velocity_final"
    for path, found in ((f"{indexed}[-1]", "the index `[-1]`"), (f"{indexed}[1", "the index `[1`"), ("energy..final", "an empty name")):
        study = {**study_of("time.step", 1e-4), "results": {"r": path}}
        message = doors._raised(percuss.function, study)
        assert f"found {found}" in message, message
        message = doors._said("converge", "base.toml", "--quiet", "--result", path)
        assert f"found {found}" in message, message
    for path in (f"{indexed}[1]", f"{indexed}.1"):
        assert percuss.function({**study_of("time.step", 1e-4), "results": {"r": path}}).results == ("r",)


def test_two_underscores_stand_for_a_dot_but_within_names(doors):
    for keyword in ("projectile__my__mass__mass", "projectile.my__mass.mass"):
        assert doors.scenario._source({keyword: 400})[2] == [("projectile.my__mass.mass", "400")]
        percuss.check(doors.scenario, **{keyword: 400})
    with pytest.raises(percuss.ScenarioError, match="400 m"):
        percuss.check(doors.scenario, projectile__my__mass__mass="400 m")


def test_what_is_read_from_a_scenario_writes_into_it(doors):
    scenario = doors.scenario
    scenario["projectile.my__mass.velocity"][1] = "25 m/s"
    assert scenario["projectile.my__mass.velocity"] == [0, "25 m/s"] and '"25 m/s"' in scenario.text
    scenario["projectile"]["my__mass"]["mass"] = 400
    assert scenario.to_dict()["projectile"]["my__mass"]["mass"] == 400
    scenario["beam.girder.points"][1][0] = 3.5
    scenario["beam.girder.points"].insert(1, [1, 0])
    assert scenario.to_dict()["beam"]["girder"]["points"] == [[0, 0], [1, 0], [3.5, 0]]
    del scenario["beam.girder.points[1]"]
    held = scenario["time"]
    scenario["time.end"] = 0.5
    assert held["end"] == 0.5 and dict(held) == scenario.to_dict()["time"]
    with pytest.raises(percuss.PathError, match="did you mean `step`"):
        held["stp"] = 1


def test_a_table_that_is_set_takes_the_place_of_the_table_before(doors):
    scenario = doors.scenario
    scenario["support"] = {"both": {"at": "girder.mid", "kind": "clamp"}}
    assert list(scenario["support"]) == ["both"] and "[support.both]" in scenario.text
    scenario["support"].update({"right": {"at": "girder.end", "kind": "clamp"}})
    assert list(scenario["support"]) == ["both", "right"]
    scenario["support.both"] = {"at": "girder.start", "kind": "clamp"}
    assert scenario["support.both"] == {"at": "girder.start", "kind": "clamp"}
    scenario.check()
    one = percuss.check(scenario, support={"both": {"at": "girder.start", "kind": "clamp"}, "right": scenario["support.right"]})
    assert one == scenario.check()


def test_every_key_that_no_scenario_can_have_is_named_when_a_table_is_set():
    tables = {**BASE, "support": {"left": {"att": "girder.start", "kind": "clamp"}}, "tme": {"end": 1}}
    with pytest.raises(percuss.PathError) as caught:
        percuss.Scenario.from_dict(tables)
    assert [fault.field for fault in caught.value.faults] == ["support.left.att", "tme"]
    assert isinstance(caught.value, (KeyError, ValueError)) and caught.value.code == "E011"
