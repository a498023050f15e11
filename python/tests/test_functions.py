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


def divides(p: float) -> float:
    return 1.0 / (0.0 * p)


CALLS = {
    "check": percuss.check,
    "run": percuss.run,
    "modes": percuss.modes,
    "static": percuss.static,
    "sensitivity": lambda scenario: percuss.sensitivity(scenario, ["projectile.mass.mass"]),
    "converge": percuss.converge,
    "to_toml": lambda scenario: scenario.to_toml(),
}


@pytest.mark.parametrize("call", list(CALLS))
@pytest.mark.parametrize("law", [percuss.Potential(divides, abs), percuss.Potential(lambda p: p * p, divides)])
def test_an_exception_of_a_law_comes_out_of_every_call(elastic, call, law):
    elastic["projectile.mass.law"] = law
    with pytest.raises(ZeroDivisionError) as caught:
        CALLS[call](elastic)
    assert caught.traceback[-1].name == "divides", "the traceback leads to the line at fault"


def test_an_exception_of_a_function_of_time_comes_out_of_every_call(elastic):
    def unknown(t: float) -> float:
        return {}["no such key"]

    elastic["load.push"] = {"kind": "point", "at": "girder.mid", "force": [0, "1e4 N"], "function": unknown}
    for call in ("run", "static", "converge"):
        with pytest.raises(KeyError, match="no such key"):
            CALLS[call](elastic)


def test_a_law_that_gives_no_number_is_refused(elastic):
    elastic["projectile.mass.law"] = percuss.Potential(lambda p: "much", lambda p: p)
    with pytest.raises(TypeError):
        percuss.run(elastic)


def test_a_law_is_called_in_the_context_of_the_caller(elastic):
    elastic["projectile.mass.law"] = percuss.Potential(lambda p: p * p, lambda p: float(np.float64(1e308) * (10 + 0 * p)))
    with np.errstate(over="raise"), pytest.raises(FloatingPointError):
        percuss.run(elastic)


def test_a_study_says_that_functions_have_no_place_in_it(study):
    study["scenario"]["projectile.mass.law"] = percuss.Potential(divides, divides)
    for call in (percuss.sweep, percuss.function):
        with pytest.raises(ValueError, match="projectile.mass.law: functions of Python have no place in a study"):
            call(study)


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
