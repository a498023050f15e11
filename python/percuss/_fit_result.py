"""A fit: its report, figures, profiles, files, and the scenario with the values found."""

from __future__ import annotations

import os
from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

from . import _percuss
from ._errors import PercussWarning
from ._fit_values import FitProfile, FitValues
from ._nearest import nearest
from ._outcome import warn
from ._plot import pyplot
from ._scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Fit(FitValues):
    """Parameters found from measured curves; :func:`percuss.fit` makes them. Names are those of SciPy's ``OptimizeResult`` and of lmfit.

    Attributes
    ----------
    solver : str
        What found them: ``scipy`` or ``basin``.

    Examples
    --------
    >>> run = percuss.run("plank.toml")
    >>> record = {"t [s]": run.time, "F [N]": run["contact.bag.force"]}
    >>> data = percuss.Measured(record, {"F": "contact.bag.force"}, time="t", sigma="50 N")
    >>> mass = {"path": "projectile.bag.mass", "start": "9 kg", "bounds": ("5 kg", "20 kg")}
    >>> found = percuss.fit("plank.toml", {"mass": mass}, data, starts=2, solver="basin")
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
        super().__init__(problem, native, keys)
        self._scenarios = scenarios
        self.solver = solver

    def report(self) -> str:
        """The report as text: statistics, parameters with standard errors, correlations, channels, warnings.

        Returns
        -------
        str
            Several lines.

        Examples
        --------
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

        Raises
        ------
        KeyError
            If there is no such test.

        Examples
        --------
        >>> abs(found.to_scenario()["projectile.bag.mass"] - 10) < 1e-3
        True
        """
        self._require(test)
        texts = dict(self._native.scenarios())
        given = self._scenarios.get(test or "", self._scenarios[""])
        # Files that it names lie where those of the given one do.
        name = os.path.join(os.path.dirname(given.name), "fitted.toml")
        scenario = Scenario(texts.get(f"fitted-{test}.toml", texts["fitted.toml"]), name, allow_outside=given._outside)
        scenario._given = given.copy()._given
        return scenario

    def _require(self, test: str | None) -> None:
        """Refuses the name of a test that there is not."""
        known = tuple(dict.fromkeys(one["test"] for one in self._value["channels"]))
        if test is not None and test not in known:
            raise KeyError(f"{test!r} is no test{nearest(test, known)}")

    def profile(self, name: str, points: int = 8) -> FitProfile:
        """The least cost at given values of one parameter, all others free: the interval of 95 % without the assumption that the model is
        linear within it. A cost below that of the fit is a :class:`PercussWarning`: the fit is then no minimum.

        Parameters
        ----------
        name : str
            A free parameter.
        points : int
            Values to either side, within three standard errors; fewer where a bound is nearer.

        Returns
        -------
        FitProfile
            Values, least costs and interval.

        Raises
        ------
        KeyError
            If there is no such free parameter.
        ValueError
            If ``points`` is below 1.

        Examples
        --------
        >>> low, high = found.profile("mass", points=4).interval
        >>> low < 10 < high
        True
        """
        inner = {self._key(inner): inner for inner in self._value["free"]}
        if name not in inner:
            raise KeyError(f"{name!r} is no free parameter{nearest(name, inner)}")
        if points < 1:
            raise ValueError(f"points={points}: expected one to either side, or more")
        found = self._problem.profile(self._native, inner[name], points)
        assert found is not None
        values, costs, (low, high), lower = found
        if lower is not None:
            warn(PercussWarning, lower, "W119")
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

        Raises
        ------
        KeyError
            If there is no such test.
        ValueError
            If ``ax`` are not two for each channel.
        MissingError
            If matplotlib is not installed.

        Examples
        --------
        >>> [ax.get_ylabel() for ax in found.plot()]
        ['contact.bag.force [N]', 'residual [N]']
        """
        self._require(test)
        curves = [one for one in self._native.curves() if test in (None, one[0])]
        if ax is None:
            axes = [one for _ in curves for one in pyplot().subplots(2, 1, sharex=True, height_ratios=(3, 1))[1]]
        else:
            axes = list(ax)
            if len(axes) != 2 * len(curves):
                raise ValueError(f"ax: found {len(axes)}, expected two for each of {len(curves)} channels")
        for k, (of, channel, column, unit, time, measured, computed, _) in enumerate(curves):
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
