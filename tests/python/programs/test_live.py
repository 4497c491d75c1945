"""The WebAssembly module does all that the native virtual board does, byte by byte."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from tools.browser import find_browser, works
from tools.live_runs import Run, differences, examples, play_in_browser, play_in_node, play_native
from traceability.reading.live_record import MODULE

ROOT = Path(__file__).parents[3]

pytestmark = pytest.mark.skipif(
    not (ROOT / MODULE).exists(), reason="the module is not built: its compiler is not installed"
)


@pytest.fixture(scope="module")
def native() -> dict[str, Run]:
    return {scenario.stem: play_native(ROOT, scenario) for scenario in examples(ROOT)}


def compared(native: dict[str, Run], runs: list[dict[str, Any]]) -> dict[str, list[str]]:
    named = zip(native.items(), runs, strict=True)
    return {name: found for (name, own), run in named if (found := differences(own, run))}


@pytest.mark.skipif(shutil.which("node") is None, reason="there is no Node on this machine")
def test_each_example_is_the_same_in_node(native: dict[str, Run]) -> None:
    runs = play_in_node(ROOT, examples(ROOT))
    assert compared(native, runs) == {}
    assert {run["end"] for run in runs} == {"ended"}
    assert [run["failures"] for run in runs if run["failures"]] == []


def test_each_example_is_the_same_in_a_browser(native: dict[str, Run]) -> None:
    browser = find_browser()
    if browser is None or not works(browser):
        pytest.skip("there is no browser on this machine")
    result = play_in_browser(ROOT, browser, examples(ROOT))
    assert compared(native, result["runs"]) == {}
    assert min(run["factor"] for run in result["runs"]) > 1, "slower than the robot"


def test_another_byte_is_a_difference() -> None:
    own = Run(reports="a,b\n1,2\n", events=3, hash="00")
    same = {"reports": own.reports, "events": {"count": 3, "hash": "00"}}
    assert differences(own, same) == []
    assert differences(own, same | {"reports": "a,b\n1,3\n"}) == ["reports"]
    assert differences(own, same | {"events": {"count": 3, "hash": "01"}}) == ["events"]
