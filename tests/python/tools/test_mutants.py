"""Mutants of a small class: their positions in the source, the compiled copy that contains them,
and the tests that find them."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from tests.python.project_files import write_files
from tools.mutation import runs, score
from tools.mutation.points import Mutant, Point, find_points
from tools.mutation.runs import Outcome, record_results, run_tests
from tools.mutation.score import Plan, order, try_mutant
from tools.mutation.switched import SWITCH, compiling
from traceability.reading.translation_units import prepare_standard

HEADER = """\
#pragma once
#include <cstdint>
namespace wr {
class Limiter {
 public:
  int limited(int value);
  constexpr int twice(int value) const { return value * 2; }
  int other(int value) { return value + 1; }
 private:
  void count();
  int counted_ = 0;
};
}  // namespace wr
"""
SOURCE = """\
#include "Limiter.hpp"
namespace wr {
int Limiter::limited(int value) {
  constexpr int kMost = 5 + 4;
  const std::uint8_t narrow{3 + 4};
  count();
  if (value < kMost && value != narrow) {
    return value + 1;
  }
  return kMost;
}
void Limiter::count() {
  ++counted_;
}
}  // namespace wr
"""


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    write_files(tmp_path, {"src/Limiter.hpp": HEADER, "src/Limiter.cpp": SOURCE})
    cache = tmp_path / "build/model/cache"
    cache.mkdir(parents=True)
    prepare_standard(tmp_path, cache, board=False)
    return tmp_path


FILES = ["src/Limiter.cpp", "src/Limiter.hpp"]


def points_of(tree: Path, *wanted: str) -> dict[str, list[Point]]:
    """Returns the points with mutants in the methods ``wanted``: file -> points."""
    return {
        file: [point for point in points if point.mutants[0].method in wanted]
        for file, points in find_points(tree, FILES[0], FILES).items()
    }


def points(tree: Path, *wanted: str) -> list[Point]:
    return [point for held in points_of(tree, *wanted).values() for point in held]


def changes(tree: Path, *wanted: str) -> list[tuple[str, str]]:
    return [(one.kind, one.change) for point in points(tree, *wanted) for one in point.mutants]


def test_each_kind_of_mutant_is_found_in_the_wanted_method(tree: Path) -> None:
    assert changes(tree, "Limiter::limited") == [
        ("return", "return {} at once"),
        ("arithmetic", "- for + in 3 + 4"),
        ("constant", "3 + 1"),
        ("constant", "3 - 1"),
        ("constant", "4 + 1"),
        ("constant", "4 - 1"),
        ("statement", "without count()"),
        ("condition", "not value < kMost && value != narrow"),
        ("relation", "<= for < in value < kMost"),
        ("relation", ">= for < in value < kMost"),
        ("relation", "== for != in value != narrow"),
        ("arithmetic", "- for + in value + 1"),
        ("constant", "1 + 1"),
        ("constant", "1 - 1"),
    ]
    assert points(tree, "Limiter::limited")[0].mutants[0].line == 3


def test_a_mutant_that_does_not_compile_is_left_out(tree: Path, tmp_path: Path) -> None:
    found = points_of(tree, "Limiter::limited")
    with (tmp_path / "log").open("w") as log:
        _, held = compiling(tree, FILES[0], found, 1, log)
    assert not any("3" in one.change or "4" in one.change for one in held), (
        "a mutant that changes a constant in narrow{3 + 4} must not compile"
    )
    assert [one.change for one in held if one.kind == "constant"] == ["1 + 1", "1 - 1"]
    assert "Limiter.cpp:5" in (tmp_path / "log").read_text()


MAIN = """\
#include <cstdio>
#include "Limiter.hpp"
int main() {
  wr::Limiter limiter;
  std::printf("%d %d %d\\n", limiter.limited(2), limiter.limited(7), limiter.limited(9));
}
"""


def test_each_number_switches_its_own_mutant_on(tree: Path) -> None:
    found = points_of(tree, "Limiter::limited")
    with (tree / "log").open("w") as log:
        texts, held = compiling(tree, FILES[0], found, 1, log)
    folder = tree / "changed"
    folder.mkdir()
    for file in FILES:
        text = texts.get(file) or (tree / file).read_text(encoding="utf-8")
        (folder / Path(file).name).write_text(text, encoding="utf-8")
    (folder / "main.cpp").write_text(MAIN, encoding="utf-8")
    words = ["g++", "-std=c++20", "-w", "-include", str(SWITCH), "main.cpp", "Limiter.cpp"]
    subprocess.run([*words, "-o", "program"], cwd=folder, check=True, timeout=120)

    def said(number: int) -> str:
        environment = {**os.environ, "WR_MUTANT": str(number)}
        done = subprocess.run(
            [folder / "program"], env=environment, capture_output=True, text=True, check=True
        )
        return done.stdout.strip()

    printed = {one.change: said(number) for number, one in enumerate(held, 1)}
    assert said(0) == "3 9 9"
    assert printed["return {} at once"] == "0 0 0"
    assert printed["without count()"] == "3 9 9", "this mutant must not change the output"
    assert printed["not value < kMost && value != narrow"] == "9 8 10"
    assert printed["<= for < in value < kMost"] == "3 9 10"
    assert printed[">= for < in value < kMost"] == "9 9 10"
    assert printed["- for + in value + 1"] == "1 9 9"
    assert printed["1 + 1"] == "4 9 9"


def test_results_are_read_from_what_the_program_prints() -> None:
    outcome = Outcome()
    text = b"""\
[ RUN      ] A.One
[       OK ] A.One (0 ms)
[ RUN      ] P/B.Two/0
[  FAILED  ] P/B.Two/0, where GetParam() = 1 (0 ms)
[ RUN      ] P/B.Two/1
[       OK ] P/B.Two/1 (0 ms)
[ RUN      ] A.Three
"""
    assert record_results(text, outcome) == "A.Three"
    assert outcome.failed == {"B.Two"}
    assert outcome.passed == {"A.One", "B.Two"}


# With mutant 1, test One fails. With mutant 2, test Two ends the program. With mutant 3, test Three
# sleeps. With mutant 4, test Two never ends. With mutant 5, the set-up of the suite ends the
# program.
PROGRAM = """\
#!/bin/sh
echo "[----------] 3 tests from A"
[ "$WR_MUTANT" = 5 ] && exit 139
for name in One Two Three; do
    grep -q "A.$name" "${1#--gtest_flagfile=}" || continue
    echo "[ RUN      ] A.$name"
    case "$WR_MUTANT$name" in
        1One) echo "[  FAILED  ] A.One (0 ms)"; code=1; continue ;;
        2Two) exit 134 ;;
        3Three) exec sleep 60 ;;
        4Two) while :; do :; done ;;
    esac
    echo "[       OK ] A.$name (0 ms)"
done
exit ${code:-0}
"""
ALL = {"A.One": 0.0, "A.Two": 0.0, "A.Three": 0.0}


@pytest.fixture
def program(tmp_path: Path) -> Path:
    path = tmp_path / "program"
    path.write_text(PROGRAM, encoding="utf-8")
    path.chmod(0o755)
    return path


@pytest.mark.parametrize(
    ("mutant", "failed"),
    [(0, set()), (1, {"A.One"}), (2, {"A.Two"}), (3, {"A.Three"}), (4, {"A.Two"}), (5, set(ALL))],
)
def test_a_failure_an_end_and_a_hang_each_find_a_mutant(
    program: Path, mutant: int, failed: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runs, "ASLEEP", 1)
    outcome = run_tests(program, mutant, ALL)
    assert outcome.failed == failed
    assert outcome.passed == set(ALL) - failed


def test_a_busy_computer_does_not_end_a_test(tmp_path: Path) -> None:
    """The test A.One sleeps for 3 s. Its time limit is 2 s of processor time. A sleeping test uses
    no processor time, and therefore does not reach this limit."""
    path = tmp_path / "program"
    lines = (
        "#!/bin/sh",
        "echo '[ RUN      ] A.One'",
        "sleep 3",
        "echo '[       OK ] A.One (0 ms)'",
    )
    path.write_text("\n".join(lines), encoding="utf-8")
    path.chmod(0o755)
    assert run_tests(path, 1, {"A.One": 0.0}) == Outcome(set(), {"A.One"})


def test_a_mutant_whose_tests_do_not_end_is_not_recorded(tmp_path: Path) -> None:
    path = tmp_path / "program"
    path.write_text("#!/bin/sh\nexit 134\n", encoding="utf-8")
    path.chmod(0o755)
    assert try_mutant(path, 1, mutant_of("M::a"), plan()) is None


def mutant_of(method: str) -> Mutant:
    return Mutant("a.cpp", 1, method, "constant", "1 + 1")


def plan() -> Plan:
    return Plan(
        methods={"M::a": ["FR-1", "FR-2"], "M::b": ["FR-2"]},
        verifying={"FR-1": {"A.One"}, "FR-2": {"A.Two"}},
        executing={"M::a": {"A.One", "A.Two", "A.Three"}, "M::b": {"A.Two", "A.Three"}},
        seconds=ALL,
    )


def test_a_mutant_counts_for_the_requirement_whose_own_test_finds_it(program: Path) -> None:
    tried = try_mutant(program, 1, mutant_of("M::a"), plan())
    assert tried is not None
    assert tried.killed_by == ["A.One"]
    assert tried.own == {"FR-1": True, "FR-2": False}


def test_where_no_own_test_finds_it_the_others_are_asked(
    program: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runs, "ASLEEP", 1)
    tried = try_mutant(program, 3, mutant_of("M::b"), plan())
    assert tried is not None
    assert tried.killed_by == ["A.Three"]
    assert tried.own == {"FR-2": False}


def test_long_tests_run_only_while_a_requirement_has_no_test_that_finds_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    parts: list[set[str]] = []

    def run(_program: Path, _number: int, seconds: dict[str, float]) -> Outcome:
        parts.append(set(seconds))
        return Outcome({"A.Fast"} & set(seconds), set(seconds) - {"A.Fast"})

    monkeypatch.setattr(score, "run_tests", run)
    known = Plan({}, {}, {}, {"A.Fast": 0.1, "A.Slow": 5.0, "B.Short": 0.1, "B.Long": 0.7})
    first, second = {"A.Fast", "A.Slow"}, {"B.Short", "B.Long"}
    outcome = score.run_until_found(Path("program"), 1, known, [first, second])
    assert parts == [{"A.Fast", "B.Short"}, {"B.Long"}, set()]
    assert outcome == Outcome({"A.Fast"}, {"B.Short", "B.Long"})


def test_the_order_depends_on_the_seed_and_gives_each_requirement_its_turn() -> None:
    mutants = [mutant_of("M::a")] * 20 + [mutant_of("M::b")] * 20
    chosen = order(mutants, plan(), 7)
    assert sorted(chosen) == list(range(1, 41))
    assert chosen == order(mutants, plan(), 7) != order(mutants, plan(), 8)
    assert any(number <= 20 for number in chosen[:2])


def test_a_function_outside_the_trees_has_its_turn_too() -> None:
    mutants = [mutant_of("M::a")] * 20 + [mutant_of("M::other")] * 20
    chosen = order(mutants, plan(), 7)
    assert sorted(chosen) == list(range(1, 41))
    assert any(number > 20 for number in chosen[:4])


def test_all_functions_of_a_file_have_mutants(tree: Path) -> None:
    points = [point for found in find_points(tree, FILES[0], FILES).values() for point in found]
    functions = {mutant.method for point in points for mutant in point.mutants}
    assert functions == {"Limiter::limited", "Limiter::other", "Limiter::count"}
