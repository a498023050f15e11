"""What is printed: every number of the story and of the table is one of the summary or of the history, to its digits, and none is round-off.

Numbers are parsed with their units. Those of known sentences are held against what the history gives; all others must be found
among the numbers of the summary and their sums.
"""

import math
import re

from .results import Run, contacts, differs, events, outside

PREFIX = {"p": 1e-12, "n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12}
UNITS = ["N m s", "N m", "N s", "m/s", "rad/s", "rad", "Pa", "1/m", "kg", "N", "J", "s", "m", "%"]
NUMBER = r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
QUANTITY = re.compile(rf"(?<![\w@.-])({NUMBER}) (?:([pnµmkMGT]?)({'|'.join(map(re.escape, UNITS))}))(?![\w/])")
# The story has four digits, the table five: half a unit in the last of them, relative to the number, at most.
STORY, TABLE = 0.5e-3, 0.5e-4
# Below this share of the largest of its kind in the run a number is round-off (docs/results.md: residuals below 1e-10 are closed balances).
ROUND_OFF = 1e-10


def check(run: Run) -> list[str]:
    story, table = story_and_table(run)
    if not table:
        return ["the terminal has no table"]
    known = numbers(run)
    out = sentences(run, story)
    out += strangers(story, known, STORY, "story") + strangers(without_hand(table), known, TABLE, "table")
    return out + round_off(run, story, "story") + round_off(run, without_hand(table), "table") + by_hand(run)


def story_and_table(run: Run) -> tuple[str, str]:
    """What the terminal shows behind the title: some sentences, and lines from `status` to `results`."""
    shown = run.text.split(f"{run.scene['title']}\n", 1)[-1].split("\n  results", 1)[0]
    story, _, table = shown.partition("\n  status")
    return " ".join(story.split()), "  status" + table if table else ""


def without_hand(table: str) -> str:
    """The table without residuals, and without what comes from elsewhere: times of computing, formulas."""
    rows, label = [], ""
    for line in table.splitlines():
        if line[2:3].strip():
            label = line[2:].split("  ")[0]
        if label not in ("hand formulas", "strain drift", "momentum") and "Newton iteration" not in line:
            rows.append(line)
    return "\n".join(rows)


def quantities(text: str) -> list[tuple[float, str, str]]:
    """Value in SI, unit and the words of every quantity; `m` stands for a metre unless a unit follows it."""
    return [(float(number) * PREFIX[prefix], unit, f"{number} {prefix}{unit}") for number, prefix, unit in QUANTITY.findall(text)]


def numbers(run: Run) -> list[float]:
    """All numbers of the summary by size, and sums that are told of them."""
    found: list[float] = []
    collect(run.summary, found)
    for _, contact in contacts(run):
        rested = math.fsum(one["impulse"] for one in contact["intervals"])
        found += [rested, math.fsum(one["impulse"] for one in events(contact)) - rested]
    energy = run.summary["energy"]
    found.append(energy["loss_damping"] - energy["loss_contacts"])
    for one in list(run.summary["plastic"].values()) + list(run.summary["yielding"].values()):
        found.append(one["dissipated"] - one.get("dissipated_by_preload", 0.0))
        found.append(math.hypot(*(one.get("permanent_set_at") or {}).get("displacement", [0.0])))
    return sorted(abs(x) for x in found)


def collect(value, found: list[float]) -> None:
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for one in value:
            collect(one, found)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        found.append(float(value))


def strangers(text: str, known: list[float], digits: float, where: str) -> list[str]:
    """Numbers that are none of the run."""
    out = []
    for value, _, words in quantities(text):
        near = min((abs(abs(value) - x) for x in known), default=math.inf)
        # Numbers with an exponent have four digits everywhere.
        if near > max(digits, 5e-4 if "e" in words else 0.0) * abs(value) * 1.01 + 1e-300:
            out.append(f"{where}: {words} is no number of the run")
    return out


def round_off(run: Run, text: str, where: str) -> list[str]:
    """Numbers that are round-off beside the largest of their kind, and instants that are none beside a step."""
    scale = scales(run)
    out = []
    for value, unit, words in quantities(text):
        # An energy is told wherever the balance is finer than it.
        share = max(1e-13, run.summary["energy"]["residual_max"]) if unit == "J" else ROUND_OFF
        if unit in scale and 0 < abs(value) < share * scale[unit]:
            out.append(f"{where}: {words} is round-off of {scale[unit]:.3g} {unit}")
        if unit == "s" and 0 < value < 1e-3 * run.step:
            out.append(f"{where}: {words} is an instant of less than a thousandth of a step")
    return out


def scales(run: Run) -> dict[str, float]:
    """The largest of each kind in the run."""
    endings = {"N": ("force", "force_1", "force_2", "axial", "shear"), "m/s": ("velocity_1", "velocity_2"), "N m": ("moment",)}
    found = {
        unit: max((run.largest(name) for name in run.columns if name.split(".")[-1] in last), default=0.0)
        for unit, last in endings.items()
    }
    return found | {"J": run.energy_scale(), "N s": run.summary["momentum"]["linear_scale"]}


def quantity_after(story: str, words: str) -> float | None:
    """The first quantity behind some words."""
    behind = story.split(words, 1)
    found = quantities(behind[1]) if len(behind) > 1 else []
    return found[0][0] if found else None


def sentences(run: Run, story: str) -> list[str]:
    """Known sentences against the history."""
    out = []
    force = quantity_after(story, "Peak contact force")
    if force is not None:
        rows = [run.largest(name) for name in run.columns if name.startswith("contact.") and name.endswith(".force")]
        told = [c["peak_force"]["value"] or 0.0 for _, c in contacts(run) if "peak_force" in c]
        out += outside("story: the contact force", force, max(rows) * (1 - STORY), max(told) * (1 + STORY))
    moved = re.search(r"Largest displacement.*?:", story)
    if moved:
        size = abs(quantity_after(story, moved.group()) or 0.0)
        rows = [run.largest(name) for name in run.columns if ".displacement_" in name]
        out += outside("story: the largest displacement", size, max(rows) * (1 - STORY), math.inf)
    moment = quantity_after(story, "Peak bending moment:")
    if moment is not None:
        rows = [run.largest(name) for name in run.columns if name.startswith("section.") and name.endswith(".moment")]
        out += outside("story: the largest moment", moment, max(rows, default=0.0) * (1 - STORY), math.inf)
    return out + parting(run, story) + touching(run, story) + counted(run, story)


def parting(run: Run, story: str) -> list[str]:
    """Bodies that separate do so at that velocity."""
    told = quantity_after(story, "with a separation velocity of")
    if told is None:
        return []
    speeds = [event["separation_velocity"] or 0.0 for _, contact in contacts(run) for event in events(contact)]
    nearest = min(speeds, key=lambda v: abs(abs(v) - told))
    return outside(f"story: separation velocity of {told:.4g} m/s", nearest, told * (1 - STORY), told * (1 + STORY))


def touching(run: Run, story: str) -> list[str]:
    """The story says of the end what the summary says."""
    closed = [name for name, contact in contacts(run) if any(one["end"] is None for one in contact["intervals"])]
    if "The contact is closed at the end" in story and not closed:
        return ["story: closed at the end, though no contact is"]
    if re.search(r"The contact did not close\.|None of the \d+ contacts closed\.", story) and any(events(contact) for _, contact in contacts(run)):
        return ["story: no contact closed, though contacts did"]
    return []


def counted(run: Run, story: str) -> list[str]:
    """Impacts and their impulse are those of one contact."""
    told = re.search(rf"(\d+) impacts, total impulse ({NUMBER}) ([pnµmk]?)N s", story)
    if not told:
        return []
    count, impulse = int(told[1]), float(told[2]) * PREFIX[told[3]]
    right = [(len(c["impacts"]), math.fsum(one["impulse"] for one in c["impacts"])) for _, c in contacts(run) if "impacts" in c]
    same = [n for n, total in right if n == count and abs(total - impulse) <= STORY * abs(total) * 1.01]
    return [] if same else [f"story: {count} impacts of {impulse:.4g} N s, right one of {right}"]


def by_hand(run: Run) -> list[str]:
    """Hand formulas: the difference is that of the two numbers, and what is called an upper bound is one."""
    out = []
    for one in run.summary["hand_formulas"]:
        hand, simulated = one["by_hand"], one["simulated"]
        right = 100 * (simulated - hand) / hand if hand else 0.0
        out += differs(f"difference of {one['formula']}", one["difference_percent"], right, 1e-6 * abs(right) + 1e-9)
        if "upper bound" in one["formula"]:
            out += outside(f"{one['formula']}, {one['quantity']}", abs(simulated), 0.0, abs(hand) * 1.01)
    return out
