"""Figures: instants within the run, scales on the axes, colours that tell bodies apart."""

import matplotlib.pyplot as plt
import numpy as np
import percuss
import pytest
from matplotlib.collections import LineCollection

from conftest import SCENARIOS


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def test_an_instant_outside_the_run_is_refused(elastic, tmp_path):
    result = percuss.run(elastic, shapes=20)
    end = float(result.fields.time[-1])
    for t in (-1e-6, 1.001 * end, 7.0, float("nan"), float("inf")):
        for ask in (
            lambda t=t: result.plot(t),
            lambda t=t: result.plot.beam(t),
            lambda t=t: result.fields.index(t),
            lambda t=t: result.fields.displacement_at(t),
            lambda t=t: result.shapes.index(t),
            lambda t=t: result.shapes.at(t),
            lambda t=t: result.animate(frames=2, span=(0.0, t)),
            lambda t=t: result.animate(tmp_path / "film.gif", frames=2, span=(t, end)),
        ):
            with pytest.raises(percuss.InputError, match="from 0 s to 0.04 s") as caught:
                ask()
            assert caught.value.code == "E313"
    assert not list(tmp_path.iterdir())
    for t in (0.0, 0.3 * end, end, end * (1 + 1e-12)):
        assert result.plot(t).get_title().startswith("t = ")
    assert result.plot.beam().get_title() == result.plot(end).get_title()


def test_a_scale_is_named_on_the_axes(elastic):
    result = percuss.run(elastic, shapes=5)
    scaled, plain = result.plot(0.01, scale=3.0), result.plot(0.01)
    assert scaled.get_xlabel() == "x [m], displacements \u00d7 3" and scaled.get_ylabel() == "y [m], displacements \u00d7 3"
    assert plain.get_xlabel() == "x [m]" and plain.get_ylabel() == "y [m]"
    rest = percuss.static(elastic)
    assert rest.plot(scale=10).get_xlabel() == "x [m], displacements \u00d7 10" and rest.plot().get_xlabel() == "x [m]"
    modes = percuss.modes(elastic, 2)
    ax = modes.plot(2, amplitude=0.2)
    shape = modes.shapes[1]
    # A fifth of the beam of 3 m, by the largest displacement at a node.
    factor = 0.2 * 3.0 / float(np.hypot(shape[:, 0], shape[:, 1]).max())
    assert float(ax.get_xlabel().split("\u00d7")[1]) == pytest.approx(factor, rel=1e-2)


def test_modes_are_counted_from_one(elastic):
    modes = percuss.modes(elastic, 2)
    for number in (0, -1, 3):
        with pytest.raises(IndexError, match="from 1 to 2"):
            modes.plot(number)
    assert [modes.plot(number).get_title().split(":")[0] for number in (1, 2)] == ["mode 1", "mode 2"]


def test_impulses_of_each_body_have_a_colour_of_their_own():
    result = percuss.run(SCENARIOS / "disc-chain.toml", shapes=5)
    ax = result.plot.force()
    marks = [line for line in ax.lines if line.get_marker() == "o"]
    stems = [own for own in ax.collections if isinstance(own, LineCollection)]
    assert len(marks) == len(stems) > 2
    colours = [tuple(plt.matplotlib.colors.to_rgba(line.get_color())) for line in marks]
    assert len(set(colours)) == len(colours)
    assert [tuple(own.get_colors()[0]) for own in stems if len(own.get_segments())] == [
        colour for colour, own in zip(colours, stems) if len(own.get_segments())
    ]


def test_values_without_an_order_are_not_drawn_to_zero():
    steady = percuss.Convergence("step", "F", (1, 2, 4), (4.0, 2.0, 1.5), 2.0, 1.3, 2.7, 0.1)
    without = percuss.Convergence("mesh", "F", (1, 2, 4), (4.0, 2.0, 3.0), None, 3.0, 1.0, 1.25)
    for found, drawn in ((steady, 3), (without, 2)):
        (line,) = found.plot().lines
        values = np.asarray(line.get_ydata(), float)
        assert np.isfinite(values).sum() == drawn and (values[np.isfinite(values)] > 0).all()
    low, high = plt.gca().get_ylim()
    assert low > 0.01 and high < 100
