"""The calls of a test, as the recorder in tests/support/trace.cpp records them."""

from __future__ import annotations

import subprocess
from array import array
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
FIRMWARE = """\
volatile int counted;
void leaf() { counted = counted + 1; }
void top(int leaves) { for (int i = 0; i < leaves; ++i) leaf(); }
void other() { leaf(); }
"""
TESTS = """\
#include <gtest/gtest.h>
void top(int leaves);
void other();
TEST(Calls, Repeated) {
  for (int i = 0; i < 50000; ++i) top(2);
  other();
  top(1);
  top(2);
  other();
}
TEST(Calls, Again) { top(2); }
TEST(Calls, Short) { for (int i = 0; i < 3; ++i) top(2); }
TEST(Calls, TooMany) { top(30000); }
"""
EXIT, REPEAT = 1 << 63, 1 << 62


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recorder")
    (folder / "firmware.cpp").write_text(FIRMWARE, encoding="utf-8")
    (folder / "tests.cpp").write_text(TESTS, encoding="utf-8")
    compiler = ["g++", "-std=c++20", "-O0"]
    noted = [*compiler, "-finstrument-functions", "-c", "firmware.cpp"]
    subprocess.run(noted, cwd=folder, check=True, timeout=60)
    words = ["tests.cpp", "firmware.o", str(ROOT / "tests/support/trace.cpp"), "-o", "tests"]
    words += [f'-DWR_TRACE_DIR="{folder}"', "-lgtest", "-lgtest_main", "-lpthread"]
    subprocess.run([*compiler, *words], cwd=folder, check=True, timeout=300)
    subprocess.run([folder / "tests"], cwd=folder, check=True, capture_output=True, timeout=60)
    return folder


def shape(folder: Path, test: str) -> str:
    """Returns the calls as brackets. Each function has a letter, in the order of appearance.

    A repeated call is shown as the number of the event at which the first equal call begins.
    """
    events: array[int] = array("Q")
    events.frombytes((folder / f"Calls.{test}.bin").read_bytes())
    letters: dict[int, str] = {}
    found = ""
    for event in events:
        if event & REPEAT:
            found += f" {event & ~REPEAT} "
            continue
        letter = letters.setdefault(event & ~EXIT, chr(ord("a") + len(letters)))
        found += ")" if event & EXIT else f"{letter}("
    return found


def test_a_long_recording_names_the_calls_that_do_the_same_again(recorded: Path) -> None:
    whole = shape(recorded, "Repeated")
    first = "a(b()b())" * 3334  # 20004 events, and then the number of the first event
    assert whole.startswith(first)
    assert whole.removeprefix(first) == " 0 c(b())a(b()) 0  20005 "


def test_a_short_recording_is_whole(recorded: Path) -> None:
    assert shape(recorded, "Short") == "a(b()b())" * 3


def test_each_test_has_a_recording_of_its_own(recorded: Path) -> None:
    assert shape(recorded, "Again") == "a(b()b())"


def test_a_recording_that_is_not_whole_says_so(recorded: Path) -> None:
    assert (recorded / "Calls.TooMany.truncated").exists()
    assert not (recorded / "Calls.Repeated.truncated").exists()
