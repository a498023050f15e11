"""The scene in notebooks and figures; results as tables."""

import html
import re
from collections.abc import Mapping

import matplotlib.pyplot as plt
import numpy as np
import pandas
import percuss
import pytest
import xarray
from IPython.lib.pretty import pretty
from matplotlib.patches import Circle

from conftest import SCENARIOS
from percuss._scene import SceneBeam


UNKNOWN = "no stress known: sections without depth, or that yield"
"""What stands in place of a scale of stresses where no beam has any."""


def page_of(result):
    """The page inside the frame."""
    return html.unescape(re.search(r'srcdoc="([^"]*)"', result._repr_html_()).group(1))


@pytest.mark.parametrize("name", ["paper/elastic-clamped", "disc-chain", "portal-frame", "tapping-cantilever"])
def test_a_notebook_shows_the_scene_by_itself(name):
    result = percuss.run(SCENARIOS / f"{name}.toml")
    shown = result._repr_html_()
    assert len(shown.encode()) < 1e6, len(shown)
    page = page_of(result)
    assert "class Motion" in page and "class Player" in page and result.story.split(".")[0][:20] in html.unescape(page)
    assert not re.search(r"(src|href)=\"(?!data:)", page) and "https://" not in page
    assert 'sandbox="allow-scripts allow-downloads"' in shown


def test_round_ends_are_half_circles():
    plain = {"name": "b", "s": [0, 2], "x": [0, 2], "y": [0, 0], "tx": [1, 1], "ty": [0, 0], "half_depth": [0.1, 0.1]}
    plain |= {"area": [0.02, 0.02], "inertia": [2e-5, 2e-5]}
    flat, = SceneBeam(plain, 0, 0).curves(np.zeros((2, 4)))
    assert len(flat.points) == 9 and (flat.reach == flat.half_depth).all()
    round_end, = SceneBeam({**plain, "roundings": [0, 0.1]}, 0, 0).curves(np.zeros((2, 4)))
    arc = round_end.points[:, 0] > 1.9
    radius = np.hypot(round_end.points[arc, 0] - 1.9, round_end.reach[arc])
    assert arc.sum() > 10 and np.allclose(radius, 0.1, atol=1e-12)
    assert (round_end.half_depth == 0.1).all() and round_end.reach[0] == 0.1


FIELDS = [(0.0, 0.0, 0.25, 0.0), (0.0, 1.0, 0.0625, 0.25), (1.0, 0.0, 0.15625, 0.5625), (1.0, 1.0, 0.0625, 0.25)]


@pytest.mark.parametrize(("bent", "turn", "rise", "slope"), FIELDS)
def test_shear_flexible_beams_are_drawn_by_the_field_inside_their_elements(bent, turn, rise, slope):
    value = {"name": "b", "s": [0, 2], "x": [0, 2], "y": [0, 0], "tx": [1, 1], "ty": [0, 0], "half_depth": [0.1, 0.1]}
    value |= {"area": [0.02, 0.02], "inertia": [2e-5, 2e-5], "shear_flexible": True, "bent": [bent, 0]}
    u = np.array([[0, 0, 0, 0], [0, 1, 0, turn]], float)
    place, tangent = SceneBeam(value, 0, 0).evaluate(0, 0.25, u)
    assert np.allclose(place, [0.5, rise], rtol=0, atol=1e-12) and np.isclose(tangent[1] / tangent[0], slope, rtol=0, atol=1e-12)


def test_names_run_no_script(elastic):
    elastic["title"] = '"></iframe><script>alert(1)</script>'
    shown = percuss.run(elastic)._repr_html_()
    assert "<script" not in shown and shown.count("</iframe>") == 1
    assert "<script>alert" not in page_of(percuss.run(elastic))


def test_a_finished_run_opens_as_it_was(elastic, tmp_path):
    result = percuss.run(elastic, out=tmp_path / "run")
    again = percuss.open(tmp_path / "run")
    assert again.summary == result.summary and again.columns == result.columns
    assert again.units == result.units and again.descriptions == result.descriptions
    assert all(np.array_equal(again[name], result[name]) for name in result.columns)
    for key in ("time", "displacement", "velocity", "section_forces", "load_factors"):
        assert np.array_equal(getattr(again.fields, key), getattr(result.fields, key)), key
    assert again.fields.scene == result.fields.scene and again._repr_html_() == result._repr_html_()
    with pytest.raises(FileNotFoundError, match="no such directory"):
        percuss.open(tmp_path / "elsewhere")
    with pytest.raises(FileNotFoundError, match="summary.json"):
        percuss.open(tmp_path)


def test_the_scene_is_drawn_to_scale(elastic):
    result = percuss.run(elastic)
    ax = result.plot()
    assert ax.get_aspect() == 1.0 and ax.get_xlabel() == "x [m]"
    peak = result.summary["contact"]["mass"]["peak_force"]
    assert ax.get_title().startswith("t = ")
    shown = float(ax.get_title().split()[2]) * {"s": 1.0, "ms": 1e-3}[ax.get_title().split()[3].rstrip(",")]
    assert shown == pytest.approx(peak["time"], rel=1e-2)
    lines = [line.get_xydata() for line in ax.lines]
    assert any(np.allclose(line[0], [0, 0]) and np.allclose(line[-1], [3, 0]) and len(line) > 10 for line in lines)
    # Two clamps: a plate each, through the ends of the beam.
    plates = [line for line in lines if len(line) == 2 and np.ptp(line[:, 0]) < 1e-9 and np.ptp(line[:, 1]) > 0]
    assert {round(float(line[0, 0]), 6) for line in plates} >= {0.0, 3.0}
    plt.close("all")


def test_discs_are_discs():
    result = percuss.run(SCENARIOS / "disc-chain.toml")
    ax = result.plot(t=float(result.time[-1]))
    discs = [b for b in result.fields.scene["bodies"] if b["kind"] == "disc"]
    circles = [patch for patch in ax.patches if isinstance(patch, Circle)]
    for k, disc in enumerate(discs):
        at = np.array(disc["position"]) + result.fields.displacement[-1][result.fields.stations + k, :2]
        own = [c for c in circles if np.allclose(c.center, at, atol=1e-6)]
        assert own and own[0].radius == disc["radius"]
    plt.close("all")


@pytest.mark.parametrize("path", sorted(SCENARIOS.glob("*.toml")), ids=lambda path: path.stem)
def test_every_scene_is_drawn(path):
    result = percuss.run(path, shapes=20)
    ax = result.plot(colour="moment")
    assert ax.lines or ax.patches or ax.collections
    plt.close("all")


def test_colours_stand_for_the_speed_of_the_beam(elastic):
    result = percuss.run(elastic)
    fields, (beam,) = result.fields, result.fields.beams
    frame = len(fields) // 2
    (curve,) = beam.curves(np.zeros((fields.nodes, 4)), pieces=1)
    expected = np.linalg.norm(fields.velocity[frame][beam.first : beam.first + len(beam.s), :2], axis=1)
    assert np.allclose(fields.speed(frame, beam, curve), expected, rtol=1e-6, atol=1e-9) and expected.max() > 0.1
    figure = result.plot(colour="velocity").figure
    assert [ax.get_ylabel() for ax in figure.axes][-1] == "speed [m/s]"
    plt.close("all")


def test_labels_are_words_with_units(elastic):
    result = percuss.run(elastic)
    assert result.plot.force().get_ylabel() == "contact force [N]"
    ax = result.plot.displacement()
    assert ax.get_ylabel() == "displacement [m]" and ax.get_xlabel() == "time [s]"
    assert [t.get_text() for t in ax.get_legend().get_texts()] == ["girder.mid, in y"]
    ax = result.plot.energy()
    assert ax.get_ylabel() == "energy [J]" and "kinetic" in [t.get_text() for t in ax.get_legend().get_texts()]
    ax = result.plot.momentum()
    assert ax.get_ylabel() == "linear momentum [N s]" or "linear momentum [kg m/s]" in ax.get_ylabel()
    plt.close("all")


def test_a_scale_that_would_lie_is_refused():
    with pytest.raises(ValueError, match="ghost"):
        percuss.run(SCENARIOS / "crossing-beams.toml", shapes=20).plot(hide=["beams"])
    with pytest.raises(ValueError, match="overlap"):
        percuss.run(SCENARIOS / "crossing-beams.toml", shapes=20).plot(scale=5.0)


def test_a_result_is_a_table(elastic):
    result = percuss.run(elastic)
    table = result.to_pandas()
    assert list(table.columns) == list(result.columns) and len(table) == len(result)
    assert np.array_equal(table["energy.total"].to_numpy(), result["energy.total"])
    assert table.attrs["units"]["contact.mass.force"] == "N"
    with pytest.raises(TypeError, match="to_pandas"):
        pandas.DataFrame(result)  # else a table of the names
    # A mapping, but no dict: pyarrow would lose the units, IPython would print every number.
    assert isinstance(result, Mapping) and result.__class__ is percuss.Result and not isinstance(result, dict)
    assert pretty(result) == repr(result)


def test_a_data_set_knows_dimensions_and_units(elastic):
    result = percuss.run(elastic)
    data = result.to_xarray()
    assert isinstance(data, xarray.Dataset)
    assert data["contact.mass.force"].dims == ("time",) and data["contact.mass.force"].attrs["units"] == "N"
    assert float(data["contact.mass.force"].sel(time=0.02, method="nearest")) == pytest.approx(
        result["contact.mass.force"][np.abs(result.time - 0.02).argmin()]
    )
    assert data["displacement_2"].dims == ("instant", "station") and data["displacement_2"].attrs["units"] == "m"
    assert data["moment"].dims == ("instant", "interval", "end") and data["moment"].attrs["units"] == "N m"
    middle = np.abs(data["s"].values - 1.5).argmin()
    column = result["point.girder.mid.displacement_2"]
    assert float(data["displacement_2"][-1, middle]) == pytest.approx(column[-1], rel=1e-6)
    assert set(data["beam"].values) == {"girder"} and data["body"].values.tolist() == ["mass"]


def test_frames_are_on_disk_and_in_the_report(elastic, tmp_path):
    percuss.run(elastic, out=tmp_path / "run", report=True)
    assert (tmp_path / "run" / "fields" / "frames.parquet").is_file()
    assert "Summary and animation" in (tmp_path / "run" / "report.html").read_text()


def test_beams_that_can_yield_have_no_colour_of_stress():
    """Stress does not follow from their forces: 797 MPa would be drawn where 547 were reached."""
    result = percuss.run(SCENARIOS / "yielding-beam.toml", time__end="5 ms")
    fields = result.fields
    for beam in fields.beams:
        for curve in beam.curves(fields.displacement[-1]):
            assert np.isnan(fields.stress(len(fields) - 1, beam, curve)).all()
    ax = result.plot(colour="stress")
    assert UNKNOWN in [text.get_text() for text in ax.texts] and len(ax.figure.axes) == 1


def test_stress_that_is_not_known_has_no_scale():
    """A section given by area and inertia has no extreme fibre; nor is a bar of colours from 0 to 1 Pa drawn."""
    ax = percuss.run(SCENARIOS / "paper" / "elastic-clamped.toml", shapes=20).plot(colour="stress")
    assert UNKNOWN in [text.get_text() for text in ax.texts]
    assert len(ax.figure.axes) == 1
