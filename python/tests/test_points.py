"""Points chosen elsewhere: arrays, tables and files of them, on all cores, and kept."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import percuss

POINTS = np.array([[12.0, 400.0], [20.0, 500.0], [28.0, 650.0]])


@pytest.fixture
def two(study) -> dict:
    """A study of speed and mass."""
    study["parameters"]["mass"] = {"path": "projectile.mass.mass", "range": {"from": 300, "to": "700 kg"}}
    study["design"] = {"kind": "sobol", "runs": 16}
    return study


def without_design(two: dict) -> dict:
    return {key: value for key, value in two.items() if key != "design"}


def test_a_sweep_at_points_gives_what_the_function_gives(two):
    table, y = percuss.sweep(two, points=POINTS), percuss.function(two)(POINTS)
    assert np.array_equal(table["speed"], POINTS[:, 0]) and np.array_equal(table["mass"], POINTS[:, 1])
    assert np.array_equal(np.column_stack([table["peak_force"], table["exit"]]), y)
    assert np.array_equal(percuss.sweep(**without_design(two), points=POINTS.tolist())["exit"], table["exit"])
    study = percuss.Study(table.study.text, "again")
    assert np.array_equal(percuss.sweep(study, points=POINTS[:1])["exit"], table["exit"][:1])


def test_columns_of_a_table_go_by_name_or_path_whatever_their_order(two):
    pandas = pytest.importorskip("pandas")
    wanted = percuss.sweep(two, points=POINTS)["peak_force"]
    swapped = {"mass": POINTS[:, 1], "projectile.mass.velocity[1]": POINTS[:, 0]}
    for points in (swapped, pandas.DataFrame(swapped)):
        table = percuss.sweep(two, points=points)
        assert table.names("input") == ("speed", "mass") and np.array_equal(table["peak_force"], wanted)
    structured = np.array([tuple(row) for row in POINTS[:, ::-1]], dtype=[("mass", float), ("speed", float)])
    assert np.array_equal(percuss.sweep(two, points=structured)["peak_force"], wanted)


def test_points_of_a_sweep_have_the_forms_of_those_of_a_function(two):
    pandas = pytest.importorskip("pandas")
    wanted, f = percuss.sweep(two, points=POINTS[:1])["exit"], percuss.function(two)
    for points in (pandas.DataFrame(POINTS[:1]), {"mass": POINTS[0, 1], "speed": POINTS[0, 0]}):
        assert np.array_equal(percuss.sweep(two, points=points)["exit"], wanted)
        assert np.array_equal(np.atleast_2d(f(points))[:, 1], wanted)


def test_a_path_makes_a_parameter(two):
    alone = {key: two[key] for key in ("scenario", "results")}
    table = percuss.sweep(**alone, points={"projectile.mass.velocity[1]": [12, 20.0]})
    assert table["projectile_mass_velocity_1"].tolist() == [12.0, 20.0]
    words = percuss.sweep(**alone, points={"integrator.scheme": ["energy-momentum", "midpoint"]})
    assert words["integrator_scheme"].tolist() == ["energy-momentum", "midpoint"]


@pytest.mark.parametrize(
    "points, message",
    [
        ([[1.0, 2.0, 3.0]], r"shape \(1, 3\), expected \(n_point, 2\).*speed, mass"),
        ([1.0, 2.0], r"shape \(2,\)"),
        ({"speed": [1.0]}, "no column for mass"),
        ({"speed": [1.0], "mass": [1.0], "wind": [1.0]}, "'wind' is no parameter"),
        ({"speed": [1.0], "mass": [1.0], "projectile.mass.mass": [1.0]}, "second column"),
        ({"speed": [1.0, 2.0], "mass": [1.0]}, "columns of 1 and 2 rows"),
        (np.zeros((0, 2)), "points: none"),
    ],
)
def test_points_that_do_not_fit_are_refused(two, points, message):
    with pytest.raises(ValueError, match=message):
        percuss.sweep(two, points=points)


def test_points_and_a_design_or_a_text_are_one_too_many(two):
    with pytest.raises(TypeError, match="correlations and points"):
        percuss.sweep(**without_design(two), points=POINTS, correlations=[])
    with pytest.raises(TypeError, match="design and points"):
        percuss.sweep(**two, points=POINTS)
    with pytest.raises(TypeError, match="points is a text"):
        percuss.sweep(two, points="points.csv")


def test_a_point_that_cannot_be_is_a_row(two):
    points = np.vstack([POINTS, [20.0, -1.0], [np.nan, 500.0]])
    table = percuss.sweep(two, points=points)
    assert table["status"].tolist() == ["completed"] * 3 + ["invalid"] * 2
    assert np.isnan(table["peak_force"][3:]).all() and "[E319]" in table["reason"][4]
    f = percuss.function(two, failed="nan", jobs=2)
    assert np.array_equal(np.isnan(f(points)[:, 0]), [False, False, False, True, True])
    for jobs in (1, 2):
        with pytest.raises(percuss.PercussError, match=r"point 3 \(and 1 more\): projectile.mass.mass") as caught:
            percuss.function(two, jobs=jobs)(points)
        assert caught.value.code == "E016"


def test_a_function_gives_the_same_on_threads_executors_and_kept(two, tmp_path):
    wanted = percuss.function(two)(POINTS)
    assert np.array_equal(percuss.function(two, jobs=2)(POINTS), wanted)
    with ThreadPoolExecutor(2) as pool:
        assert np.array_equal(percuss.function(two, executor=pool)(POINTS), wanted)
    kept = percuss.function(two, out=tmp_path / "kept")
    assert np.array_equal(kept(POINTS), wanted) and np.array_equal(kept(POINTS[0]), wanted[0])
    assert len(list((tmp_path / "kept").iterdir())) == 2, "each call has a directory of its own"


def test_a_call_with_the_same_points_goes_on_from_what_is_kept(two, tmp_path):
    first = percuss.function(two, out=tmp_path)(POINTS)
    (own,) = tmp_path.iterdir()
    shards = {path: path.stat().st_mtime_ns for path in (own / "shards").iterdir()}
    (own / "results.parquet").unlink()
    assert np.array_equal(percuss.function(two, out=tmp_path)(POINTS), first)
    assert shards == {path: path.stat().st_mtime_ns for path in (own / "shards").iterdir()}


def test_lengths_along_a_beam_stay_lengths(two):
    place = {"path": "projectile.mass.strikes", "range": {"from": "0.5 m", "to": "2 m"}}
    two["parameters"] = {"place": place}
    points = [[0.6], [0.9]]
    assert np.array_equal(percuss.function(two)(points), percuss.function(two, jobs=2)(points))


def test_a_file_of_points_is_a_design(two, tmp_path):
    csv = "speed [km/h],projectile.mass.mass\n36,500\n72,500\n"
    (tmp_path / "points.csv").write_text(csv)
    (tmp_path / "base.toml").write_text(two["scenario"].text)
    path = tmp_path / "study.toml"
    path.write_text(
        'base = "base.toml"\n[parameter.speed]\npath = "projectile.mass.velocity[1]"\n'
        '[design]\nkind = "points"\nfile = "points.csv"\n[results]\npeak = "contact.mass.peak_force.value"\n'
    )
    table = percuss.sweep(path)
    assert table["speed"] == pytest.approx([10, 20]) and table["projectile_mass_mass"].tolist() == [500, 500]
    assert percuss.function(two)([10, 500])[0] == pytest.approx(table["peak"][0], rel=1e-12)
