"""Labels of columns on axes and in legends: words, with units."""

from __future__ import annotations

import math
from typing import NamedTuple

_QUANTITIES = {
    ("contact", "force"): "contact force",
    ("contact", "impulse"): "impulse",
    ("contact", "gap"): "gap",
    ("section", "axial"): "axial force",
    ("section", "shear"): "shear force",
    ("section", "moment"): "bending moment",
    ("support", "force"): "support force",
    ("support", "moment"): "support moment",
    ("disc", "angle"): "rotation",
    ("disc", "spin"): "angular velocity",
}
_ENERGIES = {
    "work_loads": "work of loads",
    "work_supports": "work of supports",
    "loss_impacts": "lost in impacts and friction",
    "loss_damping": "lost to damping and in contacts",
    "contact": "contacts",
}


class Words(NamedTuple):
    """A column in words."""

    quantity: str
    """What is measured: ``contact force``."""
    of: str
    """Of what: ``mass``, ``girder.mid, in y``."""

    @property
    def label(self) -> str:
        """Both."""
        return f"{self.quantity}: {self.of}" if self.of else self.quantity


def words(name: str) -> Words:
    """A column of the history in words."""
    kind, _, rest = name.partition(".")
    thing, _, quantity = rest.rpartition(".")
    along = ""
    for number, axis in (("1", "x"), ("2", "y")):
        if quantity.endswith(f"_{number}"):
            quantity, along = quantity[:-2], f"in {axis}"
    if kind == "energy":
        return Words("energy", _ENERGIES.get(quantity, quantity.replace("_", " ")))
    if kind == "momentum" and quantity in ("linear", "angular"):
        return Words(f"{quantity} momentum", along)
    if not rest:
        return Words(kind, "")
    plain = _QUANTITIES.get((kind, quantity), quantity.replace("_", " "))
    return Words(plain, ", ".join(part for part in (thing or kind, along) if part))


def position_label(axis: str, scale: float = 1.0) -> str:
    """Label of an axis of positions, with the factor on the displacements that are drawn."""
    return f"{axis} [m]" if scale == 1.0 else f"{axis} [m], displacements \u00d7 {scale:.3g}"


def unit_words(unit: str) -> str:
    """A unit as it is written: ``N*m`` is N m."""
    return unit.replace("*", " ").replace("^2", "\u00b2").replace("^3", "\u00b3")


def engineering(value: float, unit: str) -> str:
    """Five digits, as on the page: no prefix from 1 to 10 000, else a prefix of thousands.

    Velocities have none, nor have stresses and forces or stiffnesses per length below 1.
    """
    size = abs(float(f"{value:.5g}"))  # the prefix is that of the number as it is shown
    if size < 1e-12:
        return f"0 {unit}"
    prefixed = unit in ("s", "m", "N", "N s", "J", "N m") or (unit in ("Pa", "N/m", "N/m\u00b2") and size >= 1)
    if not prefixed or 1 <= size < 1e4:
        return f"{_five_digits(value)} {unit}"
    prefixes = [(1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "\u00b5"), (1e-9, "n"), (1e-12, "p")]
    by, prefix = next((by, p) for by, p in prefixes if size >= by)
    return f"{_five_digits(value / by)} {prefix}{unit}"


def _five_digits(value: float) -> str:
    """Plain where that is short, else with an exponent."""
    exponent = math.floor(math.log10(abs(value))) if value else 0
    if -4 <= exponent < 9:
        return f"{float(f'{value:.5g}'):.15g}"
    digits, power = f"{value:.3e}".split("e")
    return f"{float(digits):g}e{int(power)}"
