"""Functions of Python in a run: as exact as the laws of a file."""

import math
import pickle

import numpy as np
import percuss
import pytest


def test_a_potential_of_python_gives_what_the_law_of_the_file_gives(elastic):
    stiffness = 7.5e5
    built_in = percuss.run(elastic)
    law = percuss.Potential(lambda p: 0.5 * stiffness * p * p, lambda p: stiffness * p)
    own = percuss.run(elastic, projectile__mass__law=law)
    assert own.status == "completed" and own.summary["energy"]["residual_max"] < 1e-10
    scale = np.abs(built_in["contact.mass.force"]).max()
    assert np.abs(own["contact.mass.force"] - built_in["contact.mass.force"]).max() < 1e-8 * scale


@pytest.mark.parametrize(
    "energy, force",
    [
        (lambda p: 1e7 * p**3, lambda p: 3e7 * p * p),
        (lambda p: 4e6 * math.sinh(0.5 * p) ** 2, lambda p: 2e6 * math.sinh(p)),
        (lambda p: 5e5 * p * p + max(p - 0.01, 0.0) ** 2 * 2e6, lambda p: 1e6 * p + max(p - 0.01, 0.0) * 4e6),
    ],
)
def test_books_close_under_any_potential(elastic, energy, force):
    elastic["projectile.mass.law"] = percuss.Potential(energy, force)
    result = percuss.run(elastic)
    assert result.status == "completed"
    assert result["contact.mass.force"].max() > 0
    assert result.summary["energy"]["residual_max"] < 1e-10
    assert result.summary["momentum"]["linear_residual_max"] < 1e-10


def test_a_force_that_is_not_of_its_potential_is_refused(elastic):
    elastic["projectile.mass.law"] = percuss.Potential(lambda p: p * p, lambda p: p)
    with pytest.raises(percuss.ScenarioError, match="derivative of the energy"):
        percuss.run(elastic, **{})


def test_a_load_of_python_acts_over_time(elastic):
    del elastic["projectile"]
    elastic["load.push"] = {"kind": "point", "at": "girder.mid", "force": [0, "1e4 N"], "function": lambda t: math.sin(300 * t)}
    own = percuss.run(elastic, record__points=["girder.mid"])
    elastic["load.push.function"] = {"kind": "harmonic", "frequency": 300 / math.tau}
    built_in = percuss.run(elastic, record__points=["girder.mid"])
    u = "point.girder.mid.displacement_2"
    assert np.abs(built_in[u]).max() > 1e-5
    # Means over a step are taken at three Gauss points: exact to the sixth order.
    assert np.abs(own[u] - built_in[u]).max() < 1e-9 * np.abs(built_in[u]).max()
    assert own.summary["energy"]["residual_max"] < 1e-10


def test_an_exception_in_a_function_comes_out_of_the_run(elastic):
    calls = []

    def force(p: float) -> float:
        calls.append(p)
        if len(calls) > 40:
            raise ZeroDivisionError("in the law")
        return 7.5e5 * p

    elastic["projectile.mass.law"] = percuss.Potential(lambda p: 3.75e5 * p * p, force)
    with pytest.raises(ZeroDivisionError, match="in the law"):
        percuss.run(elastic)


def test_a_text_that_says_given_needs_a_function(elastic):
    elastic["projectile.mass.law"] = "given"
    del elastic["projectile.mass.stiffness"]
    with pytest.raises(percuss.ScenarioError, match="percuss.Potential") as caught:
        elastic.check()
    assert caught.value.field == "projectile.mass.law"


def test_a_function_comes_back_and_goes_away(elastic):
    law = percuss.Potential(lambda p: p * p, lambda p: 2 * p)
    elastic["projectile.mass.law"] = law
    assert elastic["projectile.mass.law"].energy is law.energy
    assert "projectile.mass.stiffness" not in elastic  # it takes its place
    elastic["projectile.mass.law"] = "linear"
    assert elastic["projectile.mass.law"] == "linear"
    assert pickle.loads(pickle.dumps(elastic)) == elastic
