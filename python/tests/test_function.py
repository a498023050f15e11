"""Studies as functions, for other packages and over HTTP; the command that the wheel brings along."""

import json
import os
import signal
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import percuss
import pytest

from conftest import SCENARIOS

STUDIES = SCENARIOS / "studies"
COMMAND = Path(sys.executable).with_name("percuss")


@pytest.fixture
def two(study) -> dict:
    """A study of speed and mass."""
    study["parameters"]["mass"] = {"path": "projectile.mass.mass", "range": {"from": 300, "to": "700 kg"}}
    study["design"] = {"kind": "sobol", "runs": 16}
    return study


def test_a_function_gives_what_a_sweep_gives(two):
    f, table = percuss.function(two), percuss.sweep(two)
    assert f.names == ("speed", "mass") and f.results == ("peak_force", "exit")
    assert f.bounds == [(10.0, 30.0), (300.0, 700.0)] and f.middle.tolist() == [20.0, 500.0]
    assert f.units == {"speed": "m/s", "mass": "kg", "peak_force": "N", "exit": "m/s"}
    y = f(np.column_stack([table["speed"], table["mass"]]))
    assert y.shape == (16, 2)
    assert np.array_equal(y[:, 0], table["peak_force"]) and np.array_equal(y[:, 1], table["exit"])
    assert np.array_equal(f([20, 500]), table.study.function()([[20, 500]])[0])
    assert repr(f) == "<percuss.Function (speed, mass) -> (peak_force, exit)>"


def test_a_jacobian_is_what_differences_tend_to(two):
    f = percuss.function(two)
    x, jacobian = f.middle, f.jacobian(f.middle)
    for k in range(2):
        h = np.eye(2)[k] * 1e-4 * x[k]
        assert (f(x + h) - f(x - h)) / (2 * h[k]) == pytest.approx(jacobian[:, k], rel=1e-4)


def test_columns_are_matched_by_their_names_or_refused():
    """A table whose columns stand in another order was taken by position: 1.858 MN for 0.338 MN."""
    pandas = pytest.importorskip("pandas")
    f = percuss.function(STUDIES / "speed-and-mass.toml")
    right, wrong = f([20, 500, 2e9]), f([500, 20, 2e9])
    assert right[0] == pytest.approx(0.338e6, abs=500) and wrong[0] == pytest.approx(1.858e6, abs=500)
    table = pandas.DataFrame({"mass": [500.0, 400.0], "young": 2e9, "speed": [20.0, 25.0]})
    many = f([[20, 500, 2e9], [25, 400, 2e9]])
    assert np.array_equal(f(table), many) and np.array_equal(f(table.iloc[0]), right)
    assert np.array_equal(f(table.to_records(index=False)), many)
    assert np.array_equal(f({"young": 2e9, "mass": [500, 400], "speed": [20, 25]}), many)
    assert np.array_equal(f(pandas.DataFrame([[20, 500, 2e9]])), [right])  # columns without names
    assert np.array_equal(f.jacobian({"young": 2e9, "mass": 500, "speed": 20}), f.jacobian([20, 500, 2e9]))
    for names, message in (
        ({"mass": "mas"}, "`mas` is no parameter of the study, expected one of .*did you mean `mass`"),
        ({"mass": "peak_force"}, "`peak_force` is no parameter"),
    ):
        with pytest.raises(percuss.InputError, match=message):
            f(table.rename(columns=names))
    with pytest.raises(percuss.InputError, match="no value for `mass`"):
        f(table.drop(columns="mass"))


def test_distributions_reach_salib():
    """Uniform samples between the bounds share out the variance otherwise: .587 for .792, of the speed."""
    sobol_sample = pytest.importorskip("SALib.sample.sobol")
    from SALib.analyze import sobol

    f = percuss.function(STUDIES / "speed-and-mass.toml")
    with pytest.raises(percuss.InputError, match="truncated-lognormal"):
        f.problem
    u = sobol_sample.sample(f.unit_problem, 256, calc_second_order=False, seed=5)
    of_speed = lambda points: sobol.analyze(f.unit_problem, f(points)[:, 0], calc_second_order=False, seed=3)["S1"][0]  # noqa: E731
    low, high = np.array(f.bounds).T
    # 256 points know an index to some two hundredths.
    assert of_speed(f.at(u)) == pytest.approx(0.792, abs=0.05)
    assert of_speed(low + (high - low) * u) == pytest.approx(0.587, abs=0.05)


def test_a_problem_of_salib_has_the_distributions_of_the_study(two):
    salib = pytest.importorskip("SALib.sample.sobol")
    two["parameters"]["mass"] = {"path": "projectile.mass.mass", "distribution": {"kind": "normal", "mean": 500, "deviation": 20}}
    two["parameters"]["stiff"] = {"path": "projectile.mass.stiffness", "range": {"from": 1e5, "to": 1e6, "spacing": "log"}}
    f = percuss.function(two)
    assert f.problem["dists"] == ["unif", "norm", "logunif"]
    shares = salib.sample(f.unit_problem, 64, seed=5)
    # Quantiles are inverses of shares to some ten digits.
    assert salib.sample(f.problem, 64, seed=5) == pytest.approx(f.at(shares), rel=1e-8)
    assert f.at([0.5, 0.5, 0.5]) == pytest.approx(f.middle)
    with pytest.raises(percuss.InputError, match="a share from 0 to 1"):
        f.at([0.5, 0.5, 1.5])


def test_distributions_and_correlations_reach_openturns(two):
    openturns = pytest.importorskip("openturns")
    two["parameters"]["mass"] = {
        "path": "projectile.mass.mass",
        "distribution": {"kind": "lognormal", "mean": 500, "deviation": 100, "truncated": [250, 900]},
    }
    two["correlations"] = [{"between": ["speed", "mass"], "coefficient": 0.6}]
    f = percuss.function(two)
    with pytest.raises(percuss.InputError, match="correlated"):
        f.problem
    joint = f.distribution()
    assert list(joint.getDescription()) == ["speed", "mass"]
    for share in (0.01, 0.5, 0.9):
        point = [joint.getMarginal(k).computeQuantile(share)[0] for k in range(2)]
        assert point[0] == pytest.approx(10 + 20 * share)
    # The copula: the conditional median of the mass at a speed of given share, in both packages.
    score = float(openturns.Normal().computeQuantile(0.9)[0])
    expected = joint.getMarginal(1).computeQuantile(float(openturns.Normal().computeCDF(0.6 * score)))[0]
    assert f.at([0.9, 0.5])[1] == pytest.approx(expected, rel=1e-6)
    openturns.RandomGenerator.SetSeed(2)
    sample = joint.getSample(4)
    assert np.array_equal(f(sample), f(np.array(sample)))
    sample.setDescription(["mass", "speed"])
    assert np.array_equal(f._points(sample), np.array(sample)[:, ::-1])


def test_points_without_a_value_are_errors_or_nan(two):
    f = percuss.function(two)
    with pytest.raises(ValueError, match=r"2 numbers a point \(speed, mass\)"):
        f([1, 2, 3])
    with pytest.raises(percuss.PercussError, match="point 1: projectile.mass.mass") as caught:
        f([[20, 500], [20, -1]])
    assert caught.value.code == "E016"
    with pytest.raises(percuss.PercussError, match="a number is needed"):
        f([20, np.nan])
    y = percuss.function(two, failed="nan")([[20, 500], [20, -1]])
    assert np.isfinite(y[0]).all() and np.isnan(y[1]).all()
    words = {**two, "design": {"kind": "grid"}, "parameters": {"law": {"path": "projectile.mass.kind", "values": ["elastic"]}}}
    with pytest.raises(percuss.InputError) as caught:
        percuss.function(words)
    assert caught.value.code == "E318"


def test_openturns_takes_values_and_gradients(two):
    openturns = pytest.importorskip("openturns")
    f = percuss.function(two)
    g = percuss.openturns(f)
    assert list(g.getInputDescription()) == ["speed", "mass"] and list(g.getOutputDescription()) == ["peak_force", "exit"]
    assert np.array(g([20, 500])) == pytest.approx(f([20, 500]), rel=1e-15)
    assert np.array(g(openturns.Sample([[20, 500], [25, 400]]))) == pytest.approx(f([[20, 500], [25, 400]]), rel=1e-15)
    # OpenTURNS keeps a column for each output.
    assert np.array(g.gradient([20, 500])).T == pytest.approx(f.jacobian([20, 500]), rel=1e-15)


def test_salib_finds_the_indices_that_a_study_finds(two):
    """Peak force of a linear contact is proportional to the speed: its share of the variance is that of the speed alone."""
    sobol_sample = pytest.importorskip("SALib.sample.sobol")
    from SALib.analyze import sobol

    f = percuss.function(two)
    points = sobol_sample.sample(f.problem, 256, seed=1)
    found = sobol.analyze(f.problem, f(points)[:, 0], seed=1)
    own = {**two, "design": {"kind": "sobol", "runs": 256, "sobol_indices": True}}
    table = percuss.sweep(own)
    assert len(table) == 256 * 4
    speed = found["S1"][0]
    # Variance of a product of independent factors, from their means and variances: F = v g(m).
    v, m = np.linspace(10, 30, 4001), np.linspace(300, 700, 401)
    g = f(np.column_stack([np.full_like(m, 20.0), m]))[:, 0]
    trapezoid = lambda y, x: float(((y[1:] + y[:-1]) / 2 * np.diff(x)).sum())  # noqa: E731
    mean = lambda y, x: trapezoid(y, x) / (x[-1] - x[0])  # noqa: E731
    var = lambda y, x: mean(y**2, x) - mean(y, x) ** 2  # noqa: E731
    total = mean(v**2, v) * mean(g**2, m) - (mean(v, v) * mean(g, m)) ** 2
    assert speed == pytest.approx(var(v, v) * mean(g, m) ** 2 / total, abs=0.03)


def file_of(study: dict, path: Path) -> Path:
    path.write_text(percuss.sweep(study).study.text, encoding="utf-8")
    return path


def test_um_bridge_evaluates_a_served_study(two, tmp_path):
    umbridge = pytest.importorskip("umbridge")
    f, file = percuss.function(two), file_of(two, tmp_path / "two.toml")
    server = subprocess.Popen([COMMAND, "serve", file, "--port", "0"], stderr=subprocess.PIPE, text=True)
    try:
        address = next(word for word in server.stderr.readline().split() if word.startswith("http"))
        model = umbridge.HTTPModel(address, "forward")
        assert model.get_input_sizes() == [2] and model.get_output_sizes() == [2]
        assert model.supports_evaluate() and model.supports_gradient() and model.supports_apply_jacobian()
        assert not model.supports_apply_hessian()
        x = [20.0, 500.0]
        jacobian = f.jacobian(x)
        assert model([x])[0] == pytest.approx(f(x), rel=1e-14)
        assert model.gradient(0, 0, [x], [2.0, -1.0]) == pytest.approx([2.0, -1.0] @ jacobian, rel=1e-14)
        assert model.apply_jacobian(0, 0, [x], [1.0, 3.0]) == pytest.approx(jacobian @ [1.0, 3.0], rel=1e-14)
        with pytest.raises(Exception, match="2 numbers"):
            model([[1.0]])
        with pytest.raises(Exception, match="a mass above zero"):
            model([[20.0, -500.0]])
    finally:
        server.send_signal(signal.SIGINT)
        assert server.wait(20) == 130


def test_the_wheel_brings_the_command(two, tmp_path):
    run = lambda *arguments, **more: subprocess.run([COMMAND, *arguments], capture_output=True, text=True, **more)  # noqa: E731
    assert run("--version").stdout == f"percuss {percuss.__version__}\n"
    assert run("run", "nothing.toml").returncode == 2
    file = file_of(two, tmp_path / "two.toml")
    done = run("eval", file, "-", "--gradients", input='{"speed": 20, "mass": 500}')
    assert done.returncode == 0, done.stderr
    answer, f = json.loads(done.stdout), percuss.function(two)
    assert list(answer["results"].values()) == pytest.approx(f([20, 500]), rel=1e-12)
    assert answer["derivatives"]["exit"]["mass"] == pytest.approx(f.jacobian([20, 500])[1, 1], rel=1e-12)


def test_the_command_of_the_wheel_finds_the_book_of_the_wheel(tmp_path):
    page = tmp_path / "book" / "index.html"
    page.parent.mkdir()
    page.write_text("<title>Percuss</title>")
    line = (
        "import sys; from percuss import _command; "
        f"_command.__file__ = {str(tmp_path / '_command.py')!r}; sys.argv = ['percuss', 'book', '--path']; sys.exit(_command.main())"
    )
    bare = {key: value for key, value in os.environ.items() if key != "PERCUSS_BOOK"}
    done = subprocess.run([sys.executable, "-c", line], capture_output=True, text=True, env=bare)
    assert (done.returncode, done.stdout) == (0, f"{page.resolve()}\n"), done.stderr


def test_ctrl_c_ends_the_command_of_the_wheel(elastic, tmp_path):
    elastic["time.end"] = "60 s"
    elastic.save(tmp_path / "long.toml")
    running = subprocess.Popen([COMMAND, "run", "long.toml", "--quiet"], cwd=tmp_path, stderr=subprocess.PIPE)
    for _ in range(600):  # until the solver is at work, and not the interpreter
        if any(tmp_path.glob("runs/*")) or any(tmp_path.glob("runs/.*")):
            break
        time.sleep(0.1)
    time.sleep(0.5)
    running.send_signal(signal.SIGINT)
    assert running.wait(30) == 130
    assert b"Traceback" not in running.stderr.read()
    assert (tmp_path / "runs" / "long" / "summary.json").exists()


def test_columns_are_results_with_derivatives(study):
    study["results"] = {
        "force": {"column": "contact.mass.force", "at": ["5 ms", "7.5 ms"]},
        "rise": {"column": "point.girder.mid.displacement_2", "max": [0, "20 ms"]},
    }
    f = percuss.function(study)
    assert f.results == ("force[0]", "force[1]", "rise") and f.means is None
    x = f.middle
    values, jacobian = f(x), f.jacobian(x)
    assert f.means == "exact"
    for k in range(len(x)):
        h = np.zeros_like(x)
        h[k] = 1e-5 * x[k]
        difference = (f(x + h) - f(x - h)) / (2 * h[k])
        assert difference == pytest.approx(jacobian[:, k], rel=1e-4, abs=1e-5 * np.abs(values / x[k]).max())


def test_derivatives_that_are_not_exact_are_differences_and_say_so(study):
    study["results"] = {"moment": {"column": "section.girder.mid.moment", "at": "30 ms"}}
    f = percuss.function(study)
    jacobian = f.jacobian(f.middle)
    assert f.means.startswith("differences: ") and "section.girder.mid.moment" in f.means
    assert np.isfinite(jacobian).all() and jacobian.any()


#: A ball of 0.5 kg on a linear contact of 1 MN/m: it leaves after pi sqrt(m/k) = 2.22 ms at the speed at which it came.
BALL = """
[projectile.ball]
kind = "elastic"
contact = "surface"
mass = 0.5
velocity = [0, -2]
stiffness = 1e6
position = [0, 0]
strikes = "floor"
[obstacle.floor]
kind = "half-plane"
point = [0, 0]
normal = [0, 1]
[time]
end = "3 ms"
step = "4 us"
"""


def test_results_of_a_contact_that_is_still_closed_are_said_not_to_be_final():
    """The command and `percuss sweep` say so, and neither function, sweep nor run may be silent about it."""
    results = {"peak": "contact.ball.peak_force.value", "out": "projectile.ball.velocity_final[1]"}
    parameters = {"end": {"path": "time.end", "values": [5e-4, 3e-3]}}
    study = {"scenario": percuss.Scenario.from_toml(BALL), "parameters": parameters, "design": {"kind": "grid"}, "results": results}
    f = percuss.function(study)
    with pytest.warns(percuss.PercussWarning, match="`peak`, `out` are not final.*W016"):
        f([5e-4])
    with pytest.warns(percuss.PercussWarning, match="W016"):
        table = percuss.sweep(study)
    assert table.not_final == {"peak": 1, "out": 1} and "not final in some: peak, out" in repr(table)
    with pytest.warns(percuss.PercussWarning, match="W016"):
        percuss.run(percuss.Scenario.from_toml(BALL), time__end=5e-4)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        values = f([3e-3])
    assert values == pytest.approx([2 * np.sqrt(0.5e6), 2], rel=1e-3)
