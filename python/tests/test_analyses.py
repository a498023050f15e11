"""Modes, equilibrium, convergence."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import percuss
import pytest

from conftest import SCENARIOS

COMMAND = Path(sys.executable).with_name("percuss")


def test_modes_of_a_clamped_beam_are_those_of_the_closed_form(elastic):
    modes = percuss.modes(elastic, 3, beam__girder__elements=24)
    # Clamped-clamped, Euler-Bernoulli: beta L = 4.7300 and so on; rotary inertia lowers the higher ones a little.
    beta = np.array([4.730040745, 7.853204624]) / 3.0
    exact = beta**2 * math.sqrt(2e9 * 8.33e-5 / (3e3 * 0.1)) / math.tau
    assert modes.frequencies[:2] == pytest.approx(exact, rel=2e-2)
    assert modes.shapes.shape[0] == 3 and "Hz" in modes._repr_html_()
    assert modes.plot(1).lines


def test_an_equilibrium_carries_its_load(elastic):
    elastic["load.tip"] = {"kind": "point", "at": "girder.mid", "force": [0, -1000]}
    found = percuss.static(elastic, record__points=["girder.mid"])
    # P L^3 / (192 E I)
    sag = 1000 * 27 / (192 * 2e9 * 8.33e-5)
    assert found.summary["point"]["girder.mid"]["displacement"][1] == pytest.approx(-sag, rel=1e-3)
    assert found.stable and found.plot().lines


def test_a_mechanism_has_no_equilibrium(elastic):
    del elastic["support"]
    with pytest.raises(percuss.ScenarioError):
        percuss.static(elastic)


def test_halved_steps_show_the_order_of_the_scheme(elastic):
    def place(result: percuss.Result) -> float:
        return float(result["projectile.mass.position_2"][-1])

    found = percuss.converge(elastic, place, refine=["step"], time__step="2e-4 s", time__end="60 ms")["step"]
    assert found.factors == (1, 2, 4, 8) and found.order == pytest.approx(2.0, abs=0.05)
    assert abs(found.values[-1] - found.limit) < abs(found.values[0] - found.limit)


def test_finer_meshes_and_paths_into_the_summary(elastic):
    both = percuss.converge(elastic, "contact.mass.peak_force.value", time__step="5e-4 s")
    assert set(both) == {"step", "mesh"} and both["mesh"].values[0] > 0
    assert "limit" in both["mesh"]._repr_html_() and repr(both).count("<percuss.Convergence in the") == 2
    ax = both.plot()
    assert len(ax.lines) == 2 and ax.get_xscale() == ax.get_yscale() == "log"
    with pytest.raises(KeyError, match="neither a column"):
        percuss.converge(elastic, "contact.mass.peak", time__step="5e-4 s")
    with pytest.raises(ValueError, match="levels"):
        percuss.converge(elastic, levels=2)


def test_orders_are_those_of_the_command(elastic, tmp_path):
    elastic["time.step"] = "5e-4 s"
    path = tmp_path / "elastic.toml"
    elastic.save(path)
    places = ["contact.mass.peak_force.value", "point.girder.mid.displacement_2"]
    words = ["step", "mesh", "together"]
    command = [COMMAND, "converge", str(path), "--json", "--quiet", "-r", places[0], "-r", places[1]]
    answer = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    # Rows lie at the same instants on all levels where a column is asked for, which these results do not depend on.
    for place, printed in zip(places, answer["results"]):
        found = percuss.converge(elastic, place, refine=words)
        for word in words:
            assert list(found[word].values) == [abs(x) * np.sign(found[word].limit) for x in printed[word]["values"]]
            assert found[word].order == printed[word]["order"]
    default = percuss.converge(elastic)["step"]
    assert default.quantity.startswith("point.girder.mid.displacement_max.")
    with pytest.raises(TypeError, match="a list of"):
        percuss.converge(elastic, refine="step")


def test_every_scenario_of_the_project_loads_in_python():
    for path in sorted(SCENARIOS.rglob("*.toml")):
        if "studies" not in path.parts and "[fit]" not in path.read_text():
            percuss.load(path).check()
