"""scripts/sensitivity does this."""

import json
import os
import re
import shutil
import subprocess
import sys
import threading
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
WORK = ROOT / "target" / "sensitivity"
TREE = WORK / "tree"
KEPT = ROOT / "docs" / "book" / "noticed.json"
"""Cases that hold without a mistake, and those that notice each."""
PAGE = ROOT / "docs" / "book" / "src" / "verification" / "sensitivity.md"
LIST = ROOT / "docs" / "book" / "mutations.toml"
CATALOGUE = ROOT / "crates" / "percuss-verification" / "src"
CORE = Path("crates") / "percuss" / "src"
BUILD = ("--release", "-p", "percuss-verification", "--example", "cases")
# A mistake may keep an iteration from ending: what has not ended by then has noticed.
LONGEST = 600.0


def copied() -> None:
    """The sources as they stand in the repository; what has not changed keeps its time, and is not built again."""
    TREE.mkdir(parents=True, exist_ok=True)
    listed = subprocess.run(["git", "ls-files", "-z", "crates", "benches", "Cargo.toml", "Cargo.lock"], cwd=ROOT, check=True, capture_output=True)
    for name in filter(None, listed.stdout.decode().split("\0")):
        old, new = ROOT / name, TREE / name
        if not old.exists() or (new.exists() and new.read_bytes() == old.read_bytes()):
            continue
        new.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(old, new)


def mutated(mutation: dict) -> None:
    for name, search, replace in mutation["edits"]:
        path = TREE / CORE / name
        text = path.read_text()
        if text.count(search) != 1:
            sys.exit(f"{mutation['id']}: {text.count(search)} places in {name} with {search!r}, expected one")
        path.write_text(text.replace(search, replace))


def outcomes() -> dict[str, list[str]]:
    """Word, comparisons that do not hold, comparisons in all, and the first that does not, by case."""
    environment = {**os.environ, "CARGO_TARGET_DIR": str(WORK / "target"), "CARGO_INCREMENTAL": "0"}
    subprocess.run(["cargo", "build", "--quiet", *BUILD], cwd=TREE, env=environment, check=True, stderr=subprocess.DEVNULL)
    program = WORK / "target" / "release" / "examples" / "cases"
    running = subprocess.Popen([program], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    late = threading.Timer(LONGEST, running.kill)
    late.start()
    assert running.stdout is not None
    lines = [line.rstrip("\n").split("\t") for line in running.stdout]
    running.wait()
    late.cancel()
    return {line[0]: line[1:] for line in lines if len(line) >= 4}


def noticed(found: dict[str, list[str]], sound: list[str]) -> list[str]:
    """Cases that do not hold any more, or do not end."""
    return [case for case in sound if found.get(case, ["endless"])[0] != "holds"]


def catalogue() -> list[str]:
    """Names of all cases, as the sources have them."""
    files = [CATALOGUE / "catalogue.rs", *(CATALOGUE / "catalogue").glob("*.rs")]
    return sorted(name for path in files for name in re.findall(r'\bid: "([^"]+)"', path.read_text()))


def table(mutations: list[dict], kept: dict) -> str:
    measured = [m for m in mutations if m["id"] in kept]
    rows = []
    for mutation in measured:
        cases = kept[mutation["id"]]
        names = ", ".join(f"`{case}`" for case in cases) or "none"
        rows.append(f"| {mutation['what']} | {len(cases)} | {names} |")
    blind = [m["what"] for m in measured if not kept[m["id"]]]
    never = [case for case in kept["sound"] if not any(case in kept[m["id"]] for m in measured)]
    newer = [case for case in catalogue() if case not in kept["sound"]]
    later = [m["what"] for m in mutations if m not in measured]
    head = [
        f"Measured: {len(measured)} mistakes, {len(kept['sound'])} cases; {len(measured) - len(blind)} of the mistakes are noticed.",
        "",
        "| Mistake | Cases | Which |",
        "|---|---:|---|",
    ]
    tail = ["", "Noticed by none: " + ("; ".join(blind) if blind else "no mistake of the list") + "."]
    tail += ["", f"Cases that notice none of these mistakes ({len(never)}): " + ", ".join(f"`{case}`" for case in never) + "."]
    if newer:
        tail += ["", f"Cases added since ({len(newer)}): " + ", ".join(f"`{case}`" for case in newer) + "."]
    if later:
        tail += ["", "Not measured yet: " + "; ".join(later) + "."]
    return "\n".join(head + rows + tail)


def written(mutations: list[dict], kept: dict) -> None:
    page = PAGE.read_text()
    begin, end = "<!-- measured -->\n", "<!-- end -->"
    pattern = re.escape(begin) + ".*?" + re.escape(end)
    assert len(re.findall(pattern, page, re.S)) == 1
    PAGE.write_text(re.sub(pattern, lambda _: f"{begin}\n{table(mutations, kept)}\n\n{end}", page, flags=re.S))


def main(arguments: list[str]) -> None:
    mutations = tomllib.loads(LIST.read_text())["mutation"]
    kept = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    if arguments == ["--page"]:
        return written(mutations, kept)
    unknown = set(arguments) - {m["id"] for m in mutations}
    if unknown:
        sys.exit(f"no such mistake: {', '.join(sorted(unknown))}")
    copied()
    sound = outcomes()
    kept["sound"] = sorted(sound)
    broken = [case for case, (word, *_) in sound.items() if word != "holds"]
    if broken:
        sys.exit(f"without any mistake these do not hold: {', '.join(broken)}")
    print(f"sound: {len(kept['sound'])} cases hold", flush=True)
    for mutation in mutations:
        if arguments and mutation["id"] not in arguments:
            continue
        mutated(mutation)
        cases = kept[mutation["id"]] = noticed(outcomes(), kept["sound"])
        copied()
        KEPT.write_text(json.dumps(kept, indent=1) + "\n")
        print(f"{mutation['id']}: {len(cases)} cases: {' '.join(cases)}", flush=True)
    written(mutations, kept)


main(sys.argv[1:])
