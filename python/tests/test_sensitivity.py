"""Derivatives of results against differences of runs."""

import numpy as np
import pytest

import percuss

RESULTS = ["contact.mass.peak_force.value", "projectile.mass.velocity_final[1]", "point.girder.mid.displacement_max.component_2.value"]
PARAMETERS = {"projectile.mass.mass": 1e-3, "projectile.mass.stiffness": 10.0, "material.composite.young": 1e5}


def picked(summary, path):
    for key in path.replace("girder.mid", "girder/mid").replace("[", ".").replace("]", "").split("."):
        key = key.replace("/", ".")
        summary = summary[int(key) if isinstance(summary, list) else key]
    return summary


def test_derivatives_are_those_of_central_differences(elastic):
    found = percuss.sensitivity(elastic, list(PARAMETERS), RESULTS)
    base = percuss.run(elastic).summary
    for row, path in enumerate(RESULTS):
        assert found.results[path] == pytest.approx(picked(base, path), rel=1e-9)
        for column, (parameter, change) in enumerate(PARAMETERS.items()):
            value = found.parameters[parameter]
            ends = []
            for moved in (value - change, value + change):
                scenario = percuss.Scenario.from_toml(elastic.text)
                scenario[parameter] = moved
                ends.append(picked(percuss.run(scenario).summary, path))
            difference = (ends[1] - ends[0]) / (2 * change)
            assert found.derivatives[row, column] == pytest.approx(difference, rel=1e-5)
            assert found[path, parameter] == found.derivatives[row, column]
    assert "<table>" in found._repr_html_()


def test_usual_results_are_differentiated_unless_named(elastic):
    found = percuss.sensitivity(elastic, ["projectile.mass.mass"])
    assert "contact.mass.peak_force.value" in found.results
    with pytest.raises(ValueError, match="'contact.mass.peak_forc.value' is no result of this sensitivity; did you mean"):
        found["contact.mass.peak_forc.value", "projectile.mass.mass"]
    assert np.isfinite(found.derivatives).all()


def test_results_without_derivatives_are_named(elastic):
    elastic["time.end"] = "80 ms"  # beyond the peak: one at the end of the run stays there
    found = percuss.sensitivity(elastic, ["projectile.mass.mass"], ["steps", "contact.mass.peak_force.time"])
    assert found.without == {("steps", "projectile.mass.mass"): "it is a count"}
    assert np.isnan(found["steps", "projectile.mass.mass"])
    assert found["contact.mass.peak_force.time", "projectile.mass.mass"] > 0
    assert found.horizon is None


def test_paths_that_lead_nowhere_are_refused(elastic):
    with pytest.raises(percuss.ScenarioError, match="stiffness"):
        percuss.sensitivity(elastic, ["projectile.mass.stifness"])
    with pytest.raises(percuss.ScenarioError, match="peak_force"):
        percuss.sensitivity(elastic, ["projectile.mass.mass"], ["contact.mass.peak_forc.value"])
    with pytest.raises(percuss.AnalysisError, match="scheme"):
        percuss.sensitivity(elastic, ["projectile.mass.mass"], integrator__scheme="midpoint")
