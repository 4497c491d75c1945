"""The steps of a control cycle on the page "Execution model" and in the code."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
# The page contains the method serve(). For each mode, serveSources() calls this method.
CALLERS = {"serve": "serveSources"}


@pytest.mark.reads("docs/execution_model.rst", "src/main_control/MainController.cpp")
def test_the_page_lists_the_steps_of_a_cycle_in_the_order_of_their_calls() -> None:
    page = (ROOT / "docs/execution_model.rst").read_text(encoding="utf-8")
    section = page.partition("\nOne cycle\n")[2].partition("\nBetween the clock pulses")[0]
    steps = re.split(r"^\d+\. ", section, flags=re.MULTILINE)[2:]
    named = [match[1] for step in steps if (match := re.search(r":method:`\w+::(\w+)`", step))]
    code = (ROOT / "src/main_control/MainController.cpp").read_text(encoding="utf-8")
    body = code.partition("\nvoid MainController::cycle() {\n")[2].partition("\n}\n")[0]
    called = re.findall(r"^  (\w+)\(\);", body, re.MULTILINE)
    assert [CALLERS.get(name, name) for name in named] == called
