"""Percuss: impact on geometrically exact beams, with balances that close.

    import percuss

    scenario = percuss.load("plank.toml")
    scenario["projectile.mass.velocity"] = [0, "30 m/s"]
    result = percuss.run(scenario)
    result["contact.mass.force"].max()
    result.plot()
    percuss.open("runs/plank").plot.energy()

Names and units are those of the scenario file; a bare number is SI.
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
    PercussError,
    PercussWarning,
    ScenarioError,
    StudyError,
)
from ._function import Function, function
from ._function import openturns_function as openturns
from ._given import Potential
from ._load import check, load
from ._percuss import VERSION as __version__
from ._percuss import Study
from ._result import Result
from ._review import Advice, Review
from ._run import open, run
from ._scenario import Scenario
from ._sensitivity import Sensitivity, sensitivity
from ._study import Sweep
from ._sweep import sweep

__all__ = [
    "Advice",
    "AnalysisError",
    "Convergence",
    "Convergences",
    "Equilibrium",
    "Fault",
    "FileError",
    "Function",
    "InputError",
    "MissingError",
    "MissingRunError",
    "Modes",
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
    "function",
    "load",
    "modes",
    "open",
    "openturns",
    "run",
    "sensitivity",
    "static",
    "sweep",
]
