"""Parameters of a scenario from measured curves."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal

from . import _percuss, _toml
from ._errors import InputError, PercussWarning
from ._fit_result import Fit
from ._least_squares import least_squares, minima_of
from ._load import Scenarios, scenario_of
from ._measured import Measured, simple_name, table_text
from ._nearest import nearest
from ._options import own_options, threads
from ._outcome import warn

_PARAMETER = ("path", "paths", "start", "bounds", "spacing", "fixed", "prior", "tests")

Parameters = Mapping[str, Any]
"""Tables of parameters by their names; a name may be the path itself, and the table the path alone."""


@own_options
def fit(
    scenario: Scenarios,
    parameters: Parameters,
    data: Measured | Sequence[Measured],
    *,
    align: Literal["none", "onset", "fit"] = "none",
    loss: Literal["linear", "soft_l1", "huber"] = "linear",
    loss_scale: float = 1.0,
    starts: int = 1,
    seed: int = 0,
    jac: Literal["auto", "exact", "differences"] = "auto",
    solver: Literal["scipy", "basin"] = "scipy",
    iterations: int = 100,
    jobs: int = -1,
    title: str = "",
    out: str | os.PathLike[str] | None = None,
) -> Fit:
    """Finds parameters of a scenario from measured curves, by nonlinear least squares.

    Residuals are computed less measured values in standard deviations. Warnings of the result are issued as :class:`PercussWarning`.

    Parameters
    ----------
    scenario : str, path, mapping or Scenario
        A scenario, the path of its file, or nested dictionaries with the file's names.
    parameters : mapping
        Tables by names of your own, with the keys of ``[parameter.NAME]`` in the file of a fit: ``path`` or ``paths`` (several numbers
        with one value), ``start``, ``bounds``, ``spacing`` (``"linear"``, ``"log"``), ``fixed``, ``prior`` (``mean`` and ``deviation``),
        ``tests``. A name may be the path itself; a text is the path alone, a pair the bounds.
    data : Measured or sequence of Measured
        Records of tests.
    align : {"none", "onset", "fit"}
        How times of records become those of runs: by given offsets, by the onset of the first channel, or by offsets that are fitted.
    loss : {"linear", "soft_l1", "huber"}
        How a residual counts: its square, or less where it is large.
    loss_scale : float
        Residual in standard deviations from which on it counts less [1].
    starts : int
        Starting points: the given one, and others of a Latin hypercube within the bounds.
    seed : int
        Seed of the Latin hypercube.
    jac : {"auto", "exact", "differences"}
        Where derivatives come from.
    solver : {"scipy", "basin"}
        SciPy's ``least_squares``, or the optimiser of the command, which needs no SciPy.
    iterations : int
        Most iterations from a starting point; SciPy makes at most twice as many evaluations.
    jobs : int
        Number of threads, for starting points and runs side by side; -1 (or 0) for one a core, -2 for one less, as in joblib. The result does
        not depend on it.
    title : str
        One line about the fit.
    out : str or path, optional
        Directory for the files of :meth:`Fit.save`.

    Returns
    -------
    Fit
        Parameters, standard errors, warnings.

    Raises
    ------
    ScenarioError
        If scenario, parameters or records have faults; if some channels have a standard deviation, and others have not.
    AnalysisError
        If no starting point has a run.
    MissingError
        If SciPy is not installed.
    InputError
        If an argument has no such value, or two records have one name.
    TypeError
        If parameters or records are something else, or a parameter has an unknown key.
    KeyboardInterrupt
        On Ctrl-C; runs of all starting points end.

    Examples
    --------
    >>> run = percuss.run("plank.toml")
    >>> noise = np.random.default_rng(2).normal(0, 20, run.time.size)
    >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"] + noise}
    >>> data = percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma="20 N")
    >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": "9 kg"}}, data, solver="basin")
    >>> low, high = found.params["mass"].interval
    >>> low < 10 < high
    True
    """
    _one_of("align", align, ("none", "onset", "fit"))
    _one_of("solver", solver, ("scipy", "basin"))
    count = threads(jobs)
    solve = least_squares() if solver == "scipy" else None
    tests = _named_tests(data)
    base = scenario_of(scenario)
    options = {
        "loss": loss,
        "loss_scale": float(loss_scale),
        "starts": starts,
        "seed": seed,
        "jacobian": jac,
        "iterations": iterations,
    }
    text = f'title = {_toml.value(title)}\nscenario = ""\n' + table_text("fit", options)
    tables, keys = _parameters(parameters)
    text += tables
    scenarios, own, records = {"": base}, [], []
    for name, test in tests.items():
        text += test._text(name, align)
        if test._scenario is not None:
            scenarios[name] = scenario_of(test._scenario)
            own.append((name, scenarios[name]._source()))
        if test._columns is not None:
            records.append((name, test._columns))
    problem = _percuss.FitProblem(text, base._source(), own, records, count)
    if solve is None:
        minima = problem.minima()
    else:
        minima = minima_of(problem, solve, {"loss": loss, "f_scale": float(loss_scale), "max_nfev": 2 * iterations}, count or threads(-1))
    found = Fit(problem, problem.diagnose(minima), solver, scenarios, keys)
    if out is not None:
        found.save(out)
    for _, doubt in found.warnings:
        warn(PercussWarning, doubt, "W119")
    return found


def _one_of(name: str, value: str, known: tuple[str, ...]) -> None:
    if value not in known:
        raise InputError(f"{name} = {value!r}{nearest(value, known)}")


def _named_tests(data: Measured | Sequence[Measured]) -> dict[str, Measured]:
    """Records by the names of their tests."""
    given = [data] if isinstance(data, Measured) else list(data)
    tests: dict[str, Measured] = {}
    for k, test in enumerate(given):
        if not isinstance(test, Measured):
            raise TypeError(f"data: found a {type(test).__name__}, expected percuss.Measured, or a list of them")
        name = test._name or ("test" if len(given) == 1 else f"test{k + 1}")
        if name in tests:
            raise InputError(f"data: two records are named {name!r}; give each a name of its own")
        tests[name] = test
    return tests


def _parameters(parameters: Parameters) -> tuple[str, dict[str, str]]:
    """Parameters as tables of a file, and the user's keys by the names of these."""
    if not isinstance(parameters, Mapping):
        raise TypeError("parameters are tables by names: {'mass': {'path': 'projectile.bag.mass', 'bounds': (5, 20)}}")
    text, keys, taken = "", {}, set[str]()
    for key, given in parameters.items():
        name = simple_name(key.replace("[", "_"), taken)
        keys[name] = key
        text += table_text(f"parameter.{_toml.key(name)}", _parameter(key, given))
    return text, keys


def _parameter(key: str, given: Any) -> dict[str, Any]:
    """The table of a parameter."""
    if isinstance(given, str):
        given = {"path": given}
    elif isinstance(given, (tuple, list)):
        given = {"bounds": given}
    elif given is None:
        given = {}
    if not isinstance(given, Mapping):
        raise TypeError(f"{key}: a table such as {{'path': 'projectile.bag.mass', 'bounds': (5, 20)}}")
    table = dict(given)
    for word in table:
        if word not in _PARAMETER:
            raise TypeError(f"{key}: {word!r} is no key of a parameter{nearest(word, _PARAMETER)}")
    if "path" not in table and "paths" not in table:
        table["path"] = key
    for pair in ("bounds", "prior"):
        value = table.get(pair)
        if value is not None and not isinstance(value, Mapping):
            if isinstance(value, str) or len(value) != 2:
                raise TypeError(f"{key}: {pair} = {value!r}, expected a pair")
            table[pair] = list(value)
    if isinstance(table.get("prior"), list):
        table["prior"] = dict(zip(("mean", "deviation"), table["prior"]))
    return {word: value for word, value in table.items() if value is not None}
