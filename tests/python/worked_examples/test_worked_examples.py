"""The worked examples of the page docs/how_these_pages_are_made.rst. Each example is applied to a
copy of the project, and tested in this copy."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.python.worked_examples.examples import PAGE, PYTHON, ROOT, apply, patches

pytestmark = [pytest.mark.runs_tools, pytest.mark.long]

SERIALIZATION = Path("src/communication/serialization")
PROGRAM = """\
#include <cstdio>
#include "communication/serialization/ReportMessage.hpp"
#include "communication/serialization/SerialWriter.hpp"
#include "sim/scenario/FrameFields.hpp"
int main() {
  wr::ReportData data;
  data.measurements.wheels[2].reversalLate = true;
  wr::SerialWriter writer;
  if (!wr::ReportMessage(data).writeTo(writer)) return 1;
  wr::scenario::Bytes body{2, 0x82, 0};
  for (const auto byte : writer.bytes()) {
    body.push_back(byte);
    std::printf("%02x", byte);
  }
  for (const char* name : {"reversal_late1", "reversal_late2"}) {
    std::printf(" %d", int(wr::scenario::valueOf(body, *wr::scenario::findField(name))));
  }
}
"""
CLIENT = """\
import sys
from weeding_robot_client.layout import LAYOUTS
values = LAYOUTS["Report"].decode(bytes.fromhex(sys.argv[1]))
print([values[f"reversal_late{wheel}"] for wheel in range(4)])
"""


def run(root: Path, *words: str | Path) -> str:
    env = os.environ | {"PYTHONPATH": os.pathsep.join(map(str, (root, root / "client")))}
    done = subprocess.run(words, cwd=root, env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 0, (
        f"an example no longer works; update {PAGE}: {done.stdout}{done.stderr}"
    )
    return done.stdout


def run_tests(root: Path, *words: str) -> None:
    run(root, sys.executable, "-m", "pytest", "-q", *words)


@pytest.fixture
def example(tmp_path: Path, request: pytest.FixtureRequest) -> Path:
    """Copies the sources, and applies an example of the page to this copy. Returns the copy. The
    Python files of the example must have no finding of ruff."""
    ignored = shutil.ignore_patterns("build", ".*", "__pycache__")
    root = Path(shutil.copytree(ROOT, tmp_path / "project", ignore=ignored))
    apply(root, request.param)
    files = [name for text in patches(request.param) for name in PYTHON.findall(text)]
    ruff = Path(sys.executable).with_name("ruff")
    for words in (["check"], ["format", "--check"]) if files else []:
        run(root, ruff, *words, "--no-cache", *files)
    return root


@pytest.mark.parametrize("example", ["example-check"], indirect=True)
def test_an_added_check_finds_something(example: Path) -> None:
    tests = ("test_unfinished", "test_registry")
    run_tests(example, *(f"tests/python/checks/{name}.py" for name in tests))
    wanted = "check_has_a or documents-1]"
    run_tests(example, "tests/python/tools/test_seed_faults.py", "-k", wanted)


@pytest.mark.parametrize("example", ["example-page"], indirect=True)
def test_an_added_kind_of_page_exists(example: Path) -> None:
    run_tests(example, "tests/python/portal/test_suites.py")


@pytest.mark.parametrize("example", ["one-more-field"], indirect=True)
def test_an_added_field_is_decoded_everywhere(example: Path) -> None:
    made = example / "made" / "sim" / "scenario"
    made.mkdir(parents=True)
    run(example, sys.executable, "sim/scenario/frame_table.py", made)
    (example / "program.cpp").write_text(PROGRAM, encoding="utf-8")
    parts = ("Serializable", "ReportMessage", "SerialWriter")
    message = [SERIALIZATION / f"{name}.cpp" for name in parts]
    compiler = ("g++", "-std=c++20", "-I.", "-Isrc", "-Itests", "-Imade")
    run(example, *compiler, "program.cpp", "sim/scenario/FrameFields.cpp", *message, "-oprogram")
    payload, *simulator = run(example, "./program").split()
    assert simulator == ["0", "1"]
    shown = run(example, sys.executable, "-c", CLIENT, payload)
    assert shown.strip() == "[False, False, True, False]"
    run(example, sys.executable, "tests/python/client/examples.py")
    files = ("frames", "messages", "layout", "capture")
    run_tests(example, *(f"tests/python/client/test_{name}.py" for name in files))
    test = "tests/communication/serialization/ReportMessageTest.cpp"
    libraries = ("-lgmock", "-lgtest", "-lgtest_main", "-pthread")
    run(example, *compiler, test, *message, *libraries, "-otests.out")
    run(example, "./tests.out")
