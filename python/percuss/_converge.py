"""How far results depend on step and mesh."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from html import escape
from typing import Any, NamedTuple, Union

import numpy as np

from . import _percuss
from ._columns import nearest
from ._errors import AnalysisError, InputError, coded
from ._progress import Progress
from ._result import Result
from ._run import run
from ._scenario import Scenario, Scenarios, changes_of, scenario_of

Quantity = Union[str, Callable[[Result], float]]


class Convergence(NamedTuple):
    """A quantity on finer and finer steps, or meshes."""

    refined: str
    """``step`` or ``mesh``."""
    quantity: str
    """What was looked at."""
    factors: tuple[int, ...]
    """How many times finer than given: 1, 2, 4."""
    values: tuple[float, ...]
    """The quantity there."""
    order: float | None
    """Observed order, from the three finest; none where the values, all of them, do not approach a limit steadily."""
    limit: float
    """Richardson's extrapolation; the finest value where there is no order."""
    error: float
    """Value under the given settings less the limit."""
    uncertainty: float
    """Uncertainty of the limit: without an order what the values but the coarsest still differ by."""

    @property
    def relative_error(self) -> float:
        """Error of the given settings over the limit."""
        return self.error / self.limit if self.limit else math.nan

    def __repr__(self) -> str:
        order = "no steady order" if self.order is None else f"order {self.order:.2f}"
        return (
            f"<percuss.Convergence in the {self.refined}: {self.quantity} = {self.values[0]:.9g}, limit {self.limit:.9g}, "
            f"error {self.relative_error:.1e} (relative), {order}>"
        )

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><td>{k}</td><td>{v:.12g}</td></tr>" for k, v in zip(self.factors, self.values))
        return f"<table><caption>{escape(repr(self)[1:-1])}</caption><tr><th>times finer</th><th>value</th></tr>{rows}</table>"


def converge(
    scenario: Scenarios,
    quantity: Quantity | None = None,
    refine: Sequence[str] = ("step", "mesh"),
    levels: int = 3,
    progress: bool | None = None,
    **overrides: Any,
) -> dict[str, Convergence]:
    """Repeats a run with halved steps and with doubled meshes: observed order, limit, error of the given settings.

    ``quantity`` is the name of a column, of which the largest magnitude over time is taken; a path in the summary, such as
    ``"contact.mass.peak_force.value"``; or a function of the :class:`Result`. By default it is the largest displacement of the
    point that moves most.
    """
    if levels < 3:
        raise coded(InputError, f"levels={levels}: expected 3 or more, an order needs three values", "E311")
    unknown = [word for word in refine if word not in ("step", "mesh")]
    if unknown:
        raise ValueError(f'refine: {unknown[0]!r}, expected "step" or "mesh"')
    given = scenario_of(scenario)
    base = Scenario(_written(given, overrides), given.name)
    base._given = given._source(changes_of(overrides))[3]
    if "step" in refine and "time.accuracy" in base:
        text = "time.accuracy chooses steps as it goes, and what is halved here is one that is given: give a time.step"
        raise coded(InputError, text, "E311")
    factors = tuple(2**k for k in range(levels))
    runs = 1 + len(refine) * (levels - 1)
    with Progress(progress, runs, "runs", "converge") as bar:
        first = _completed(base)
        what = quantity or _most_moved(first)
        out = {}
        for n, word in enumerate(refine):
            values = [_value(first, what)]
            for k, factor in enumerate(factors[1:]):
                values.append(_value(_completed(_finer(base, word, factor)), what))
                bar.to(2 + n * (levels - 1) + k)
            name = what if isinstance(what, str) else getattr(what, "__name__", "quantity")
            # One home for orders and limits: `percuss converge` tells the same.
            order, limit, uncertainty = _percuss.extrapolated(values)
            out[word] = Convergence(word, name, factors, tuple(values), order, limit, values[0] - limit, uncertainty)
    return out


def _written(scenario: Scenario, overrides: dict[str, Any]) -> str:
    return _percuss.written(scenario._source(changes_of(overrides)))


def _completed(scenario: Scenario) -> Result:
    result = run(scenario, progress=False, shapes=0)
    if result.status != "completed":
        text = f"a refined run did not complete: {result.summary.get('error', result.status)}"
        raise coded(AnalysisError, text, result.summary.get("error_code"))
    return result


def _finer(base: Scenario, word: str, factor: int) -> Scenario:
    """The same with steps, or elements, of a fraction of their size."""
    fine = base.copy()
    if word == "step":
        fine["time.step"] = base["time.step"] / factor
        if "record.every" in base:
            fine["record.every"] = base["record.every"] * factor
        return fine
    for name, beam in base["beam"].items():
        if "elements" in beam:
            fine[f"beam.{name}.elements"] = beam["elements"] * factor
        if "element_length" in beam:
            fine[f"beam.{name}.element_length"] = beam["element_length"] / factor
    return fine


def _value(result: Result, what: Quantity) -> float:
    if callable(what):
        return float(what(result))
    if what in result:
        column = result[what]
        return float(column[np.abs(column).argmax()])
    found: Any = result.summary
    rest = what
    while rest and isinstance(found, dict):
        # Names of points have dots in them.
        fit = [key for key in found if rest == key or rest.startswith(f"{key}.")]
        if not fit:
            break
        key = max(fit, key=len)
        found, rest = found[key], rest[len(key) + 1 :]
    if rest or not isinstance(found, (int, float)):
        raise KeyError(f"{what!r} is neither a column nor a number of the summary{nearest(what, result.columns)}")
    return float(found)


def _most_moved(result: Result) -> str:
    names = [n for n in result.columns if n.startswith("point.") and ".displacement_" in n]
    if not names:
        raise ValueError('no point is recorded: give a quantity, or record.points = ["beam.mid"]')
    return max(names, key=lambda name: float(np.abs(result[name]).max()))
