"""Accelerations of a run, filtered and as shock response spectra."""

import numpy as np
import pytest

import percuss


def accelerations(run: percuss.Result) -> list[str]:
    return [name.replace("velocity", "acceleration") for name in run.columns if ".velocity_" in name]


def test_an_unfiltered_acceleration_keeps_the_change_of_velocity(elastic):
    run = percuss.run(elastic)
    for name in accelerations(run):
        velocity = run[name.replace("acceleration", "velocity")]
        array = run.filtered(name, cfc=None)
        step = float(array.time[1] - array.time[0])
        # A sum of differences: round-off of as many terms as there are rows.
        assert float(array.sum()) * step == pytest.approx(velocity[-1] - velocity[0], abs=1e-9 * np.abs(velocity).max() + 1e-12)


def test_forces_are_filtered_as_they_are_sampled(elastic):
    run = percuss.run(elastic)
    force = run["contact.mass.force"]
    plain = run.filtered("contact.mass.force", cfc=None)
    if not plain.attrs["resampled"]:
        assert np.array_equal(plain.values, force) and np.array_equal(plain.time.values, run.time)
    # Between its rows a signal is a straight line.
    assert np.allclose(plain.values, np.interp(plain.time.values, run.time, force), atol=1e-9 * force.max())
    assert plain.attrs["units"] == "N" and plain.attrs["long_name"] == "contact.mass.force"
    smooth = run.filtered("contact.mass.force", cfc=60)
    assert smooth.attrs["long_name"] == "contact.mass.force (CFC 60)" and smooth.shape == plain.shape
    # The filter has unit gain at 0 Hz: the impulse stays, the peak does not grow.
    assert float(smooth.sum()) == pytest.approx(float(plain.sum()), rel=0.05) and float(smooth.max()) <= float(plain.max()) * 1.05
    for name in ("support.left.force_2", "support.left.moment", "point.girder.mid.displacement_2"):
        assert run.filtered(name, cfc=None).size > 2


def test_a_spectrum_has_the_larger_of_its_parts(elastic):
    run = percuss.run(elastic)
    data = run.shock_spectrum(accelerations(run)[-1], damping=0.05, from_=50.0, to=500.0)
    for answer in ("acceleration", "pseudo_velocity", "displacement"):
        parts = np.maximum(data[f"{answer}_primary"], data[f"{answer}_residual"])
        assert np.array_equal(data[f"{answer}_maximax"], parts) and parts.max() > 0
    assert data.frequency.values[[0, -1]] == pytest.approx([50.0, 500.0])


def test_channels_without_acceleration_are_refused_with_their_code(elastic):
    run = percuss.run(elastic)
    name = accelerations(run)[0]
    for ask in (
        lambda: run.filtered("contact.mass.impulse"),
        lambda: run.filtered("energy.total"),
        lambda: run.filtered(name, cfc=100),
        lambda: run.shock_spectrum(name, damping=1.0),
        lambda: run.shock_spectrum(name, to=1e12),
    ):
        with pytest.raises(percuss.InputError) as caught:
            ask()
        assert caught.value.code == "E320"
