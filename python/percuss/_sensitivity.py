"""Derivatives of a run's results."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import Any

from . import _percuss
from ._scenario import Scenarios, changes_of, scenario_of
from ._structure import Floats


class Sensitivity:
    """Derivatives of results with respect to numbers of the scenario, in SI units of both."""

    def __init__(self, native: dict[str, Any]) -> None:
        self._native = native

    def __reduce__(self) -> tuple[Any, ...]:
        return (Sensitivity, (self._native,))

    @property
    def parameters(self) -> dict[str, float]:
        """Values of the parameters, by their paths in the scenario."""
        return {path: value for path, value, _ in self._native["parameters"]}

    @property
    def results(self) -> dict[str, float]:
        """Values of the results, by their paths in the summary."""
        return {path: value for path, value, _ in self._native["results"]}

    @property
    def units(self) -> dict[str, str]:
        """SI units of parameters and results."""
        both = [*self._native["parameters"], *self._native["results"]]
        return {path: unit for path, _, unit in both}

    @property
    def derivatives(self) -> Floats:
        """All derivatives, shape (n_result, n_parameter); nan for those of ``without``."""
        derivatives: Floats = self._native["derivatives"]
        return derivatives

    @property
    def uncertainties(self) -> Floats:
        """Uncertainty of each derivative from the size of the step, shape (n_result, n_parameter): three times what half or
        four fifths of the step change, the larger; nan where other steps do not tell."""
        uncertainties: Floats = self._native["uncertainties"]
        return uncertainties

    @property
    def one_sided(self) -> list[str]:
        """Contacts that a change of a parameter by less than one per cent makes or ends: derivatives by it are one-sided."""
        return list(self._native["one_sided"])

    @property
    def without(self) -> dict[tuple[str, str], str]:
        """Derivatives that there are not, by result and parameter, and why."""
        return {(result, parameter): why for result, parameter, why in self._native["without"]}

    @property
    def horizon(self) -> tuple[float, str] | None:
        """Time to which derivatives reach and what stands against more; none where they reach to the end of the run."""
        horizon: tuple[float, str] | None = self._native["horizon"]
        return horizon

    def __getitem__(self, key: tuple[str, str]) -> float:
        """``s[result, parameter]``."""
        result, parameter = key
        row = list(self.results).index(result)
        return float(self.derivatives[row, list(self.parameters).index(parameter)])

    def __repr__(self) -> str:
        return f"<Sensitivity: {len(self.results)} results by {len(self.parameters)} parameters>"

    def _repr_html_(self) -> str:
        heads = "".join(f"<th>{escape(path)}</th>" for path in self.parameters)
        rows = ""
        both = zip(self.derivatives, self.uncertainties, strict=True)
        for (path, value), (row, off) in zip(self.results.items(), both, strict=True):
            cells = "".join(f"<td>{x:.6g} &plusmn; {u:.1g}</td>" for x, u in zip(row, off, strict=True))
            rows += f"<tr><th>{escape(path)}</th><td>{value:.6g}</td>{cells}</tr>"
        notes = "".join(f"<p>{escape(text)}</p>" for text in self.one_sided)
        return f"<table><tr><th>result</th><th>value</th>{heads}</tr>{rows}</table>{notes}"


def sensitivity(
    scenario: Scenarios,
    parameters: Sequence[str],
    results: Sequence[str] = (),
    **overrides: Any,
) -> Sensitivity:
    """Derivatives of results of a run with respect to numbers of its scenario.

    Every operation of the run is differentiated, the instants of impacts included: the derivatives are those of the computed
    run, not differences of runs.

    ``parameters`` are paths in the scenario (``"projectile.mass.velocity[1]"``), ``results`` paths in the summary
    (``"contact.mass.peak_force.value"``); without results, peaks, impulses and velocities at the end.

    The run is made again at half and at four fifths of its step: what these change makes the ``uncertainties``.

    Raises ``ScenarioError`` for paths that lead nowhere, ``AnalysisError`` for what cannot be differentiated.
    """
    source = scenario_of(scenario)._source(changes_of(overrides))
    return Sensitivity(_percuss.sensitivity(source, list(parameters), list(results)))
