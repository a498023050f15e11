"""Parameters of a scenario from measured curves."""

from __future__ import annotations

import json
import os
import re
import warnings as python_warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from . import _percuss, _toml
from ._errors import InputError, MissingError, PercussWarning
from ._load import Scenarios, scenario_of
from ._plot import pyplot
from ._scenario import Scenario
from ._structure import Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Found = tuple[list[float], list[float], float, bool, str, int]
"""Start, coordinates, cost, whether it converged, why it ended, evaluations."""

_PARAMETER = ("path", "paths", "start", "bounds", "spacing", "fixed", "prior", "tests")


class Measured:
    """A record of a test: measured curves, and the columns of the history that they are compared with.

    Parameters
    ----------
    source : str, path or mapping
        A CSV file whose first row names the columns and their units (``t [ms]``, ``F [kN]``), or columns by such headers: a dictionary
        of arrays, a DataFrame.
    channels : mapping
        Columns of the history by columns of the record: ``{"F": "contact.bag.force"}``; the unit in the header may be left out.
        Accelerations follow from velocities: ``point.tip.acceleration_2``.
    time : str
        The column of times.
    sigma : mapping or str or float, optional
        Standard deviation of the measured values, for every channel or by columns of the record: ``"50 N"``. Left out it follows from the
        residuals.
    cfc : mapping or int, optional
        Channel frequency class in which both curves are filtered, for every channel or by columns of the record.
    factor : mapping or float, optional
        Factor on measured values, such as -1 for the other direction.
    align : {"none", "onset", "fit"}, optional
        How times of the record become those of the run; that of :func:`percuss.fit` if it is left out.
    offset : str or float, optional
        Time of the record at which the run starts; the first guess if it is fitted.
    offset_bounds : (str or float, str or float), optional
        Smallest and largest offset if it is fitted.
    window : (str or float or None, str or float or None)
        First and last time of the record that are compared.
    hold_out : bool
        Keep the test out of the fit, and only compare it with the result.
    name : str, optional
        Name of the test; ``test``, or ``test1`` and so on, if it is left out.
    set : mapping, optional
        Values of the scenario that differ in this test, by their paths.
    scenario : str, path, mapping or Scenario, optional
        Another scenario for this test.

    Examples
    --------
    >>> record = {"t [ms]": [0, 1, 2], "F [kN]": [0, 1.2, 2.1]}
    >>> percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma="50 N")
    <percuss.Measured: contact.bag.force from F>
    """

    def __init__(
        self,
        source: Any,
        channels: Mapping[str, str],
        *,
        time: str = "time",
        sigma: Any = None,
        cfc: Any = None,
        factor: Any = None,
        align: Literal["none", "onset", "fit"] | None = None,
        offset: str | float | None = None,
        offset_bounds: tuple[str | float, str | float] | None = None,
        window: tuple[str | float | None, str | float | None] = (None, None),
        hold_out: bool = False,
        name: str | None = None,
        set: Mapping[str, Any] | None = None,
        scenario: Scenarios | None = None,
    ) -> None:
        if isinstance(channels, str) or not isinstance(channels, Mapping):
            raise TypeError('channels are columns of the history by columns of the record: {"F": "contact.bag.force"}')
        self._source = source
        self._channels = dict(channels)
        self._each = {"sigma": sigma, "cfc": cfc, "factor": factor}
        self._time = time
        self._table = {
            "align": align,
            "offset": offset,
            "offset_bounds": None if offset_bounds is None else list(offset_bounds),
            "from": window[0],
            "to": window[1],
            "hold_out": hold_out or None,
            "set": [f"{path}={_toml.value(value)}" for path, value in (set or {}).items()] or None,
        }
        self._name = name
        self._scenario = scenario

    def __repr__(self) -> str:
        both = ", ".join(f"{column} from {data}" for data, column in self._channels.items())
        return f"<percuss.Measured: {both}>"

    def _columns(self) -> list[tuple[str, list[float]]] | None:
        """Columns of the record; none for a file."""
        if isinstance(self._source, (str, os.PathLike)):
            return None
        columns = self._source
        return [(str(header), [float(x) for x in columns[header]]) for header in list(columns)]

    def _toml(self, name: str, align: str) -> str:
        """The test as tables of a file."""
        table: dict[str, Any] = {"data": "", "time": self._time, **{k: v for k, v in self._table.items() if v is not None}}
        if isinstance(self._source, (str, os.PathLike)):
            table["data"] = os.path.abspath(self._source)
        table.setdefault("align", align)
        text = f"[test.{name}]\n" + _lines(table)
        for key, each in self._each.items():
            if isinstance(each, Mapping) and (unknown := [data for data in each if data not in self._channels]):
                raise KeyError(f"{key}: {unknown[0]!r} is no channel{nearest(str(unknown[0]), tuple(self._channels))}")
        for k, (data, column) in enumerate(self._channels.items()):
            channel = {"column": column, "data": data}
            for key, each in self._each.items():
                value = each.get(data) if isinstance(each, Mapping) else each
                if value is not None:
                    channel[key] = value
            text += f"[test.{name}.channel.{_plain(data, f'channel{k + 1}')}]\n" + _lines(channel)
        return text


def _lines(table: Mapping[str, Any]) -> str:
    return "".join(f"{key} = {_toml.value(value)}\n" for key, value in table.items())


def _plain(text: str, instead: str) -> str:
    """A name of letters, digits and underscores."""
    name = re.sub(r"\W+", "_", re.split(r"[\[(/]", text)[0].strip()).strip("_")
    return name or instead


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
    >>> run = percuss.run("plank.toml")
    >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
    >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
    ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
    >>> round(found.params["mass"].value, 3), found.params["mass"].unit
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
    >>> run = percuss.run("plank.toml")
    >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
    >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
    ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
    >>> profile = found.profile("mass", points=4)
    >>> profile.values.shape, profile.interval[0] < 10 < profile.interval[1]
    ((9,), True)
    """

    values: Floats
    costs: Floats
    interval: tuple[float, float]


class Fit:
    """Parameters found from measured curves; :func:`percuss.fit` makes them. Names are those of SciPy's ``OptimizeResult`` and of lmfit.

    Examples
    --------
    >>> run = percuss.run("plank.toml")
    >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
    >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
    ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
    >>> found.names, found.x.round(2)
    (['mass'], array([10.]))
    """

    def __init__(
        self,
        problem: _percuss.FitProblem,
        native: _percuss.NativeFit,
        solver: str,
        scenarios: dict[str, Scenario],
        keys: dict[str, str],
    ) -> None:
        self._problem, self._native = problem, native
        self._value: dict[str, Any] = json.loads(native.json())
        self._scenarios = scenarios
        self._keys = keys
        self.solver = solver

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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> percuss.fit("plank.toml", {"projectile.bag.mass": {"start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin").names
        ['projectile.bag.mass']
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin").params["mass"].start
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin").x.round(3)
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin").correl
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin").cost < 1e-3
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin").redchi < 1e-3
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin").success
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin").message[:9]
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin").nfev > 1
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
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
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
            Kind (``convergence``, ``residuals``, ``correlation``, ``minima``, ``bound``, ``step``, ``autocorrelation``) and text.

        Examples
        --------
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
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
            ``x`` (values of the free parameters), ``cost``, ``success``, ``message``, ``evaluations``.

        Examples
        --------
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9, "bounds": [5, 20]}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), starts=2, solver="basin")
        >>> [round(float(start["x"][0]), 3) for start in found.starts]
        [10.0, 10.0]
        """
        free = [k for k, one in enumerate(self._value["parameters"]) if not one["fixed"]]
        out = []
        for one in self._value["starts"]:
            values = self._problem.values(one["coordinates"])
            kept = {key: one[key] for key in ("cost", "success", "message", "evaluations")}
            out.append({"x": np.array([values[k] for k in free]), **kept})
        return out

    def report(self) -> str:
        """The report as text: statistics, parameters with standard errors, correlations, channels, warnings.

        Returns
        -------
        str
            Several lines.

        Examples
        --------
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
        >>> "[parameters]" in found.report()
        True
        """
        return self._native.text()

    def to_scenario(self, test: str | None = None) -> Scenario:
        """The scenario with the values found.

        Parameters
        ----------
        test : str, optional
            Name of a test whose scenario differs.

        Returns
        -------
        Scenario
            With every default written out, in SI units.

        Examples
        --------
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
        >>> abs(found.to_scenario()["projectile.bag.mass"] - 10) < 1e-3
        True
        """
        texts = dict(self._native.scenarios())
        text = texts.get(f"fitted-{test}.toml", texts["fitted.toml"])
        given = self._scenarios.get(test or "", self._scenarios[""])._given
        scenario = Scenario(text, "fitted.toml")
        scenario._given.update(given)
        return scenario

    def profile(self, name: str, points: int = 8) -> FitProfile:
        """The least cost at given values of one parameter, all others free: the interval of 95 % without the assumption that the model is
        linear within it.

        Parameters
        ----------
        name : str
            A free parameter.
        points : int
            Values to either side, within three standard errors.

        Returns
        -------
        FitProfile
            Values, least costs and interval.

        Raises
        ------
        KeyError
            If there is no such free parameter.

        Examples
        --------
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
        >>> low, high = found.profile("mass", points=4).interval
        >>> low < 10 < high
        True
        """
        inner = {self._key(inner): inner for inner in self._value["free"]}
        if name not in inner:
            raise KeyError(f"{name!r} is no free parameter{nearest(name, tuple(inner))}")
        found = self._problem.profile(self._native, inner[name], points)
        assert found is not None
        values, costs, (low, high) = found
        return FitProfile(values, costs, (low, high))

    def plot(self, test: str | None = None, ax: Sequence[Axes] | None = None) -> list[Axes]:
        """Measured and computed curves, one figure each, residuals below.

        Parameters
        ----------
        test : str, optional
            Name of a test; all if it is left out.
        ax : sequence of matplotlib.axes.Axes, optional
            Two axes for each channel to draw on: curves, residuals.

        Returns
        -------
        list of matplotlib.axes.Axes
            Two for each channel.

        Examples
        --------
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
        >>> [ax.get_ylabel() for ax in found.plot()]
        ['contact.bag.force [N]', 'residual [N]']
        """
        curves = [one for one in self._native.curves() if test in (None, one[0])]
        axes = list(ax) if ax is not None else []
        for k, (of, channel, column, unit, time, measured, computed, _) in enumerate(curves):
            if len(axes) < 2 * k + 2:
                _, both = pyplot().subplots(2, 1, sharex=True, height_ratios=(3, 1))
                axes.extend(both)
            above, below = axes[2 * k : 2 * k + 2]
            above.plot(time, measured, ".", markersize=3, label="measured")
            above.plot(time, computed, label="computed")
            above.set_title(f"{of}: {channel}")
            above.set_ylabel(f"{column} [{unit}]")
            above.legend()
            below.plot(time, computed - measured, ".", markersize=3)
            below.axhline(0.0, linewidth=0.8, color="black")
            below.set_ylabel(f"residual [{unit}]")
            below.set_xlabel("time of the record [s]")
        return axes

    def save(self, out: str | os.PathLike[str]) -> str:
        """Writes ``fit.json``, ``fit.txt``, ``fit.html`` with the curves, ``curves.csv`` and the scenarios with the values found.

        Parameters
        ----------
        out : str or path
            A directory; an earlier fit in it is replaced.

        Returns
        -------
        str
            Where it is.

        Examples
        --------
        >>> run = percuss.run("plank.toml")
        >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
        >>> found = percuss.fit("plank.toml", {"mass": {"path": "projectile.bag.mass", "start": 9}},
        ...     percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma=50.0), solver="basin")
        >>> place = found.save("runs/plank-fit")
        """
        return os.fspath(self._native.write(os.fspath(out)))

    def __repr__(self) -> str:
        reported = []
        for name in self.names:
            one = self.params[name]
            reported.append(f"{name} = {one.value:.6g} {'' if one.unit == '1' else one.unit}".rstrip())
        return f"<percuss.Fit: {', '.join(reported)}; reduced chi-square {self.redchi:.3g}>"

    def _repr_html_(self) -> str:
        rows = ""
        for name, one in self.params.items():
            error = "fixed" if one.fixed else f"&plusmn; {one.stderr:.3g}"
            rows += f"<tr><th>{escape(name)}</th><td>{one.value:.6g}</td><td>{error}</td><td>{escape(one.unit)}</td></tr>"
        notes = "".join(f"<p>{escape(text)}</p>" for _, text in self.warnings)
        return f"<table><tr><th>parameter</th><th>value</th><th></th><th>unit</th></tr>{rows}</table>{notes}"


Parameters = Mapping[str, Any]
"""Tables of parameters by their names; a name may be the path itself, and the table the path alone."""


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
        SciPy's ``least_squares``, or the optimiser of the command, which computes starting points in parallel.
    iterations : int
        Most iterations from a starting point.
    jobs : int
        Threads; -1 for one a core.
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
        If scenario, parameters or records have faults.
    AnalysisError
        If no starting point has a run.
    MissingError
        If SciPy is not installed.
    InputError
        If an argument has no such value.

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
    if jobs == 0 or jobs < -1:
        raise InputError(f"jobs = {jobs}: a number of threads, or -1 for one a core")
    tests = [data] if isinstance(data, Measured) else list(data)
    base = scenario_of(scenario)
    options = {
        "loss": loss,
        "loss_scale": float(loss_scale),
        "starts": starts,
        "seed": seed,
        "jacobian": jac,
        "iterations": iterations,
    }
    text = f'title = {_toml.value(title)}\nscenario = ""\n[fit]\n' + _lines(options)
    keys: dict[str, str] = {}
    for key, given in parameters.items():
        name, table = _parameter(key, given)
        keys[name] = key
        text += f"[parameter.{name}]\n" + _lines(table)
    scenarios, own, records = {"": base}, [], []
    for k, test in enumerate(tests):
        name = test._name or ("test" if len(tests) == 1 else f"test{k + 1}")
        text += test._toml(name, align)
        if test._scenario is not None:
            scenarios[name] = scenario_of(test._scenario)
            own.append((name, scenarios[name]._source()))
        if (columns := test._columns()) is not None:
            records.append((name, columns))
    problem = _percuss.FitProblem(text, base._source(), own, records, max(jobs, 0))
    minima = problem.minima() if solver == "basin" else _scipy(problem, loss, float(loss_scale), iterations)
    found = Fit(problem, problem.diagnose(minima), solver, scenarios, keys)
    if out is not None:
        found.save(out)
    for _, said in found.warnings:
        warning = PercussWarning(f"{said} [W119]")
        warning.code = "W119"
        python_warnings.warn(warning, stacklevel=2)
    return found


def nearest(name: str, names: Sequence[str]) -> str:
    """Suggestions for an unknown name, or all names."""
    from difflib import get_close_matches

    close = get_close_matches(name, names, n=3)
    return f"; did you mean {' or '.join(map(repr, close))}?" if close else f"; one of {', '.join(names)}"


def _one_of(name: str, value: str, known: tuple[str, ...]) -> None:
    if value not in known:
        raise InputError(f"{name} = {value!r}{nearest(str(value), known)}")


def _parameter(key: str, given: Any) -> tuple[str, dict[str, Any]]:
    """Name and table of a parameter."""
    if isinstance(given, str):
        given = {"path": given}
    elif isinstance(given, (tuple, list)):
        given = {"bounds": list(given)}
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
    if "bounds" in table:
        table["bounds"] = list(table["bounds"])
    if isinstance(table.get("prior"), (tuple, list)):
        table["prior"] = dict(zip(("mean", "deviation"), table["prior"], strict=True))
    return _plain(key.replace("[", "_"), "parameter"), table


def _scipy(problem: _percuss.FitProblem, loss: str, scale: float, iterations: int) -> list[Found]:
    """Minima by SciPy, one starting point after the other."""
    try:
        from scipy.optimize import least_squares
    except ImportError as error:
        raise MissingError.of("scipy", 'fits with solver="scipy"', "fit") from error
    low, high = np.array(problem.bounds()).T
    return [_descend(least_squares, problem, start, (low, high), loss, scale, iterations) for start in problem.starts()]


def _descend(
    least_squares: Any,
    problem: _percuss.FitProblem,
    start: list[float],
    bounds: tuple[Floats, Floats],
    loss: str,
    scale: float,
    iterations: int,
) -> Found:
    why = problem.residuals(start)[1]
    if why is not None:
        return start, start, float("nan"), False, f"the run at the starting point fails: {why}", 1
    found = least_squares(
        lambda z: problem.residuals(list(z))[0],
        start,
        jac=lambda z: problem.jacobian(list(z)),
        bounds=bounds,
        loss=loss,
        f_scale=scale,
        max_nfev=2 * iterations,
    )
    words = "converged" if found.success else "not converged"
    return start, found.x.tolist(), float(found.cost), bool(found.success), f"{words}: {found.message}", int(found.nfev)
