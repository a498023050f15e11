"""What a notebook shows of results, in a real browser; scripts/check-browser installs what it needs."""

import os
import shutil
import subprocess
from pathlib import Path

import percuss
import pytest

from conftest import ROOT, SCENARIOS

PLAYWRIGHT = ROOT / "target" / "browser" / "node_modules" / "playwright-core"
BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


@pytest.mark.skipif(
    not (PLAYWRIGHT.is_dir() and BROWSER and shutil.which("node")),
    reason="no Chromium with playwright-core: scripts/check-browser installs them",
)
def test_two_results_play_in_one_page(elastic, tmp_path):
    shown = [percuss.run(scenario)._repr_html_() for scenario in (elastic, SCENARIOS / "disc-chain.toml")]
    page = tmp_path / "cells.html"
    page.write_text("<!doctype html><meta charset=utf-8><body>" + "".join(shown))
    environment = {**os.environ, "PAGE": str(page), "BROWSER": BROWSER, "PLAYWRIGHT": str(PLAYWRIGHT)}
    script = Path(ROOT, "crates", "percuss-output", "web", "browser", "notebook.mjs")
    done = subprocess.run(["node", script], env=environment, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
