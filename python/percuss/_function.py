"""A study as a function of the numbers that vary in it: for samplers, optimisers and surrogates of other packages."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from concurrent.futures import Executor
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _percuss
from ._distributions import joint_distribution, salib_problem, unit_problem
from ._errors import AnalysisError, InputError, PercussError, PercussWarning, coded
from ._named import named_columns
from ._options import own_options
from ._outcome import NOT_FINAL, warn
from ._structure import Floats
from ._study import StudySource, Sweep, study_at, study_of
from ._sweep import sweep

if TYPE_CHECKING:
    import openturns
    from distributed import Client


class Function:
    """A study as ``y = f(x)``: values of its parameters in, its results out, all in SI units.

    The sampling design of the study is ignored: the caller chooses the points. Runs of one call are computed in batches where possible.

    Parameters
    ----------
    study : Study
        The study; only numbers may vary in it.
    failed : {"raise", "nan"}
        Treatment of points whose run does not complete or has no such result.
    jobs : int
        Number of threads for several points; -1 (or 0) for one a core, -2 for one less, as in joblib.
    client : distributed.Client, optional
        Run them on a Dask cluster.
    executor : concurrent.futures.Executor, optional
        Run them on an executor.
    out : str or path, optional
        Keeps the runs of each call in a directory of its own below this one, or below a location that fsspec knows: a call with the same
        points goes on from there.
    progress : bool or callable, optional
        Whether a bar is shown for points on several threads or kept ones; by default on a terminal and in notebooks. A function is called
        with the runs done and their number.

    Attributes
    ----------
    study : Study
        The study.
    failed : str
        Treatment of points without a value.
    names : tuple of str
        Names of the parameters, in the order of a point.
    results : tuple of str
        Names of the results, in the order of a value.
    units : dict of str
        SI units of parameters and results.
    paths : dict of str
        Where parameters stand in the scenario, and results in the summary.
    bounds : list of (float, float) or None
        Smallest and largest value of each parameter in the study [SI units]; None where it has none.
    middle : ndarray of shape (n_parameter,)
        Median of each parameter in the study [SI units].
    variations : dict of (str, list of float)
        Of each parameter how it varies in the study, and the numbers of that [SI units]: ``"uniform"`` and ``"log-uniform"`` (smallest,
        largest), ``"normal"`` (mean, deviation), ``"lognormal"`` (mean and deviation of the logarithm), ``"truncated-normal"`` and
        ``"truncated-lognormal"`` (smallest, largest, and these two), ``"values"`` (all of them).
    correlation : ndarray of shape (n_parameter, n_parameter) or None
        Correlation matrix of the Gaussian variables behind the parameters, a Gaussian copula [-]; None if they are independent.
    means : str or None
        How the last Jacobian was found: ``"exact"``, or ``"differences: "`` and why; None before the first one.

    Raises
    ------
    ValueError
        If ``failed`` is something else.
    InputError
        If something else than a number varies.

    Examples
    --------
    >>> f = percuss.function("speed-and-mass.toml")
    >>> f.names, f.results
    (('speed', 'mass', 'young'), ('peak_force', 'peak_displacement', 'exit_velocity'))
    >>> f.units["speed"], f.bounds[0]
    ('m/s', (10.0, 30.0))
    >>> f([[20, 500, 2e9], [25, 500, 2e9]]).shape
    (2, 3)
    >>> f.jacobian([20, 500, 2e9]).shape  # exact
    (3, 3)
    """

    def __init__(
        self,
        study: _percuss.Study,
        *,
        failed: Literal["raise", "nan"] = "raise",
        jobs: int = 1,
        client: Client | None = None,
        executor: Executor | None = None,
        out: str | os.PathLike[str] | None = None,
        progress: bool | Callable[[float, float], object] | None = None,
    ) -> None:
        if failed not in ("raise", "nan"):
            raise ValueError(f'failed is {failed!r}; it may be "raise" or "nan"')
        inputs, bounds, middle, outputs = _percuss.function_layout(study)
        self.study = study
        self.failed = failed
        self.means: str | None = None
        self.names: tuple[str, ...] = tuple(name for name, _, _ in inputs)
        self.results: tuple[str, ...] = tuple(name for name, _, _ in outputs)
        self.units: dict[str, str] = {name: unit for name, unit, _ in [*inputs, *outputs]}
        self.paths: dict[str, str] = {name: path for name, _, path in [*inputs, *outputs]}
        self.bounds: list[tuple[float, float] | None] = bounds
        self.middle: Floats = np.array(middle)
        variations, correlation = _percuss.function_variations(study)
        self.variations: dict[str, tuple[str, list[float]]] = dict(zip(self.names, variations))
        self.correlation: Floats | None = None if correlation is None else np.array(correlation)
        self._out = None if out is None else os.fspath(out).rstrip("/")
        self._spread: dict[str, Any] = {"jobs": jobs, "client": client, "executor": executor, "progress": progress}

    def __call__(self, x: Any) -> Floats:
        """Results at points.

        Parameters
        ----------
        x : array of shape (n_parameter,) or (n_point, n_parameter), or table
            Points, in SI units. Columns with names are matched with the parameters by them, in any order: those of a table of pandas, polars
            or Arrow, of a mapping or of a structured array, a sample of OpenTURNS.

        Returns
        -------
        ndarray of shape (n_result,) or (n_point, n_result)
            Results, in SI units [f.units]; a single result has an axis of its own, too.

        Raises
        ------
        ValueError
            If the array has another shape.
        InputError
            If the names are not those of the parameters.
        AnalysisError, InputError
            If a point has no value and ``failed`` is ``"raise"``: which, and why.

        Warns
        -----
        PercussWarning
            If a contact is still closed at the end of a run, and results are what they have come to by then: which.

        Examples
        --------
        >>> f = percuss.function("speed.toml")
        >>> round(float(f([-5.0])[0]))  # N
        2561
        >>> f = percuss.function("speed-and-mass.toml")
        >>> bool((f({"young": 2e9, "mass": 500, "speed": 20}) == f([20, 500, 2e9])).all())
        True
        """
        points = self._points(x)
        if self._is_spread(points):
            flat, failures = self._swept(np.atleast_2d(points))
        else:
            flat, failures, left_open = _percuss.function_values(self.study, np.atleast_2d(points).tolist())
            if left_open:
                point, text = left_open[0]
                more = f" (and {len(left_open) - 1} more)" if len(left_open) > 1 else ""
                warn(PercussWarning, f"point {point}{more}: {text}" if points.ndim > 1 else text, NOT_FINAL)
        if failures and self.failed == "raise":
            point, why = failures[0]
            more = f" (and {len(failures) - 1} more)" if len(failures) > 1 else ""
            raise _error_of(f"point {point}{more}: {why}" if points.ndim > 1 else why)
        return flat.reshape(*points.shape[:-1], len(self.results))

    def _is_spread(self, points: Floats) -> bool:
        """Whether points go to several threads or processes, or are kept."""
        several = points.ndim > 1 and len(points) > 1
        elsewhere = self._spread["client"] is not None or self._spread["executor"] is not None
        return points.size > 0 and (self._out is not None or several and (elsewhere or self._spread["jobs"] != 1))

    def _swept(self, points: Floats) -> tuple[Floats, list[tuple[int, str]]]:
        """Results at points as those of a study that lists them, and why some have none."""
        study = self._at(points)
        out = None if self._out is None else f"{self._out}/points-{study.fingerprint[:16]}"
        table = sweep(study, out=out, **self._spread)
        values = np.column_stack([table[name] for name in self.results])
        return values, [(k, why) for k in range(len(table)) if (why := self._missing(table, k, values[k]))]

    def _at(self, points: Floats) -> _percuss.Study:
        study = study_at(points, self.study, {})
        units = [unit for _, unit, _ in _percuss.function_layout(study)[0]]
        if units == [self.units[name] for name in self.names]:
            return study
        # A bare number for a place along a beam is a fraction, and this study varies lengths.
        texts = [[x if self.units[name] == "1" else f"{x!r} {self.units[name]}" for x in points[:, k].tolist()] for k, name in enumerate(self.names)]
        return study_at(dict(zip(self.names, texts)), self.study, {})

    def _missing(self, table: Sweep, k: int, values: Floats) -> str:
        """Why a run has no value, empty if it has."""
        if table["status"][k] != "completed":
            return str(table["reason"][k])
        for name, value in zip(self.results, values):
            if np.isnan(value):
                return f"the run at this point has no `{self.paths[name]}` (`{name}`) [E319]"
        return ""

    def jacobian(self, x: Any) -> Floats:
        """Derivatives of all results at a point: exact ones of the run, impacts included, else central differences of runs.

        ``means`` says which: ``"exact"``, or ``"differences: "`` and why.

        Parameters
        ----------
        x : array of shape (n_parameter,), or mapping
            Point, in SI units; names are matched as in a call.

        Returns
        -------
        ndarray of shape (n_result, n_parameter)
            In SI units of both [result/parameter].

        Raises
        ------
        ValueError
            If it is not one point.
        AnalysisError
            If the run fails, or a result is a count or an error of the computation.

        Examples
        --------
        >>> f = percuss.function("speed-and-mass.toml")
        >>> slope = f.jacobian([20, 500, 2e9])[0, 0]  # of the peak force with the speed, N per m/s
        >>> ahead, behind = f([[20.001, 500, 2e9], [19.999, 500, 2e9]])[:, 0]
        >>> bool(abs(slope - (ahead - behind) / 0.002) < 1e-3 * slope)
        True
        """
        point = self._points(x)
        if point.ndim != 1:
            raise ValueError(f"a Jacobian is one of a point, shape ({len(self.names)},), found {point.shape}")
        _, flat, means, why = _percuss.function_jacobian(self.study, point.tolist())
        if why is not None:
            raise _error_of(why)
        self.means = means
        return flat.reshape(len(self.results), len(self.names))

    def at(self, shares: Any) -> Floats:
        """Points at shares of the distributions of the study, correlated as in it.

        Samplers of the unit cube become samples of the study by this, whatever its distributions.

        Parameters
        ----------
        shares : array of shape (n_parameter,) or (n_point, n_parameter), or table
            Shares from 0 to 1 [-]; 0.5 is the median. Names are matched as in a call.

        Returns
        -------
        ndarray of the same shape
            Points [SI units].

        Raises
        ------
        ValueError
            If the array has another shape.
        InputError
            If a share is not from 0 to 1.

        Examples
        --------
        >>> f = percuss.function("speed-and-mass.toml")
        >>> f.at([[0, 0, 0.5], [1, 1, 0.5]])[:, :2].round(3)
        array([[ 10., 250.],
               [ 30., 900.]])
        """
        points = self._points(shares)
        flat, why = _percuss.function_points(self.study, np.atleast_2d(points).tolist())
        if why is not None:
            raise _error_of(why)
        return flat.reshape(points.shape)

    @property
    def problem(self) -> dict[str, Any]:
        """The problem definition of SALib, with the distributions of the study.

        Returns
        -------
        dict
            ``num_vars``, ``names``, ``dists``, ``bounds``, ``outputs``.

        Raises
        ------
        InputError
            If SALib has no such distributions, or no correlated parameters; :attr:`unit_problem` serves for all.

        Examples
        --------
        >>> f = percuss.function("speed.toml")
        >>> f.problem["dists"], f.problem["bounds"]
        (['unif'], [[-9.0, -1.0]])
        """
        return salib_problem(self)

    @property
    def unit_problem(self) -> dict[str, Any]:
        """A problem definition of SALib in shares of the distributions, from 0 to 1: ``f(f.at(samples))``.

        Returns
        -------
        dict
            ``num_vars``, ``names``, ``bounds``, ``outputs``.

        Raises
        ------
        InputError
            If parameters are correlated: indices share out a variance among independent ones.

        Examples
        --------
        >>> percuss.function("speed-and-mass.toml").unit_problem["bounds"]
        [[0.0, 1.0], [0.0, 1.0], [0.0, 1.0]]
        """
        return unit_problem(self)

    def distribution(self) -> openturns.Distribution:
        """The joint distribution of the parameters in the study, for OpenTURNS.

        Returns
        -------
        openturns.Distribution
            With the correlations of the study as a Gaussian copula, in SI units.

        Raises
        ------
        MissingError
            If OpenTURNS is not installed.

        Examples
        --------
        >>> f = percuss.function("speed-and-mass.toml")
        >>> f.distribution().getMarginal(0)
        class=Uniform name=Uniform dimension=1 a=10 b=30
        """
        return joint_distribution(self)

    def _points(self, x: Any) -> Floats:
        named = named_columns(x)
        if named is None:
            points = np.asarray(x, dtype=float)
        else:
            places = _percuss.function_places(self.study, list(named))
            values = list(named.values())
            points = np.stack(np.broadcast_arrays(*(np.asarray(values[k], dtype=float) for k in places)), axis=-1)
        if points.ndim not in (1, 2) or points.shape[-1] != len(self.names):
            wanted = f"{len(self.names)} numbers a point ({', '.join(self.names)})"
            raise ValueError(f"found an array of shape {points.shape}, expected {wanted}")
        return points

    def __repr__(self) -> str:
        return f"<percuss.Function ({', '.join(self.names)}) -> ({', '.join(self.results)})>"


@own_options
def function(
    study: StudySource,
    *,
    failed: Literal["raise", "nan"] = "raise",
    allow_outside: bool = False,
    jobs: int = 1,
    client: Client | None = None,
    executor: Executor | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: bool | Callable[[float, float], object] | None = None,
) -> Function:
    """A study as a function ``y = f(x)``; see :class:`Function`.

    Parameters
    ----------
    study : str, path, mapping or Study
        A study, the path of its file, or nested dictionaries with the file's names.
    failed : {"raise", "nan"}
        Treatment of points whose run does not complete or has no such result.
    allow_outside : bool
        Let the study name files outside its own folder.
    jobs : int
        Number of threads for several points; -1 (or 0) for one a core, -2 for one less, as in joblib.
    client : distributed.Client, optional
        Run them on a Dask cluster.
    executor : concurrent.futures.Executor, optional
        Run them on an executor: a process pool, mpi4py's.
    out : str or path, optional
        Keeps the runs of each call in a directory of its own below this one, or below a location that fsspec knows: a call with the same
        points goes on from there.
    progress : bool or callable, optional
        Whether a bar is shown for points on several threads or kept ones; by default on a terminal and in notebooks. A function is called
        with the runs done and their number.

    Returns
    -------
    Function
        From values of the parameters to results.

    Raises
    ------
    ScenarioError
        If the study has faults.

    Examples
    --------
    >>> percuss.function("speed.toml")
    <percuss.Function (speed) -> (peak_force, deflection, stress)>
    >>> percuss.function("speed.toml", jobs=0, out="kept")([[-2.5], [-7.5]])[:, 0].round()
    array([1280., 3842.])
    """
    read = study_of(study, {}, allow_outside)
    return Function(read, failed=failed, jobs=jobs, client=client, executor=executor, out=out, progress=progress)


def _error_of(why: str) -> PercussError:
    """An exception whose text ends with its code."""
    found = re.search(r" \[(E\d+)\]$", why)
    code = found[1] if found else None
    kind = AnalysisError if code is not None and code.startswith("E1") else InputError
    return coded(kind, why[: found.start()] if found else why, code)
