"""Parameters from measured curves."""

from __future__ import annotations

import json
import threading
import time
import warnings

import numpy as np
import pytest
from conftest import SCENARIOS

import percuss
from percuss._least_squares import side_by_side

FITS = SCENARIOS / "fits"
TRUTH = {"stiffness": 2e6, "dissipation": 0.2, "yield": 120e6}
PARAMETERS = {
    "stiffness": {"path": "projectile.hammer.stiffness", "bounds": ("0.5 MN/m", "5 MN/m"), "spacing": "log"},
    "dissipation": {"path": "projectile.hammer.dissipation", "bounds": (0, "1 s/m")},
    "yield": {"path": "material.aluminium.yield", "bounds": ("80 MPa", "200 MPa")},
}
CHANNELS = {"F": "contact.hammer.force", "u": "point.bar.mid.displacement_2"}
SIGMA = {"F": "40 N", "u": "20 um"}


def drop(**options) -> percuss.Measured:
    return percuss.Measured(FITS / "hammer-6.csv", CHANNELS, time="t", sigma=SIGMA, **options)


@pytest.fixture(scope="module")
def found() -> percuss.Fit:
    pytest.importorskip("scipy")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", percuss.PercussWarning)
        return percuss.fit(FITS / "hammer.toml", PARAMETERS, drop(), align="fit")


def test_stiffness_damping_yield_stress_and_offset_are_found_within_their_intervals(found):
    assert found.success and found.names == ["stiffness", "dissipation", "yield", "test.offset"]
    for name, truth in {**TRUTH, "test.offset": 0.5e-3}.items():
        low, high = found.params[name].interval
        # One record: with a wider interval than that of 95 % this holds but for one in ten thousand.
        middle, reach = (low + high) / 2, high - low
        assert abs(truth - middle) < reach, name
    assert 0.7 < found.redchi < 1.4
    assert found.x.shape == found.stderr.shape == (4,)
    assert np.allclose(np.sqrt(np.diag(found.cov)), found.stderr)
    assert np.allclose(np.diag(found.correl), 1)
    assert found.jac.shape == (found.fun.size, 4)
    assert np.allclose(np.linalg.inv(found.jac.T @ found.jac), found.cov, rtol=1e-3)
    assert found.cost == pytest.approx(0.5 * (found.fun**2).sum(), rel=1e-6)


def test_both_optimisers_find_the_same_minimum(found):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", percuss.PercussWarning)
        other = percuss.fit(FITS / "hammer.toml", PARAMETERS, drop(), align="fit", solver="basin")
    # Both end at relative changes of 1e-8 of the cost; that is 1e-2 of a standard error.
    assert np.all(np.abs(other.x - found.x) < 0.05 * found.stderr)


def test_the_scenario_found_runs_to_the_curves_of_the_fit(found):
    run = percuss.run(found.to_scenario())
    assert found.to_scenario()["projectile.hammer.stiffness"] == pytest.approx(found.params["stiffness"].value)
    force = run["contact.hammer.force"].max()
    assert force == pytest.approx(percuss.run(found.to_scenario("test"))["contact.hammer.force"].max())
    assert found.channels[0]["rms"] < 60  # N, with noise of 40 N


def test_files_and_figures(found, tmp_path):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    place = found.save(tmp_path / "fit")
    names = sorted(path.name for path in (tmp_path / "fit").iterdir() if not path.name.startswith("."))
    assert names == ["curves.csv", "fit.html", "fit.json", "fit.txt", "fitted.toml"], place
    value = json.loads((tmp_path / "fit" / "fit.json").read_text())
    assert [one["value"] for one in value["parameters"]] == found.x.tolist()
    axes = found.plot()
    assert len(axes) == len(found.plot("test", ax=axes)) == 4
    with pytest.raises(ValueError, match="found 3, expected two for each of 2 channels"):
        found.plot(ax=axes[:3])
    pyplot.close("all")
    assert "[parameters]" in found.report() and "stiffness" in found._repr_html_()
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("precious")
    with pytest.raises(percuss.InputError, match="E203"):
        found.save(tmp_path / "mine")


def test_an_unknown_test_is_refused(found):
    for ask in (found.plot, found.to_scenario):
        with pytest.raises(KeyError, match="'tset' is no test; did you mean 'test'"):
            ask("tset")


def test_a_test_kept_out_is_predicted():
    slow = percuss.Measured(
        FITS / "hammer-5.csv",
        CHANNELS,
        time="t",
        sigma=SIGMA,
        name="slow",
        set={"projectile.hammer.velocity": [0, -5]},
        hold_out=True,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", percuss.PercussWarning)
        both = percuss.fit(
            FITS / "hammer.toml", PARAMETERS, [drop(name="fast"), slow], align="fit", solver="basin", jobs=2
        )
    kept = [one for one in both.channels if one["hold_out"]]
    assert [one["test"] for one in kept] == ["slow", "slow"]
    # Its offset comes from its onset, to a part of a sample.
    assert all(one["r_squared"] > 0.99 for one in kept)
    assert both.to_scenario("slow")["projectile.hammer.velocity"][1] == -5


def test_a_profile_agrees_with_the_standard_error(found):
    profile = found.profile("stiffness", points=3)
    assert profile.values.shape == profile.costs.shape == (7,)
    assert np.nanmin(profile.costs) >= found.cost - 1e-3
    low, high = found.params["stiffness"].interval
    assert profile.interval == pytest.approx((low, high), abs=0.2 * (high - low))
    with pytest.raises(KeyError, match="did you mean 'stiffness'"):
        found.profile("stifness")
    with pytest.raises(ValueError, match="points=0"):
        found.profile("stiffness", points=0)


def computed(**options) -> percuss.Measured:
    """A record without noise."""
    run = percuss.run(FITS / "hammer.toml")
    record = {"t [s]": run.time, "F [N]": run["contact.hammer.force"]}
    return percuss.Measured(record, {"F": "contact.hammer.force"}, time="t", **options)


@pytest.mark.filterwarnings("ignore::percuss.PercussWarning")
@pytest.mark.parametrize("solver", ["scipy", "basin"])
def test_the_result_does_not_depend_on_the_number_of_threads(solver):
    if solver == "scipy":
        pytest.importorskip("scipy")
    data = computed(sigma="10 N")
    fits = [
        percuss.fit(FITS / "hammer.toml", {"stiffness": PARAMETERS["stiffness"]}, data, starts=3, seed=7, solver=solver, jobs=jobs)
        for jobs in (1, 2, -1)
    ]
    for other in fits[1:]:
        assert other.report() == fits[0].report()
        for one, same in zip(fits[0].starts, other.starts, strict=True):
            assert one.pop("x").tolist() == same.pop("x").tolist() and one == same


def test_work_side_by_side_keeps_its_order_and_its_number_of_threads():
    lock, at_work, most = threading.Lock(), 0, 0

    def work(item: int) -> int:
        nonlocal at_work, most
        with lock:
            at_work += 1
            most = max(most, at_work)
        time.sleep(0.002 * (5 - item))
        with lock:
            at_work -= 1
        return item * item

    for threads in (1, 2, 9):
        most = 0
        assert side_by_side(work, range(5), threads, lambda: None) == [0, 1, 4, 9, 16]
        assert 1 <= most <= threads


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt])
def test_an_exception_of_one_ends_all(error):
    stopped, begun = threading.Event(), []

    def work(item: int) -> None:
        begun.append(item)
        if item == 1:
            raise error("the second one")
        # Ends when it is asked to, as a run does.
        assert stopped.wait(60)
        raise KeyboardInterrupt

    with pytest.raises(error, match="the second one"):
        side_by_side(work, range(50), 2, stopped.set)
    assert stopped.is_set() and len(begun) < 50


def test_standard_deviations_are_known_in_all_records_or_in_none():
    force = {"k": "projectile.hammer.stiffness"}
    some = percuss.Measured(FITS / "hammer-6.csv", CHANNELS, time="t", sigma={"F": "40 N"})
    with pytest.raises(percuss.ScenarioError, match=r"test\.test\.channel\.u\.sigma.*every channel of all tests, or for none"):
        percuss.fit(FITS / "hammer.toml", force, some, solver="basin")
    with pytest.raises(percuss.ScenarioError, match=r"test\.test2\.channel\.F\.sigma.*every channel of all tests, or for none"):
        percuss.fit(FITS / "hammer.toml", force, [computed(sigma="10 N"), computed()], solver="basin")


def test_columns_of_a_record_have_a_finite_number_a_row():
    for force, message in (([0, float("nan"), 1, 0], "NaN in row 2 of `F`"), ([0, 1, 0], "3 values of `F` beside 4 times")):
        data = percuss.Measured({"t": [0, 1e-3, 2e-3, 3e-3], "F": force}, {"F": "contact.hammer.force"}, time="t")
        with pytest.raises(percuss.ScenarioError, match=message):
            percuss.fit(FITS / "hammer.toml", {"k": "projectile.hammer.stiffness"}, data, solver="basin")


@pytest.mark.filterwarnings("ignore::percuss.PercussWarning")
def test_a_starting_point_without_a_run_leaves_the_others():
    for solver in ("basin", "scipy"):
        if solver == "scipy":
            pytest.importorskip("scipy")
        # Stiffnesses below zero are refused.
        stiffness = {"path": "projectile.hammer.stiffness", "bounds": (-5e6, 5e6)}
        found = percuss.fit(FITS / "hammer.toml", {"k": stiffness}, computed(sigma="10 N"), starts=6, solver=solver)
        failed = [start for start in found.starts if np.isnan(start["cost"])]
        assert 0 < len(failed) < 6 and not any(start["success"] for start in failed)
        assert all("expected a stiffness above zero" in start["message"] for start in failed)
        assert found.success and found.x == pytest.approx([1.5e6], rel=1e-4)


def test_records_of_a_fit_have_names_of_their_own():
    table = np.zeros(3, dtype=[("t", float), ("F", float)])
    with pytest.raises(percuss.InputError, match="two records are named 'drop'"):
        percuss.fit(FITS / "hammer.toml", {"k": "projectile.hammer.stiffness"}, [drop(name="drop"), drop(name="drop")])
    assert repr(percuss.Measured(table, {"F": "contact.hammer.force"}, time="t")) == "<percuss.Measured: contact.hammer.force from F>"
    with pytest.raises(TypeError, match="columns by their headers"):
        percuss.Measured([1.0, 2.0], {"F": "contact.hammer.force"})
    with pytest.raises(ValueError, match=r"F: found an array of shape \(1, 2\)"):
        percuss.Measured({"F": [[1.0, 2.0]]}, {"F": "contact.hammer.force"})


@pytest.mark.filterwarnings("ignore::percuss.PercussWarning")
def test_parameters_whose_names_differ_in_signs_only_are_two():
    parameters = {
        "projectile.hammer.stiffness": {"start": "1.9 MN/m"},
        "projectile_hammer_stiffness": {"path": "projectile.hammer.mass", "fixed": True},
    }
    found = percuss.fit(FITS / "hammer.toml", parameters, computed(sigma="10 N"), solver="basin")
    assert set(found.params) == set(parameters) and found.names == ["projectile.hammer.stiffness"]


def test_columns_of_programs_serve_as_records_and_doubts_are_warnings():
    run = percuss.run(FITS / "hammer.toml")
    record = {"t [s]": run.time, "F [kN]": 1e-3 * run["contact.hammer.force"] + np.where(run.time > 3e-3, 0.5, 0.0)}
    data = percuss.Measured(record, {"F": "contact.hammer.force"}, time="t", sigma="10 N")
    with pytest.warns(percuss.PercussWarning, match="W119"):
        found = percuss.fit(FITS / "hammer.toml", {"projectile.hammer.stiffness": {"start": 1.6e6}}, data, solver="basin")
    assert found.names == ["projectile.hammer.stiffness"]
    assert "residuals" in [kind for kind, _ in found.warnings]


@pytest.mark.parametrize(
    ("parameters", "options", "error", "text"),
    [
        ({"k": "projectile.hammer.stifness"}, {}, percuss.ScenarioError, "stifness"),
        ({"k": {"path": "projectile.hammer.stiffness", "bound": (1, 2)}}, {}, TypeError, "did you mean 'bounds'"),
        ({"k": "projectile.hammer.stiffness"}, {"starts": 3}, percuss.ScenarioError, "no bounds with 3 starting points"),
        ({"k": "projectile.hammer.stiffness"}, {"align": "fitted"}, percuss.InputError, "did you mean 'fit'"),
        ({"k": "projectile.hammer.stiffness"}, {"jobs": 2.0}, TypeError, "-1 for one a core"),
        ({"k": {"path": "projectile.hammer.stiffness", "bounds": "1 MN/m"}}, {}, TypeError, "expected a pair"),
        (["projectile.hammer.stiffness"], {}, TypeError, "tables by names"),
        ({"k": "projectile.hammer.stiffness"}, {"loss": "cubic"}, percuss.ScenarioError, "soft_l1"),
    ],
)
def test_wrong_input_says_what_would_be_right(parameters, options, error, text):
    with pytest.raises(error, match=text):
        percuss.fit(FITS / "hammer.toml", parameters, drop(), solver="basin", **options)


def test_a_channel_that_the_record_lacks_is_named():
    with pytest.raises(percuss.ScenarioError, match="no column of the record"):
        percuss.fit(
            FITS / "hammer.toml",
            {"k": "projectile.hammer.stiffness"},
            percuss.Measured(FITS / "hammer-6.csv", {"G": "contact.hammer.force"}, time="t"),
            solver="basin",
        )
    with pytest.raises(KeyError, match="sigma: 'G' is no channel"):
        percuss.fit(
            FITS / "hammer.toml",
            {"k": "projectile.hammer.stiffness"},
            percuss.Measured(FITS / "hammer-6.csv", {"F": "contact.hammer.force"}, time="t", sigma={"G": 1}),
            solver="basin",
        )
