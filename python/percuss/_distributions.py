"""Distributions of a study's parameters in the words of other packages."""

from __future__ import annotations

from math import log
from typing import TYPE_CHECKING, Any, Protocol

from ._errors import InputError, MissingError, coded

if TYPE_CHECKING:
    import openturns

    from ._structure import Floats

_SALIB = {
    "uniform": "unif",
    "log-uniform": "logunif",
    "normal": "norm",
    "truncated-normal": "truncnorm",
    "lognormal": "lognorm",
}
"""Distributions that SALib has; their numbers stand in the same order."""


class Varied(Protocol):
    """What has parameters that vary."""

    names: tuple[str, ...]
    results: tuple[str, ...]
    variations: dict[str, tuple[str, list[float]]]
    correlation: Floats | None


def salib_problem(f: Varied) -> dict[str, Any]:
    """A problem of SALib in SI units."""
    _independent(f)
    without = [f"{name} ({kind})" for name, (kind, _) in f.variations.items() if kind not in _SALIB]
    if without:
        text = f"SALib has no such distributions: {', '.join(without)}; take samples of `unit_problem`, and `f(f.at(samples))`"
        raise coded(InputError, text, None)
    return {
        "num_vars": len(f.names),
        "names": list(f.names),
        "dists": [_SALIB[kind] for kind, _ in f.variations.values()],
        "bounds": [_numbers(kind, numbers) for kind, numbers in f.variations.values()],
        "outputs": list(f.results),
    }


def unit_problem(f: Varied) -> dict[str, Any]:
    """A problem of SALib in shares."""
    _independent(f)
    bounds = [[0.0, 1.0] for _ in f.names]
    return {"num_vars": len(f.names), "names": list(f.names), "bounds": bounds, "outputs": list(f.results)}


def _independent(f: Varied) -> None:
    if f.correlation is None:
        return
    text = "parameters of the study are correlated, and those of SALib are independent; `f.at` makes correlated points of independent shares"
    raise coded(InputError, text, None)


def _numbers(kind: str, numbers: list[float]) -> list[float]:
    return sorted(numbers) if kind in ("uniform", "log-uniform") else numbers


def joint_distribution(f: Varied) -> openturns.Distribution:
    """A distribution of OpenTURNS with a Gaussian copula."""
    try:
        import openturns
    except ImportError as error:
        raise MissingError.of("openturns", "a distribution of OpenTURNS", "openturns") from error
    margins = [_margin(openturns, *variation) for variation in f.variations.values()]
    if f.correlation is None:
        copula = openturns.IndependentCopula(len(margins))
    else:
        copula = openturns.NormalCopula(openturns.CorrelationMatrix(f.correlation.tolist()))
    # Its name since OpenTURNS 1.23.
    joint = getattr(openturns, "JointDistribution", None) or openturns.ComposedDistribution
    made = joint(margins, copula)
    made.setDescription(f.names)
    return made


def _margin(openturns: Any, kind: str, numbers: list[float]) -> Any:
    if kind == "values":
        discrete = getattr(openturns, "FiniteDiscreteDistribution", None) or openturns.UserDefined
        return discrete([[value] for value in numbers])
    if kind in ("uniform", "log-uniform"):
        low, high = sorted(numbers)
        # Its logarithmic distribution has the logarithms of the ends.
        return openturns.Uniform(low, high) if kind == "uniform" else openturns.LogUniform(log(low), log(high))
    mean, deviation = numbers[-2:]
    whole = openturns.LogNormal(mean, deviation) if kind.endswith("lognormal") else openturns.Normal(mean, deviation)
    if not kind.startswith("truncated-"):
        return whole
    return openturns.TruncatedDistribution(whole, openturns.Interval([numbers[0]], [numbers[1]]))
