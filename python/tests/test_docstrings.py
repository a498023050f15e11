"""What the docstrings of the package promise: every public item has the sections that apply to it, and every example runs."""

from __future__ import annotations

import doctest
import inspect
import re
from collections.abc import Iterator
from functools import cached_property
from typing import Any

import book_files
import numpy as np
import pytest

import percuss
from percuss import _fields, _percuss, _plot, _scene, _structure, _view

REACHED = (
    _plot.Plots, _fields.Fields, _scene.SceneBeam, _scene.Curve, _scene.Contact, _structure.Shapes, _structure.Beams, _view.TableView, _view.ListView,
)  # fmt: skip
"""Classes that nobody imports, and everybody gets from a result or a scenario."""
MADE = (percuss.Scenario, percuss.Potential, percuss.Function, percuss.Measured, percuss.Study)
"""Classes whose objects users make themselves."""
CALLED = ("__call__", "__getitem__")
"""Special methods that do more than their names say."""
SECTIONS = ("Parameters", "Attributes", "Returns", "Raises", "Examples")
NUMBERS = re.compile(r"\b(ndarray|float|DataArray)\b")
UNIT = re.compile(r"\[[^\[\]]+\]")
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def sections(text: str) -> dict[str, str]:
    """A docstring by its headings; what stands before them under ``""``."""
    parts = re.split(rf"^({'|'.join(SECTIONS)})\n-+$", inspect.cleandoc(text), flags=re.M)
    return {"": parts[0], **dict(zip(parts[1::2], parts[2::2]))}


def entries(section: str) -> dict[str, str]:
    """Names, or kinds, that stand at the margin, and what is said of them."""
    parts = re.split(r"^(\S.*)$", section, flags=re.M)
    out = {}
    for head, body in zip(parts[1::2], parts[2::2]):
        for name in head.split(" : ")[0].split(", "):
            out[name.lstrip("*")] = head.partition(" : ")[2] + body
    return out


def parameters(code: Any) -> list[str]:
    names = list(inspect.signature(code).parameters)
    return [name for name in names if name not in ("self", "cls", "slf")]


def is_property(item: Any) -> bool:
    return isinstance(item, (property, cached_property)) or inspect.isgetsetdescriptor(item)


def members(of: type) -> Iterator[tuple[str, Any]]:
    """Public members of a class that the package defines."""
    for base in of.__mro__:
        if base.__module__.partition(".")[0] != "percuss":
            continue
        for name, member in vars(base).items():
            plain = member.__func__ if isinstance(member, (classmethod, staticmethod)) else member
            if (name.startswith("_") and name not in CALLED) or not (callable(plain) or is_property(plain)):
                continue
            if base is not _percuss.Study and name in CALLED and not inspect.isfunction(plain):
                continue
            yield f"{base.__name__}.{name}", plain


def public() -> dict[str, Any]:
    """Everything that users can call or ask."""
    out: dict[str, Any] = {}
    for name in (*percuss.__all__, "open"):
        item = getattr(percuss, name)
        if name != "__version__":
            out[name] = item
        if isinstance(item, type):
            out.update(members(item))
    for item in REACHED:
        out[item.__name__] = item
        out.update(members(item))
    return out


def native() -> dict[str, Any]:
    """Functions of the native module, which the package calls."""
    return {f"_percuss.{name}": item for name, item in vars(_percuss).items() if inspect.isbuiltin(item)}


# In one order: members of a native class come in another one in each process, and tests that are shared out need the same.
ITEMS = dict(sorted({**public(), **native()}.items()))


def said_of(item: Any) -> str:
    return inspect.cleandoc(getattr(item, "__doc__", None) or "")


def faults(item: Any) -> list[str]:
    """What a docstring lacks."""
    text = said_of(item)
    parts = sections(text)
    out = []
    if not re.match(r"[^\n]+[.:)]($|\n\n)|[^\n]+\n[^\n]", parts[""].strip() + "\n\n"):
        out.append("no summary that ends")
    if ">>> " not in parts.get("Examples", ""):
        out.append("no Examples")
    if isinstance(item, type):
        known = entries(parts.get("Attributes", ""))
        out += [f"Attributes: {name}" for name in getattr(item, "_fields", ()) if name not in known]
        wanted = parameters(item) if item in MADE else []
    elif is_property(item):
        wanted = []
        out += [] if "Returns" in parts else ["no Returns"]
    else:
        wanted = parameters(item)
        out += returns(item, parts)
    named = entries(parts.get("Parameters", ""))
    out += [f"Parameters: {name}" for name in wanted if name not in named]
    out += [f"Parameters: {name} is none" for name in named if name not in wanted]
    for section in ("Returns", "Attributes"):
        for kind, about in entries(parts.get(section, "")).items():
            if NUMBERS.search(f"{kind} {about.splitlines()[0]}") and not UNIT.search(about):
                out.append(f"{section}: {kind} without a unit in brackets")
    return out


def returns(item: Any, parts: dict[str, str]) -> list[str]:
    """What is missing of what a function gives and raises."""
    if not inspect.isfunction(item):
        return [] if "Returns" in parts or "Nothing is returned" in parts[""] else ["no Returns"]
    out = []
    if item.__annotations__.get("return") not in (None, "None") and "Returns" not in parts:
        out.append("no Returns")
    if re.search(r"^\s+raise \S", inspect.getsource(item), re.M) and "Raises" not in parts:
        out.append("no Raises")
    return out


@pytest.mark.parametrize("name", ITEMS)
def test_a_public_item_says_what_it_takes_gives_and_raises(name):
    assert not faults(ITEMS[name]), f"{name}: {faults(ITEMS[name])}"


def example(text: str, names: dict[str, Any], title: str) -> doctest.DocTest:
    """The examples of a docstring, which may use ``names``."""
    return doctest.DocTestParser().get_doctest(text, {"percuss": percuss, "np": np, **names}, title, title, 0)


@pytest.fixture(scope="module")
def found(tmp_path_factory) -> percuss.Fit:
    """``found`` in the examples of parts of a fit: the one of its class."""
    folder = tmp_path_factory.mktemp("fit")
    book_files.write(folder)
    made = example(said_of(percuss.Fit), {}, "Fit")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        doctest.DocTestRunner(optionflags=FLAGS).run(made, out=lambda _: None, clear_globs=False)
    return made.globs["found"]


@pytest.mark.parametrize("name", ["percuss", *ITEMS])
def test_examples_run(name, tmp_path, monkeypatch, request):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    if name == "openturns":
        pytest.importorskip("openturns")
    book_files.write(tmp_path)
    monkeypatch.chdir(tmp_path)
    names = {"found": request.getfixturevalue("found")} if name.startswith("Fit") and name != "Fit" else {}
    test = example(said_of(ITEMS.get(name, percuss)), names, name)
    said: list[str] = []
    ran = doctest.DocTestRunner(optionflags=FLAGS).run(test, out=said.append)
    pyplot.close("all")
    assert ran.attempted > 0 and ran.failed == 0, "".join(said)


def test_nothing_public_is_forgotten():
    """What is looked at: classes, functions, methods, properties; more only join."""
    kinds = [is_property(item) for item in ITEMS.values()]
    assert sum(kinds) >= 40 and len(kinds) - sum(kinds) >= 100
    assert {"run", "Result.plot", "Columns.get", "Study.run_shard", "Fields.stress", "_percuss.run"} <= set(ITEMS)
    assert not [name for name, item in vars(percuss).items() if callable(item) and not name.startswith("_") and name not in {*percuss.__all__, "open"}]


def test_missing_parts_of_docstrings_are_found():
    def bare(mass: float, speed: float) -> float:
        """Momentum.

        Parameters
        ----------
        mass : float
            The mass [kg].
        force : float
            Not there [N].

        Returns
        -------
        float
            The momentum.
        """
        if mass < 0:
            raise ValueError(mass)
        return mass * speed

    assert faults(bare) == [
        "no Examples", "no Raises", "Parameters: speed", "Parameters: force is none", "Returns: float without a unit in brackets",
    ]  # fmt: skip
