"""Percuss: impact on geometrically exact beams, with an energy and momentum balance after every step.

Names and units are those of the scenario file; a bare number is SI. Examples speak of ``plank.toml`` and ``speed.toml``, the
scenario and the study of the book's first hour, and of ``scenarios/studies/speed-and-mass.toml``; those of a fit's parts of ``found``, the
fit in the example of :class:`Fit`.

Examples
--------
>>> import percuss
>>> scenario = percuss.load("plank.toml")
>>> scenario["projectile.bag.velocity"] = [0, "-7 m/s"]
>>> result = percuss.run(scenario, out="runs/plank")
>>> round(result["contact.bag.force"].max())  # N
3585
>>> ax = result.plot()
>>> ax = percuss.open("runs/plank").plot.energy()
"""

from ._analyses import Equilibrium, Modes, modes, static
from ._converge import Convergence, Convergences, converge
from ._errors import (
    AnalysisError,
    Fault,
    FileError,
    InputError,
    MissingError,
    MissingRunError,
    PathError,
    PercussError,
    PercussWarning,
    ScenarioError,
    StudyError,
)
from ._fit import fit
from ._fit_result import Fit
from ._fit_values import FitParameter, FitProfile
from ._function import Function, function
from ._given import Potential
from ._load import check, load
from ._measured import Measured
from ._open import open as open  # not in `import *`, which would hide that of Python
from ._openturns import openturns_function as openturns
from ._outcome import AdviceWarning, FailedRunError, FailedRunWarning
from ._percuss import VERSION as __version__
from ._percuss import Study
from ._result import Result
from ._review import Advice, Review
from ._run import run
from ._scenario import Scenario
from ._sensitivity import Sensitivity, sensitivity
from ._study import Sweep
from ._sweep import sweep

__all__ = [
    "Advice",
    "AdviceWarning",
    "AnalysisError",
    "Convergence",
    "Convergences",
    "Equilibrium",
    "FailedRunError",
    "FailedRunWarning",
    "Fault",
    "FileError",
    "Fit",
    "FitParameter",
    "FitProfile",
    "Function",
    "InputError",
    "Measured",
    "MissingError",
    "MissingRunError",
    "Modes",
    "PathError",
    "PercussError",
    "PercussWarning",
    "Potential",
    "Result",
    "Review",
    "Scenario",
    "ScenarioError",
    "Sensitivity",
    "Study",
    "StudyError",
    "Sweep",
    "__version__",
    "check",
    "converge",
    "fit",
    "function",
    "load",
    "modes",
    "openturns",
    "run",
    "sensitivity",
    "static",
    "sweep",
]
