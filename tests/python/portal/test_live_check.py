"""A page that cannot run the robot shows the reason, and disables the button."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[3] / "site/theme/static/live/can_run.js"
NODE = """
globalThis.location = { protocol: process.argv[2] };
globalThis.Worker = class {};
const parts = { "[data-go]": {}, "[data-result], [data-detail]": {} };
const place = { hidden: true, querySelector: (selector) => parts[selector] };
const runs = require(process.argv[1]).shows(place);
const [button, result] = Object.values(parts);
const { disabled = false } = button;
const { textContent = "" } = result;
process.stdout.write(JSON.stringify([runs, place.hidden, disabled, textContent]));
"""
REASON = (
    "The robot cannot run here: a page that was opened as a file cannot load the virtual board; "
    "serve the pages with ./wr serve."
)


@pytest.mark.skipif(shutil.which("node") is None, reason="Node is not installed")
@pytest.mark.parametrize(
    ("protocol", "shown"),
    [("http:", [True, False, False, ""]), ("file:", [False, False, True, REASON])],
)
def test_a_page_that_cannot_run_the_robot_shows_the_reason(
    protocol: str, shown: list[object]
) -> None:
    command = ["node", "-e", NODE, str(SCRIPT), protocol]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    assert json.loads(run.stdout) == shown
