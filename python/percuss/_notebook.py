"""Results in notebooks."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING

from . import _percuss
from ._words import engineering

if TYPE_CHECKING:
    from ._result import Result


def shown(result: Result) -> str:
    """A result in a notebook: the animated scene and the main results."""
    rows = "".join(f"<tr><th>{escape(what)}</th><td>{escape(value)}</td></tr>" for what, value in _facts(result))
    title = escape(result.summary["title"] or "percuss run")
    return f"{_scene(result)}<table><caption><b>{title}</b></caption><tbody>{rows}</tbody></table>"


def _scene(result: Result) -> str:
    """The scene in motion, in a frame of its own: its scripts and styles touch nothing else of the notebook."""
    fields = result._native["fields"]
    page = _percuss.scene_page(fields, result._native["summary"]) if fields is not None else None
    if page is None:
        return ""
    return (
        f'<iframe srcdoc="{escape(page)}" sandbox="allow-scripts allow-downloads" title="The scene in motion" '
        'style="width: 100%; height: 560px; border: 0"></iframe>'
    )


def _facts(result: Result) -> Iterator[tuple[str, str]]:
    """The main results."""
    run = result.summary
    yield "status", f"{_percuss.state(result._native['summary'])}, {run['steps']} steps"
    if "error" in run:
        yield "error", f"{run['error']} [{run['error_code']}]" if "error_code" in run else run["error"]
    energy, momentum = run["energy"], run["momentum"]
    yield "energy", f"{engineering(energy['initial'], 'J')} to {engineering(energy['final'], 'J')}"
    yield (
        "balance, residuals (relative)",
        f"energy {energy['residual_max']:.1e}, linear momentum {momentum['linear_residual_max']:.1e}, "
        f"angular {momentum['angular_residual_max']:.1e}",
    )
    for name, contact in run["contact"].items():
        if "peak_force" in contact and contact["peak_force"]["value"] is not None:
            peak = contact["peak_force"]
            yield f"contact {name}", f"peak force {engineering(peak['value'], 'N')} at {engineering(peak['time'], 's')}"
        elif "impact_count" in contact:
            yield f"contact {name}", f"{contact['impact_count']} impacts"
    for name, point in run["point"].items():
        peaks = [point["displacement_max"][f"component_{i}"]["value"] or 0.0 for i in (1, 2)]
        # Beside the larger one, round-off is nothing.
        shown = [engineering(peak if abs(peak) > 1e-9 * max(map(abs, peaks)) else 0.0, "m") for peak in peaks]
        yield f"point {name}", f"largest displacements {shown[0]} in x, {shown[1]} in y"
    yield "history", f"{len(result)} rows, {len(result.columns)} columns"
