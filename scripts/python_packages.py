"""Packages that the Python package and its tests need, one a line, from pyproject.toml."""

import re
from pathlib import Path

text = (Path(__file__).parents[1] / "pyproject.toml").read_text()


def listed(name: str) -> list[str]:
    """The strings of a list; without tomllib, which Python 3.10 lacks."""
    body = re.search(rf"^{name} = \[\n?(.*?)\]\n", text, re.M | re.S).group(1)
    return re.findall(r'"([^"]+)"', body)


groups = re.findall(r"^(plot|progress|tables|dask|openturns|test|dependencies) = \[", text, re.M)
for name in groups:
    for package in listed(name):
        if not package.startswith("percuss") and "python_version" not in package:
            print(package.replace(" ", ""))
