"""./wr campaign fuzz, with stubs in place of the fuzzers: the cases of the campaign, and the totals
of its record."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tools.campaign.fuzz import NAMES, PROGRAM, options, summarise
from tools.campaign.fuzz_program import INPUTS
from traceability.reading.published import Published, campaign_metrics

pytestmark = pytest.mark.runs_tools

SOURCE = Path(__file__).resolve().parents[3]
# Prints the same lines as libFuzzer. If ``fails`` is true and the seed is 2000, the fuzzer fails at
# input 17.
FUZZER = """#!{python}
import sys
words = dict(word[1:].split("=", 1) for word in sys.argv[1:] if word.startswith("-"))
if {fails} and words["seed"] == "2000":
    open(words["artifact_prefix"] + "crash-1", "wb").write(b"\\x01\\xff")
    calls = ["    #1 call"] * 1000
    print("#17\\tNEW", "==1==ERROR: overflow", *calls, file=sys.stderr, sep="\\n")
    sys.exit(77)
print("#2\\tINITED", "Done " + words["runs"] + " runs in 1 second(s)", file=sys.stderr, sep="\\n")
"""


def run(folder: Path, seed: int, *, fails: bool) -> list[dict[str, Any]]:
    for name in INPUTS:
        program = folder / name
        text = FUZZER.format(python=sys.executable, fails=fails and name == "link")
        program.write_text(text, encoding="utf-8")
        program.chmod(0o755)
    words = [*options([PROGRAM, *(folder / name for name in NAMES)]), "--count", 2, "--seed", seed]
    done = subprocess.run(
        [str(word) for word in (sys.executable, SOURCE / PROGRAM, *words)],
        cwd=folder,
        check=True,
        capture_output=True,
        text=True,
    )
    return [json.loads(line) for line in done.stdout.splitlines()]


def test_a_run_without_failure_counts_its_inputs(tmp_path: Path) -> None:
    summary = summarise(tmp_path, run(tmp_path, 1, fails=False))
    assert summary["inputs"] == {name: 2 * inputs for name, inputs in INPUTS.items()}
    assert summary["outcomes"] == {"inputs": 2 * sum(INPUTS.values()), "failures": 0}
    assert summary["failures"] == []


def test_a_failure_is_kept_with_its_input_and_its_text(tmp_path: Path) -> None:
    summary = summarise(tmp_path, run(tmp_path, 2, fails=True))
    assert summary["outcomes"]["failures"] == 1
    # 17 inputs of the chunk that fails, and all inputs of the other chunk
    assert summary["inputs"]["link"] == 17 + INPUTS["link"]
    (failure,) = summary["failures"]
    assert failure["fuzzer"] == "link"
    assert failure["input"] == ["01ff"]
    assert failure["text"].startswith("==1==ERROR: overflow\n    #1 call")


def test_the_metrics_are_those_of_the_record(tmp_path: Path) -> None:
    result = summarise(tmp_path, run(tmp_path, 2, fails=True))
    metrics = campaign_metrics({"fuzz": Published("./wr campaign fuzz", "c", "2026-01-01", result)})
    assert metrics["reliability.fuzz_inputs"]["value"] == result["outcomes"]["inputs"]
    assert metrics["reliability.fuzz_failures"]["value"] == 1
