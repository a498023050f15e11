"""Convergence with step and mesh."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any, NamedTuple, Union

from . import _percuss
from ._errors import AnalysisError, InputError, coded
from ._load import Scenarios, scenario_of
from ._options import texts
from ._outcome import warn_of_audit
from ._plot import pyplot
from ._progress import Progress
from ._result import Result
from ._scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Quantity = Union[str, Callable[[Result], float]]


class Convergence(NamedTuple):
    """A quantity under refinement of the step, of the mesh, of the fibres, or of all of them.

    Attributes
    ----------
    refined : str
        ``step``, ``mesh``, ``fibres`` or ``together``.
    quantity : str
        What was looked at.
    factors : tuple of int
        How many times finer than given: 1, 2, 4, 8.
    values : tuple of float
        The quantity there [its SI unit]; a largest magnitude with the sign that the finest run gives.
    order : float or None
        Observed order [1], one or more, from the three finest; None where the values do not approach a limit so fast.
    limit : float
        Richardson's extrapolation [its SI unit]; the finest value where there is no order.
    error : float
        Value under the given settings less the limit [its SI unit].
    uncertainty : float
        Uncertainty of the limit [its SI unit] in what is refined: 1.25 times what would still change at first order, less where four
        values or more agree upon an order.

    Examples
    --------
    >>> found = percuss.converge("plank.toml", "contact.bag.peak_force.value", refine=["step"])
    >>> found["step"].factors, round(found["step"].order, 1), round(found["step"].limit)
    ((1, 2, 4, 8), 1.1, 2561)
    """

    refined: str
    quantity: str
    factors: tuple[int, ...]
    values: tuple[float, ...]
    order: float | None
    limit: float
    error: float
    uncertainty: float

    @property
    def relative_error(self) -> float:
        """Error of the given settings relative to the limit.

        Returns
        -------
        float
            Error [1]; NaN where the limit is zero.

        Examples
        --------
        >>> found = percuss.converge("plank.toml", "contact.bag.peak_force.value", refine=["step"])
        >>> f"{found['step'].relative_error:.1e}"
        '1.9e-05'
        """
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

    def plot(self, ax: Axes | None = None) -> Axes:
        """Error of each value over the refinement factor, both logarithmic; the uncertainty of the limit is shaded.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Raises
        ------
        MissingError
            If matplotlib is not installed.

        Examples
        --------
        >>> found = percuss.converge("plank.toml", "contact.bag.peak_force.value", refine=["step"])
        >>> found["step"].plot().get_xlabel()
        'times finer than given'
        """
        ax = ax or pyplot().subplots()[1]
        # Without an order the finest value is the limit: it has no distance to draw on a logarithmic axis.
        off = [abs(value - self.limit) or math.nan for value in self.values]
        name = self.refined if self.order is None else f"{self.refined}, order {self.order:.2f}"
        (line,) = ax.loglog(self.factors, off, marker="o", label=name)
        if self.uncertainty > 0:
            ax.axhspan(0, self.uncertainty, color=line.get_color(), alpha=0.1)
        ax.set_xlabel("times finer than given")
        ax.set_ylabel(f"distance from the limit, {self.quantity}")
        ax.set_xticks(self.factors, [str(factor) for factor in self.factors])
        ax.minorticks_off()
        ax.legend()
        return ax


class Convergences(dict[str, Convergence]):
    """A quantity on finer steps and on finer meshes: ``found["step"]``, ``found["mesh"]``. Prints, and plots, as a whole.

    Examples
    --------
    >>> percuss.converge("plank.toml", "contact.bag.peak_force.value")
    <percuss.Convergence in the step: contact.bag.peak_force.value = 2560.92..., order 1.0...>
    <percuss.Convergence in the mesh: contact.bag.peak_force.value = 2560.92..., no steady order>
    """

    def __repr__(self) -> str:
        return "\n".join(repr(one) for one in self.values())

    def _repr_html_(self) -> str:
        return "".join(one._repr_html_() for one in self.values())

    def plot(self, ax: Axes | None = None) -> Axes:
        """Errors over the refinement factor, on one pair of axes.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default on a figure of its own.

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on.

        Raises
        ------
        MissingError
            If matplotlib is not installed.

        Examples
        --------
        >>> ax = percuss.converge("plank.toml", "contact.bag.peak_force.value").plot()
        >>> len(ax.get_lines())
        2
        """
        ax = ax or pyplot().subplots()[1]
        for one in self.values():
            one.plot(ax)
        return ax


def converge(
    scenario: Scenarios,
    quantity: Quantity | None = None,
    *,
    refine: Sequence[str] = ("step", "mesh"),
    levels: int = 4,
    progress: bool | Callable[[float, float], object] | None = None,
    **overrides: Any,
) -> Convergences:
    """Repeats a run with halved steps, doubled meshes and doubled fibres: observed order, limit, error of the given settings.

    ``percuss converge`` computes the same, with as many levels: orders are those of the three finest of them.

    Parameters
    ----------
    scenario : str, path, mapping or Scenario
        What is run.
    quantity : str or callable, optional
        A path in the summary, such as ``"contact.mass.peak_force.value"``; name of a column, of which the value of largest
        magnitude in the rows of the history is taken; or a function of the :class:`Result`. By default the largest displacement
        of the point that moves most.
    refine : sequence of str
        ``"step"``, ``"mesh"``, ``"fibres"`` (where sections yield) or ``"together"``; of a function of the result the first two.
    levels : int
        Runs of each, 3 or more: an order needs three values.
    progress : bool or callable, optional
        Whether a bar is shown; by default on a terminal and in notebooks. A function is called with the runs done and their number.
    **overrides
        Values to change, with ``__`` for the dots of a path.

    Returns
    -------
    Convergences
        By what is refined.

    Raises
    ------
    InputError
        If ``levels`` are fewer than 3, the scenario chooses its steps itself (``time.accuracy``), or the finest runs would cost too much.
    ValueError
        If ``refine`` names something else, or no quantity is given and no point recorded.
    KeyError
        If the quantity is neither a column nor a number of the summary.
    ScenarioError
        If the scenario has faults.
    AnalysisError
        If a run, as given or refined, does not complete.

    Examples
    --------
    >>> found = percuss.converge("plank.toml", "contact.bag.peak_force.value")
    >>> round(found["step"].order, 1), round(found["step"].limit)
    (1.1, 2561)
    """
    if levels < 3:
        raise coded(InputError, f"levels={levels}: expected 3 or more, an order needs three values", "E311")
    known = ("step", "mesh") if callable(quantity) else ("step", "mesh", "fibres", "together")
    refine = texts("refine", refine)
    unknown = [word for word in refine if word not in known]
    if unknown:
        raise ValueError(f"refine: {unknown[0]!r}, expected {', '.join(known)}")
    given = scenario_of(scenario)
    if callable(quantity):
        return _of_function(given, quantity, refine, levels, progress, overrides)
    with Progress(progress, 1, "runs", "converge") as bar:
        source = given._source(overrides)
        name, sequences = _percuss.converged(source, quantity, refine, levels, bar.to)
    out = Convergences()
    for word, values, order, limit, uncertainty in sequences:
        factors = tuple(2**k for k in range(len(values)))
        out[word] = Convergence(word, name, factors, tuple(values), order, limit, values[0] - limit, uncertainty)
    return out


def _of_function(
    given: Scenario,
    quantity: Callable[[Result], float],
    refine: Sequence[str],
    levels: int,
    progress: bool | Callable[[float, float], object] | None,
    overrides: dict[str, Any],
) -> Convergences:
    """The same of a function of the result, which only Python can call."""
    source = given._source(overrides)
    base = Scenario(_percuss.written(source), given.name, allow_outside=given._outside)
    base._given = source[3]
    if "step" in refine and "time.accuracy" in base:
        text = "time.accuracy chooses steps as it goes, and what is halved here is one that is given: give a time.step"
        raise coded(InputError, text, "E311")
    factors = tuple(2**k for k in range(levels))
    out = Convergences()
    with Progress(progress, 1 + len(refine) * (levels - 1), "runs", "converge") as bar:
        first = float(quantity(_completed(base, bar)))
        for n, word in enumerate(refine):
            values = [first]
            for k, factor in enumerate(factors[1:]):
                values.append(float(quantity(_completed(_finer(base, word, factor), bar))))
                bar.to(2 + n * (levels - 1) + k)
            name = getattr(quantity, "__name__", "quantity")
            order, limit, uncertainty = _percuss.extrapolated(values)
            out[word] = Convergence(word, name, factors, tuple(values), order, limit, values[0] - limit, uncertainty)
    return out


def _completed(scenario: Scenario, bar: Progress) -> Result:
    """A run, without the advice on step and mesh: what is looked at is their effect."""
    # Reported of, it logs no estimate of its time, which would break the line of the bar.
    reported = None if bar.listener is None else _ignored
    result = Result._of(_percuss.run(scenario._source(), reported, None, False, 0))
    warn_of_audit(result)
    if result.status != "completed":
        text = f"a run did not complete: {result.summary.get('error', result.status)}"
        raise coded(AnalysisError, text, result.summary.get("error_code"))
    return result


def _ignored(time: float, end: float) -> None:
    """The time that a run has reached, of which nothing is shown."""


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
