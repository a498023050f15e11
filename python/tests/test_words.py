"""Numbers and units in captions."""

import json
from pathlib import Path

from percuss._words import engineering, unit_words

CASES = Path(__file__).parents[2] / "crates/percuss-output/tests/quantities.json"


def test_quantities_are_those_of_the_page():
    """The same cases test the tables and the scripts of the page: a number that rounds up to the next prefix takes it."""
    cases = json.loads(CASES.read_text())
    assert len(cases) > 20
    for value, unit, shown in cases:
        assert engineering(value, unit_words(unit)) == shown
    # Round-off of a scene is zero.
    assert engineering(3e-17, "m") == "0 m"
