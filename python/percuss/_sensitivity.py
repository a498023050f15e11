"""Derivatives of a run's results."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from . import _percuss
from ._columns import read_only
from ._load import Scenarios, scenario_of
from ._nearest import nearest
from ._options import texts
from ._structure import Floats


class Sensitivity:
    """Derivatives of results with respect to numbers of the scenario, in SI units of both; :func:`percuss.sensitivity` makes them.

    Examples
    --------
    >>> found = percuss.sensitivity("plank.toml", ["projectile.bag.mass"], ["contact.bag.peak_force.value"])
    >>> round(found["contact.bag.peak_force.value", "projectile.bag.mass"], 1)  # N per kg
    85.5
    """

    def __init__(self, native: dict[str, Any]) -> None:
        read_only(native)
        self._native = native

    def __reduce__(self) -> tuple[Any, ...]:
        return (Sensitivity, (self._native,))

    @property
    def parameters(self) -> dict[str, float]:
        """Values of the parameters.

        Returns
        -------
        dict of float
            By their paths in the scenario [SI units].

        Examples
        --------
        >>> percuss.sensitivity("plank.toml", ["projectile.bag.mass"]).parameters
        {'projectile.bag.mass': 10.0}
        """
        return {path: value for path, value, _ in self._native["parameters"]}

    @property
    def results(self) -> dict[str, float]:
        """Values of the results.

        Returns
        -------
        dict of float
            By their paths in the summary [SI units].

        Examples
        --------
        >>> found = percuss.sensitivity("plank.toml", ["projectile.bag.mass"], ["contact.bag.peak_force.value"])
        >>> round(found.results["contact.bag.peak_force.value"])
        2561
        """
        return {path: value for path, value, _ in self._native["results"]}

    @property
    def units(self) -> dict[str, str]:
        """SI units of parameters and results.

        Returns
        -------
        dict of str
            By their paths.

        Examples
        --------
        >>> percuss.sensitivity("plank.toml", ["projectile.bag.mass"]).units["projectile.bag.mass"]
        'kg'
        """
        both = [*self._native["parameters"], *self._native["results"]]
        return {path: unit for path, _, unit in both}

    @property
    def derivatives(self) -> Floats:
        """All derivatives.

        Returns
        -------
        ndarray of shape (n_result, n_parameter)
            In SI units of both [result/parameter]; NaN for those of ``without``.

        Examples
        --------
        >>> by = ["projectile.bag.mass", "projectile.bag.velocity[1]"]
        >>> percuss.sensitivity("plank.toml", by, ["contact.bag.peak_force.value"]).derivatives.round(1)
        array([[  85.5, -512.2]])
        """
        derivatives: Floats = self._native["derivatives"]
        return derivatives

    @property
    def uncertainties(self) -> Floats:
        """Uncertainty of each derivative from the size of the step.

        Returns
        -------
        ndarray of shape (n_result, n_parameter)
            Three times what half or four fifths of the step change, the larger [result/parameter]; NaN where other steps give no estimate.

        Examples
        --------
        >>> found = percuss.sensitivity("plank.toml", ["projectile.bag.mass"], ["contact.bag.peak_force.value"])
        >>> bool(found.uncertainties[0, 0] < 0.01 * found.derivatives[0, 0])
        True
        """
        uncertainties: Floats = self._native["uncertainties"]
        return uncertainties

    @property
    def one_sided(self) -> list[str]:
        """Contacts and yielding that appear or vanish for a change of a parameter by less than one per cent: its derivatives are one-sided.

        Returns
        -------
        list of str
            Sentences.

        Examples
        --------
        >>> percuss.sensitivity("plank.toml", ["projectile.bag.mass"]).one_sided
        []
        """
        return list(self._native["one_sided"])

    @property
    def without(self) -> dict[tuple[str, str], str]:
        """Derivatives that are not available, and the reasons.

        Returns
        -------
        dict of str
            Why, by (result, parameter).

        Examples
        --------
        >>> percuss.sensitivity("plank.toml", ["projectile.bag.mass"], ["contact.bag.peak_force.value"]).without
        {}
        """
        return {(result, parameter): why for result, parameter, why in self._native["without"]}

    @property
    def horizon(self) -> tuple[float, str] | None:
        """Time up to which derivatives are available, and the reason.

        Returns
        -------
        (float, str) or None
            The time [s] and the reason; None where they are available up to the end of the run.

        Examples
        --------
        >>> percuss.sensitivity("plank.toml", ["projectile.bag.mass"]).horizon is None
        True
        """
        horizon: tuple[float, str] | None = self._native["horizon"]
        return horizon

    def __getitem__(self, key: tuple[str, str]) -> float:
        """One derivative: ``s[result, parameter]``.

        Parameters
        ----------
        key : (str, str)
            Paths of the result in the summary and of the parameter in the scenario.

        Returns
        -------
        float
            The derivative, in SI units of both [result/parameter].

        Raises
        ------
        ValueError
            If one of them was not asked for.

        Examples
        --------
        >>> found = percuss.sensitivity("plank.toml", ["projectile.bag.mass"], ["contact.bag.peak_force.value"])
        >>> round(found["contact.bag.peak_force.value", "projectile.bag.mass"], 1)
        85.5
        """
        result, parameter = key
        row, column = _place("result", result, self.results), _place("parameter", parameter, self.parameters)
        return float(self.derivatives[row, column])

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


def _place(what: str, path: str, paths: Iterable[str]) -> int:
    """Index of a path among those that were asked for."""
    known = list(paths)
    if path not in known:
        raise ValueError(f"{path!r} is no {what} of this sensitivity{nearest(path, known)}")
    return known.index(path)


def sensitivity(
    scenario: Scenarios,
    parameters: Sequence[str],
    results: Sequence[str] = (),
    **overrides: Any,
) -> Sensitivity:
    """Derivatives of results of a run with respect to numbers of its scenario.

    Every operation of the run is differentiated, the instants of impacts included: the derivatives are those of the computed
    run, not differences of runs. The run is made again at half and at four fifths of its step: what these change makes the
    ``uncertainties``.

    Parameters
    ----------
    scenario : str, path, mapping or Scenario
        A scenario, the path of its file, or nested dictionaries with the file's names.
    parameters : sequence of str
        Paths in the scenario (``"projectile.mass.velocity[1]"``).
    results : sequence of str
        Paths in the summary (``"contact.mass.peak_force.value"``); by default peaks, impulses and velocities at the end.
    **overrides
        Values to change, with ``__`` for the dots of a path.

    Returns
    -------
    Sensitivity
        Of every result by every parameter.

    Raises
    ------
    ScenarioError
        If the scenario has faults, or a path leads nowhere.
    AnalysisError
        If something cannot be differentiated.

    Examples
    --------
    >>> found = percuss.sensitivity("plank.toml", ["projectile.bag.mass"], ["contact.bag.peak_force.value"])
    >>> found
    <Sensitivity: 1 results by 1 parameters>
    """
    source = scenario_of(scenario)._source(overrides)
    return Sensitivity(_percuss.sensitivity(source, texts("parameters", parameters), texts("results", results)))
