"""What the tests share."""

import sys
from pathlib import Path

import matplotlib
import pytest

import percuss

matplotlib.use("Agg")

ROOT = Path(__file__).parents[2]
SCENARIOS = ROOT / "scenarios"


@pytest.fixture
def elastic() -> percuss.Scenario:
    """The paper's elastic example, shorter."""
    scenario = percuss.load(SCENARIOS / "paper" / "elastic-clamped.toml")
    scenario["time.end"] = "40 ms"
    return scenario


@pytest.fixture
def rigid() -> percuss.Scenario:
    """The paper's rigid example."""
    return percuss.load(SCENARIOS / "paper" / "rigid-clamped-e1.toml")


@pytest.fixture
def study(elastic: percuss.Scenario) -> dict:
    """A small study of it."""
    elastic["time.step"] = "1 ms"
    return {
        "title": "speed",
        "scenario": elastic,
        "parameters": {
            "speed": {
                "path": "projectile.mass.velocity[1]",
                "distribution": {"kind": "uniform", "from": "10 m/s", "to": "30 m/s"},
            }
        },
        "design": {"kind": "latin-hypercube", "runs": 100},
        "results": {"peak_force": "contact.mass.peak_force.value", "exit": "projectile.mass.velocity_final[1]"},
    }


def python() -> str:
    """The interpreter that runs the tests."""
    return sys.executable
