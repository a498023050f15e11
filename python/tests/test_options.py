"""Options of functions: by keyword, of the right kind, or refused with what would be right."""

import inspect

import percuss
import pytest

POSITIONAL = {
    "run": 1, "converge": 2, "sensitivity": 3, "modes": 2, "static": 1, "check": 1, "load": 1, "sweep": 1, "function": 1, "openturns": 1, "fit": 3,
}  # fmt: skip
"""Arguments that have a place: what is computed, and of what."""


def test_options_are_given_by_keyword():
    for name, count in POSITIONAL.items():
        kinds = [p.kind for p in inspect.signature(getattr(percuss, name)).parameters.values()]
        assert kinds.count(inspect.Parameter.POSITIONAL_OR_KEYWORD) == count, name


def test_a_path_is_no_progress_and_a_function_is_called(elastic, study):
    quantity = "contact.mass.peak_force.value"
    for call in (
        lambda p: percuss.run(elastic, progress=p, time__end="1e3 s"),
        lambda p: percuss.converge(elastic, quantity, progress=p),
        lambda p: percuss.sweep(study, progress=p),
    ):
        with pytest.raises(TypeError, match="a path is given as out="):
            call("runs/plank")
    with pytest.raises(TypeError):
        percuss.run(elastic, "runs/plank")

    def heard(done, total):
        assert 0 <= done <= total
        raise RuntimeError("heard")

    for call in (
        lambda: percuss.run(elastic, progress=heard, time__end="1e3 s"),
        lambda: percuss.converge(elastic, quantity, progress=heard),
    ):
        with pytest.raises(RuntimeError, match="heard"):
            call()


def test_work_that_is_done_at_once_is_reported_at_its_end(elastic):
    calls = []
    percuss.run(elastic, progress=lambda done, total: calls.append((done, total)), time__end="2 ms")
    assert calls[-1] == (2e-3, 2e-3)
    percuss.converge(elastic, "contact.mass.peak_force.value", levels=3, progress=lambda *counts: calls.append(counts), time__end="2 ms")
    done, total = calls[-1]
    assert done == total > 1


def test_a_text_is_no_list(elastic):
    for call in (
        lambda: percuss.converge(elastic, "contact.mass.peak_force.value", refine="step"),
        lambda: percuss.sensitivity(elastic, "projectile.mass.mass"),
        lambda: percuss.sensitivity(elastic, ["projectile.mass.mass"], "contact.mass.peak_force.value"),
        lambda: percuss.run(elastic, shapes=10).plot(hide="loads"),
    ):
        with pytest.raises(TypeError, match="expected a list of texts"):
            call()


def test_an_unknown_keyword_names_the_nearest_option(elastic, study):
    for call, near in (
        (lambda: percuss.run(elastic, shape=10), "shapes"),
        (lambda: percuss.run(elastic, progres=False), "progress"),
        (lambda: percuss.converge(elastic, level=3), "levels"),
        (lambda: percuss.sweep(study, job=2), "jobs"),
        (lambda: percuss.sweep(study, desing={}), "design"),
        (lambda: percuss.function(study, fail="nan"), "failed"),
        (lambda: percuss.load("a.toml", allow_outsde=True), "allow_outside"),
        (lambda: percuss.fit(elastic, {}, [], start=2), "starts"),
        (lambda: percuss.run(elastic, shapes=10).plot(scael=2), "scale"),
        (lambda: percuss.run(elastic, shapes=10).animate(frame=2), "frames"),
    ):
        with pytest.raises(TypeError, match=f"did you mean '{near}'"):
            call()
    # Options of other functions are not suggested.
    with pytest.raises(TypeError, match="'jobs' is no option of this function"):
        percuss.run(elastic, jobs=2)
    with pytest.raises(TypeError, match="'failed' is no part of a study; expected one of title, base, scenario"):
        percuss.sweep(study, failed="nan")
    with pytest.raises(TypeError, match="parameters and parameter: one table in two spellings"):
        percuss.sweep({**study, "parameter": {}})
    # What is a key of scenarios is none of an option.
    with pytest.raises(percuss.ScenarioError, match="instead of a table"):
        percuss.run(elastic, time=1)


def test_a_report_needs_a_directory(elastic):
    with pytest.raises(ValueError, match="out=..."):
        percuss.run(elastic, report=True)


def test_jobs_are_counted_as_in_joblib(study):
    from percuss._options import threads

    assert threads(-1) >= 1 and threads(-2) == max(1, threads(-1) - 1) and threads(3) == 3
    assert percuss.sweep(study, jobs=-1)["exit"].tolist() == percuss.sweep(study, jobs=1)["exit"].tolist()
    with pytest.raises(TypeError, match="jobs=2.0"):
        percuss.sweep(study, jobs=2.0)


def test_color_is_colour(elastic):
    result = percuss.run(elastic, shapes=10)
    one, other = result.plot(colour="stress"), result.plot(color="stress")
    assert [len(ax.collections) for ax in (one, other)] == [len(one.collections)] * 2
    with pytest.raises(TypeError, match="two spellings"):
        result.plot(colour="stress", color="moment")


def test_open_hides_no_builtin():
    names: dict = {}
    exec("from percuss import *", names)
    assert "open" not in names and "run" in names
