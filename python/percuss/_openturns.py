"""A study as a function of OpenTURNS."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import MissingError
from ._function import Function, function
from ._options import own_options
from ._study import StudySource

if TYPE_CHECKING:
    import openturns


@own_options
def openturns_function(study: StudySource | Function) -> openturns.Function:
    """A study as an ``openturns.Function`` with its gradient; samples are computed in batches.

    The distribution of its parameters is ``percuss.function(study).distribution()``.

    Parameters
    ----------
    study : str, path, mapping, Study or Function
        A study, or the function it is.

    Returns
    -------
    openturns.Function
        From values of the parameters to results.

    Raises
    ------
    MissingError
        If OpenTURNS is not installed.
    ScenarioError
        If the study has faults.

    Examples
    --------
    >>> g = percuss.openturns("speed-and-mass.toml")
    >>> g.getInputDescription()
    [speed,mass,young]
    >>> round(g([20, 500, 2e9])[0] / 1000)  # kN
    338
    """
    try:
        import openturns
    except ImportError as error:
        raise MissingError.of("openturns", "a function of OpenTURNS", "openturns") from error
    f = study if isinstance(study, Function) else function(study)

    def gradient(x: Any) -> Any:
        # OpenTURNS wants a row for each parameter.
        return openturns.Matrix(f.jacobian(np.array(x)).T.tolist())

    made = openturns.PythonFunction(
        len(f.names),
        len(f.results),
        func=lambda x: f(np.array(x)).tolist(),
        func_sample=lambda x: f(np.array(x)).tolist(),
        gradient=gradient,
    )
    made.setInputDescription(f.names)
    made.setOutputDescription(f.results)
    return made
