"""Contact forces of frames: forces of contacts that have one, impulses of impacts, in arrays, drawings and pages."""

import html
import re

import matplotlib.pyplot as plt
import numpy as np
import percuss
import pytest

from conftest import SCENARIOS

PAPER = SCENARIOS / "paper"

BALLS = """
[material.stuff]
young = "1e9 Pa"
density = "1000 kg/m^3"
[section.bar]
area = "0.01 m^2"
inertia = "1e-5 m^4"
[beam.far]
points = [[0, 9], [1, 9]]
elements = 1
material = "stuff"
section = "bar"
[obstacle.floor]
kind = "half-plane"
point = [0, 0]
normal = [0, 1]
[load.weight]
kind = "gravity"
acceleration = [0, -9.81]
[projectile.resting]
kind = "rigid"
contact = "surface"
mass = 2
radius = 0.1
position = [0, 0.1]
velocity = [0, 0]
strikes = "floor"
restitution = 0
[projectile.above]
kind = "rigid"
contact = "surface"
mass = 1
radius = 0.1
position = [0, 0.33]
velocity = [0, -1]
strikes = "resting"
restitution = 0.5
[time]
end = "40 ms"
step = "1e-4 s"
"""
"""A ball rests on a floor, another one falls on it."""


def of(fields, frame, name, impulsive):
    """Size of the resultant of a contact in a frame."""
    own = [c.force for c in fields.contacts(frame) if c.contact == name and c.impulsive == impulsive]
    return float(np.linalg.norm(np.sum(own, axis=0))) if own else 0.0


@pytest.mark.parametrize("step", ["1e-5 s", "2.5e-6 s"])
@pytest.mark.parametrize("name", ["rigid-clamped-e0.5", "rigid-clamped-e0.5-paper"])
def test_an_impact_is_an_impulse_at_any_step(name, step):
    result = percuss.run(PAPER / f"{name}.toml", time__end="2 ms", time__step=step)
    impacts = result.summary["contact"]["hammer"]["impacts"]
    largest, when = result.fields.largest
    assert largest[False] == 0.0
    assert largest[True] == pytest.approx(max(i["impulse"] for i in impacts), rel=1e-6) and 2800 < largest[True] < 2900
    first = next(i for i in impacts if i["impulse"] == max(i["impulse"] for i in impacts))
    assert 0 <= when - first["time"] <= 1.01e-5
    frame = result.fields.index(when)
    assert of(result.fields, frame, "hammer", True) == pytest.approx(largest[True])
    assert result.fields.contacts(frame - 1) == [] and result.fields.contacts(frame + 1) == []


@pytest.mark.parametrize("name", ["rigid-clamped-e0.5", "rigid-clamped-e0.5-paper", "rigid-clamped-e0"])
def test_a_drawing_opens_where_the_page_does_and_shows_the_impulse(name):
    result = percuss.run(PAPER / f"{name}.toml", time__end="2 ms")
    page = html.unescape(re.search(r'srcdoc="([^"]*)"', result._repr_html_()).group(1))
    opened = float(re.search(r'data-instant="([^"]+)"', page).group(1))
    impacts = result.summary["contact"]["hammer"]["impacts"]
    assert opened == max(impacts, key=lambda impact: impact["impulse"])["time"]
    shown = result._instant()
    assert 0 <= shown - opened <= 1.01e-5
    assert any(c.impulsive for c in result.fields.contacts(result.fields.index(shown)))
    assert result.plot().get_title() == result.plot(shown).get_title()
    arrows = [len(result.plot(hide=hide).texts) for hide in ((), ("forces",))]
    assert arrows[0] == arrows[1] + 1
    plt.close("all")


def test_a_compliant_contact_has_forces_alone(elastic):
    result = percuss.run(elastic)
    largest, when = result.fields.largest
    peak = result.summary["contact"]["mass"]["peak_force"]
    assert largest[True] == 0.0 and largest[False] == pytest.approx(peak["value"], rel=1e-2)
    assert result._instant() == pytest.approx(peak["time"]) and when == pytest.approx(peak["time"], abs=2e-4)


def test_frames_are_counted_from_either_end(elastic):
    fields = percuss.run(elastic, shapes=20, time__end="20 ms").fields
    last = len(fields) - 1
    one, other = fields.contacts(-1), fields.contacts(last)
    assert [c.contact for c in one] == [c.contact for c in other] == ["mass"]
    assert all(np.array_equal(a.force, b.force) for a, b in zip(one, other))
    for frame in (last + 1, -last - 2):
        with pytest.raises(IndexError):
            fields.contacts(frame)


def test_a_contact_at_rest_has_its_force_and_the_impulse_that_it_transmits():
    result = percuss.run(percuss.Scenario.from_toml(BALLS))
    fields, weight = result.fields, 2 * 9.81
    forces = [of(fields, frame, "resting", False) for frame in range(1, len(fields))]
    assert forces == pytest.approx([weight] * len(forces), rel=1e-5)
    struck = [frame for frame in range(len(fields)) if any(c.impulsive for c in fields.contacts(frame))]
    assert len(struck) == 1
    impulse = result.summary["contact"]["above"]["impacts"][0]["impulse"]
    assert of(fields, struck[0], "above", True) == pytest.approx(impulse, rel=1e-6)
    assert of(fields, struck[0], "resting", True) == pytest.approx(impulse, rel=1e-6)
    assert all(of(fields, frame, "above", False) == 0.0 for frame in range(len(fields)))
