"""Values that a fit found, and what they are worth."""

from __future__ import annotations

import json
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from . import _percuss
from ._structure import Floats


class FitParameter(NamedTuple):
    """A parameter as a fit found it.

    Attributes
    ----------
    value : float
        Value [SI unit of the parameter].
    stderr : float
        Standard error [SI unit of the parameter]; zero if it is fixed, infinite where the data do not determine it.
    interval : (float, float)
        Interval that contains the true value with a probability of 95 % [SI unit of the parameter].
    start : float
        Starting value [SI unit of the parameter].
    bounds : (float or None, float or None)
        Smallest and largest value [SI unit of the parameter].
    unit : str
        SI unit, ``1`` for a pure number.
    fixed : bool
        Whether it kept its starting value.
    paths : list of str
        Paths in the scenario; none for the offset of a record.

    Examples
    --------
    >>> mass = found.params["mass"]  # of the example of `Fit`
    >>> round(mass.value, 3), mass.unit
    (10.0, 'kg')
    """

    value: float
    stderr: float
    interval: tuple[float, float]
    start: float
    bounds: tuple[float | None, float | None]
    unit: str
    fixed: bool
    paths: list[str]


class FitProfile(NamedTuple):
    """The least cost at given values of one parameter, all others free.

    Attributes
    ----------
    values : ndarray of shape (n_point,)
        Values of the parameter [its SI unit].
    costs : ndarray of shape (n_point,)
        Least costs [1]; NaN where no run succeeds.
    interval : (float, float)
        Interval of 95 % [SI unit of the parameter]: twice the cost lies less than 3.84 above its minimum. NaN at an end that the profile
        does not reach.

    Examples
    --------
    >>> profile = found.profile("mass", points=4)  # of the example of `Fit`
    >>> profile.values.shape, profile.interval[0] < 10 < profile.interval[1]
    ((9,), True)
    """

    values: Floats
    costs: Floats
    interval: tuple[float, float]


class FitValues:
    """Values, errors and statistics of a fit; names are those of SciPy's ``OptimizeResult`` and of lmfit.

    Examples
    --------
    >>> found.success, found.x.round(2)  # of the example of `Fit`
    (True, array([10.]))
    """

    def __init__(self, problem: _percuss.FitProblem, native: _percuss.NativeFit, keys: dict[str, str]) -> None:
        self._problem, self._native, self._keys = problem, native, keys
        self._value: dict[str, Any] = json.loads(native.json())

    def _key(self, name: str) -> str:
        """The user's key of a parameter."""
        return self._keys.get(name, name)

    @property
    def names(self) -> list[str]:
        """Names of the free parameters, in the order of :attr:`x`.

        Returns
        -------
        list of str
            Names; ``TEST.offset`` for the offset of a record.

        Examples
        --------
        >>> found.names
        ['mass']
        """
        return [self._key(name) for name in self._value["free"]]

    @cached_property
    def params(self) -> dict[str, FitParameter]:
        """All parameters, fixed ones and offsets of records included.

        Returns
        -------
        dict of FitParameter
            By their names.

        Examples
        --------
        >>> found.params["mass"].start
        9.0
        """
        out = {}
        for one, error in zip(self._value["parameters"], self._native.errors(), strict=True):
            low, high = (float("nan") if end is None else end for end in one["interval"])
            out[self._key(one["name"])] = FitParameter(
                one["value"],
                float(error),
                (low, high),
                one["start"],
                (one["bounds"][0], one["bounds"][1]),
                one["unit"],
                one["fixed"],
                one["paths"],
            )
        return out

    @property
    def x(self) -> Floats:
        """Values of the free parameters.

        Returns
        -------
        ndarray of shape (n_free,)
            Values [SI units of the parameters].

        Examples
        --------
        >>> found.x.round(3)
        array([10.])
        """
        return np.array([self.params[name].value for name in self.names])

    @property
    def stderr(self) -> Floats:
        """Standard errors of the free parameters.

        Returns
        -------
        ndarray of shape (n_free,)
            Standard deviations, to first order [SI units of the parameters]; infinite where the data do not determine one.

        Examples
        --------
        >>> found.stderr.shape, bool(found.stderr[0] > 0)
        ((1,), True)
        """
        return np.array([self.params[name].stderr for name in self.names])

    @property
    def cov(self) -> Floats:
        """Covariance of the free parameters.

        Returns
        -------
        ndarray of shape (n_free, n_free)
            Covariances [products of the SI units].

        Examples
        --------
        >>> bool(np.allclose(found.cov[0, 0], found.stderr[0] ** 2))
        True
        """
        return self._native.covariance()[0]

    @property
    def correl(self) -> Floats:
        """Coefficients of correlation of the free parameters.

        Returns
        -------
        ndarray of shape (n_free, n_free)
            Coefficients [1].

        Examples
        --------
        >>> found.correl
        array([[1.]])
        """
        return self._native.covariance()[1]

    @property
    def jac(self) -> Floats:
        """Derivatives of the residuals by the free parameters, rows weighted by the loss.

        Returns
        -------
        ndarray of shape (n_residual, n_free)
            Derivatives [1/SI unit of the parameter].

        Examples
        --------
        >>> bool(np.allclose(np.linalg.inv(found.jac.T @ found.jac), found.cov))
        True
        """
        return self._native.jacobian()

    @property
    def fun(self) -> Floats:
        """Residuals in standard deviations: computed less measured values, test after test and channel after channel, then priors.

        Returns
        -------
        ndarray of shape (n_residual,)
            Residuals [1].

        Examples
        --------
        >>> bool(abs(found.fun).max() < 0.1)
        True
        """
        return self._native.residuals()

    @property
    def cost(self) -> float:
        """Half the sum of the losses of the residuals.

        Returns
        -------
        float
            Cost [1].

        Examples
        --------
        >>> found.cost < 1e-3
        True
        """
        return float(self._value["cost"])

    @property
    def redchi(self) -> float:
        """Reduced chi-square: the mean square of the residuals per degree of freedom, 1 where they are noise of the given deviation.

        Returns
        -------
        float
            Reduced chi-square [1].

        Examples
        --------
        >>> found.redchi < 1e-3
        True
        """
        return float(self._value["reduced_chi_square"])

    @property
    def success(self) -> bool:
        """Whether the iteration converged.

        Returns
        -------
        bool
            That of the best starting point.

        Examples
        --------
        >>> found.success
        True
        """
        return bool(self._value["success"])

    @property
    def message(self) -> str:
        """Why the iteration ended.

        Returns
        -------
        str
            A sentence.

        Examples
        --------
        >>> found.message[:9]
        'converged'
        """
        return str(self._value["message"])

    @property
    def nfev(self) -> int:
        """Evaluations of the residuals from all starting points, those for difference quotients not counted.

        Returns
        -------
        int
            Number of evaluations.

        Examples
        --------
        >>> found.nfev > 1
        True
        """
        return int(self._value["evaluations"])

    @property
    def channels(self) -> list[dict[str, Any]]:
        """How well channels are met, hold-out tests included.

        Returns
        -------
        list of dict
            ``test``, ``channel``, ``column``, ``unit``, ``samples``, ``sigma``, ``rms``, ``reduced_chi_square``, ``r_squared``,
            ``autocorrelation``, ``effective_samples``, ``hold_out``.

        Examples
        --------
        >>> round(found.channels[0]["r_squared"], 4)
        1.0
        """
        return [dict(one) for one in self._value["channels"]]

    @property
    def warnings(self) -> list[tuple[str, str]]:
        """What speaks against the result.

        Returns
        -------
        list of (str, str)
            Kind (``convergence``, ``residuals``, ``correlation``, ``minima``, ``bound``, ``step``, ``autocorrelation``, ``one_sided``)
            and text.

        Examples
        --------
        >>> [kind for kind, text in found.warnings if kind == "residuals"]
        []
        """
        return [(one["kind"], one["text"]) for one in self._value["warnings"]]

    @property
    def starts(self) -> list[dict[str, Any]]:
        """What was found from each starting point.

        Returns
        -------
        list of dict
            ``x`` (values of the free parameters), ``cost`` (NaN where there is no run), ``success``, ``message``, ``evaluations``.

        Examples
        --------
        >>> [round(float(start["x"][0]), 3) for start in found.starts]
        [10.0, 10.0]
        """
        free = [k for k, one in enumerate(self._value["parameters"]) if not one["fixed"]]
        out = []
        for one in self._value["starts"]:
            values = self._problem.values(one["coordinates"])
            kept = {key: one[key] for key in ("cost", "success", "message", "evaluations")}
            kept["cost"] = float("nan") if one["cost"] is None else one["cost"]
            out.append({"x": np.array([values[k] for k in free]), **kept})
        return out
