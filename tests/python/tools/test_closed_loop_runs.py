"""The scenarios of the page "Control performance". Two small scripts replace the programs that play
the scenarios: weeding_robot_host and weeding_robot_board."""

import json
import sys
from pathlib import Path

import pytest

from tools import closed_loop_runs
from tools.task_graph import Outcome
from traceability.schema import HOST, VIRTUAL_K64

PROGRAM = f"""#!{sys.executable}
import sys
options = sys.argv[1:]
scenario = open(options[options.index("--scenario") + 1]).read()
with open(options[options.index("--reports") + 1], "w") as file:
    file.write(("board" if "--image" in options else "host") + "\\n")
if "fails" in scenario:
    print("here: it fails", file=sys.stderr)
    sys.exit(1)
"""


@pytest.fixture
def root(tmp_path: Path) -> Path:
    (tmp_path / "design").mkdir()
    (tmp_path / "design/closed_loop.toml").write_text(
        '[[scenario]]\nname = "one"\ntitle = "One"\nsays = "It is the one."\n'
    )
    for folder in ("build/results", "build/host/sim", "build/k64", "sim/scenario/examples"):
        (tmp_path / folder).mkdir(parents=True)
    for name in ("weeding_robot_host", "weeding_robot_board"):
        program = tmp_path / "build/host/sim" / name
        program.write_text(PROGRAM)
        program.chmod(0o755)
    (tmp_path / "build/k64/weeding_robot_paper.bin").write_bytes(b"image")
    (tmp_path / "sim/scenario/examples/one.scenario").write_text("holds\n")
    return tmp_path


def outcomes(root: Path) -> dict[str, dict[str, dict[str, object]]]:
    found: dict[str, dict[str, dict[str, object]]] = json.loads(
        (root / "build/results/closed_loop.json").read_text()
    )["runs"]
    return found


def test_each_scenario_is_played_on_both_bindings(root: Path) -> None:
    assert closed_loop_runs.play_all(root, sys.stdout) == Outcome("1 scenarios")
    assert (root / "build/results/closed_loop/one-host.csv").read_text() == "host\n"
    assert (root / "build/results/closed_loop/one-k64.csv").read_text() == "board\n"
    passed = {"passed": True, "said": "", "stack": None}
    assert outcomes(root) == {"one": {HOST: passed, VIRTUAL_K64: passed}}


def test_an_expectation_that_fails_is_told_and_kept(root: Path) -> None:
    (root / "sim/scenario/examples/one.scenario").write_text("fails\n")
    outcome = closed_loop_runs.play_all(root, sys.stdout)
    assert outcome.failed
    assert "one (host), one (virtual K64)" in outcome.note
    told = {"passed": False, "said": "here: it fails", "stack": None}
    assert outcomes(root)["one"][HOST] == told
