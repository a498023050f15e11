"""The types that the package declares."""

import subprocess
import sys

GOOD = """
import percuss
from numpy.typing import NDArray
import numpy as np
scenario = percuss.load("a.toml")
result: percuss.Result = percuss.run(scenario, progress=False)
force: NDArray[np.float64] = result["contact.mass.force"]
limit: float = percuss.converge(scenario)["step"].limit
"""
BAD = "import percuss\nx: int = percuss.run('a.toml').time\n"


def mypy(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "mypy", *arguments], capture_output=True, text=True)


def test_the_package_is_typed_strictly():
    checked = mypy("--strict", "--ignore-missing-imports", "--untyped-calls-exclude=distributed", "-p", "percuss")
    assert checked.returncode == 0, checked.stdout


def test_users_are_warned_of_wrong_types(tmp_path):
    (tmp_path / "good.py").write_text(GOOD)
    (tmp_path / "bad.py").write_text(BAD)
    assert mypy(str(tmp_path / "good.py")).returncode == 0
    assert "Incompatible types" in mypy(str(tmp_path / "bad.py")).stdout
