#!/usr/bin/env python3
"""Runs all fuzzers of the firmware several times, and prints a line of JSON after each round.

This program needs only the standard library. It can run on any worker, in the folder of the
project."""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import tempfile
from pathlib import Path
from typing import Any

FUZZERS = {"frames": "short inputs", "link": "the PC link", "robot": "the whole firmware"}
# Number of inputs in one run. The first fuzzer needs about 30 s of processor time. Each of the two
# other fuzzers needs about 5 s.
INPUTS = {"frames": 1_000_000, "link": 50_000, "robot": 1_000}
LONGEST_INPUT = {"frames": 24}  # bytes
LONGEST = 60  # time limit of an input [s]; most inputs need less than 0.02 s
CORPUS = Path("tests/fuzz/corpus")
MOST_OF_TEXT = 2_000
# In the output, one line states the cause of a failure. The lines before this line show the
# progress, and the lines after this line show the calls.
CAUSE = re.compile(r"^.*(the fuzzer found|runtime error:|ERROR: ).*$", re.MULTILINE)


def fuzz(program: Path, name: str, seed: int, inputs: int) -> dict[str, Any]:
    """Runs a fuzzer. If an input reaches new code, the fuzzer stores this input in a folder. The
    folder is removed after the run."""
    with tempfile.TemporaryDirectory() as corpus, tempfile.TemporaryDirectory() as failed:
        words = [program, f"-seed={seed % (1 << 32) or 1}", f"-runs={inputs}"]
        words += [f"-timeout={LONGEST}"]
        words += [f"-max_len={LONGEST_INPUT[name]}"] if name in LONGEST_INPUT else []
        words += [f"-artifact_prefix={failed}/", corpus, CORPUS / name]
        run = subprocess.run(
            [str(word) for word in words],
            stdin=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
            check=False,
        )
        done = re.findall(r"^(?:#|Done )(\d+)", run.stderr, re.MULTILINE)
        tried = max(map(int, done), default=0)
        result: dict[str, Any] = {"fuzzer": name, "inputs": tried, "failure": None}
        if run.returncode != 0:
            result["failure"] = {
                "text": cause_in(run.stderr),
                "input": [path.read_bytes().hex() for path in sorted(Path(failed).iterdir())],
            }
        elif result["inputs"] < inputs:
            raise SystemExit(f"{program} ended after {result['inputs']} of {inputs} inputs")
        return result


def cause_in(output: str) -> str:
    """Returns the output of a failed fuzzer, from the cause of the failure on. If no cause is
    found, returns the end of the output. The result has at most MOST_OF_TEXT characters."""
    match = CAUSE.search(output)
    return output[match.start() :][:MOST_OF_TEXT] if match else output[-MOST_OF_TEXT:]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    for name, does in FUZZERS.items():
        parser.add_argument(f"--{name}", type=Path, required=True, help=f"fuzzer of {does}")
    parser.add_argument("--seed", type=int, required=True, help="chooses the inputs")
    parser.add_argument("--count", type=int, required=True, help="number of runs")
    options = parser.parse_args()
    for number in range(options.count):
        seed = options.seed * 1_000 + number
        programs = {name: getattr(options, name).resolve() for name in FUZZERS}
        runs = [fuzz(program, name, seed, INPUTS[name]) for name, program in programs.items()]
        print(json.dumps({"runs": runs}), flush=True)


if __name__ == "__main__":
    main()
