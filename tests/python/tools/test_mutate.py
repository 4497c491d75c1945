"""./wr mutate: its steps, its output, and its files."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import TextIO

import pytest

from tools import mutate
from tools.cli import parser
from tools.mutation.points import Mutant
from tools.mutation.score import Justifications, Plan, Tried
from tools.task_graph import Graph, Outcome, Task
from traceability.model.design_model import Model
from traceability.reading.mutation_record import last_mutation, read_mutation
from traceability.reading.task_record import TESTS_TRACE
from traceability.schema import HOST, Equivalent, Place

pytestmark = pytest.mark.reads("tools", "client", "design/clauses.toml")

GoesOn = Callable[[list[Tried]], bool]
MUTANTS = [
    Mutant("src/a.cpp", 4, "A::f", "constant", "1 + 1"),
    Mutant("src/a.cpp", 9, "A::f", "constant", "2 + 1"),
]


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Returns a project in which stubs replace the builds and the tests. The tests find only the
    first of two mutants."""
    (tmp_path / "build/results").mkdir(parents=True)
    replace_tests(monkeypatch, tmp_path, lambda _log: None)
    monkeypatch.setattr(mutate, "read_traces", lambda _root, _cache: {HOST: None})
    (tmp_path / "src").mkdir()
    (tmp_path / "src/a.cpp").write_text(9 * "return 1 + 2;\n", encoding="utf-8")
    facts = SimpleNamespace(declared=SimpleNamespace(equivalents=[]))
    monkeypatch.setattr(mutate, "build", lambda _root: (Model("", "", "sources", {}), facts))
    plan = Plan({"A::f": ["FR-1"]}, {"FR-1": {"T.A"}}, {"A::f": {"T.A"}})
    monkeypatch.setattr(mutate, "make_plan", lambda *_: plan)
    monkeypatch.setattr(mutate, "write_switched", lambda _root, _log: MUTANTS)
    monkeypatch.setattr(mutate, "build_switched", lambda _root, _log: None)

    def measure(_program: Path, plan: Plan, _known: dict[str, float]) -> list[str]:
        plan.seconds = {"T.A": 0.1}
        return []

    def find_first(mutants: list[Mutant], numbers: list[int], goes_on: GoesOn) -> list[Tried]:
        tried: list[Tried] = []
        for number in sorted(numbers):
            if goes_on(tried):
                found = ["T.A"] if number == 1 else []
                tried.append(Tried(mutants[number - 1], found, {"FR-1": bool(found)}))
        goes_on(tried)
        return tried

    monkeypatch.setattr(mutate, "measure", measure)
    replace_tries(monkeypatch, find_first)
    monkeypatch.setattr(mutate, "SHOWN_EVERY", 0.0)
    return tmp_path


def replace_tries(
    monkeypatch: pytest.MonkeyPatch,
    tries: Callable[[list[Mutant], list[int], GoesOn], list[Tried]],
) -> None:
    monkeypatch.setattr(
        mutate,
        "try_all",
        lambda _program, mutants, numbers, _plan, goes_on: tries(mutants, list(numbers), goes_on),
    )


def replace_tests(
    monkeypatch: pytest.MonkeyPatch, root: Path, action: Callable[[TextIO], Outcome | None]
) -> None:
    tests = Graph(root, [Task(TESTS_TRACE, action, always=True)])
    monkeypatch.setattr(mutate, "graph", lambda _root: tests)


def run(root: Path, *words: str) -> int:
    options = parser().parse_args(["mutate", *words])
    return mutate.mutate(root, options)


def test_it_shows_seed_progress_and_what_no_test_finds(
    root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(root, "--seed", "7") == 0
    printed = capsys.readouterr().out
    assert printed.startswith("seed 7\n")
    assert "0:00 1 of 2 tried, 1 found" in printed
    assert "src/a.cpp:9: no test finds this change: 2 + 1" in printed
    assert "src/a.cpp:4: no test finds this change" not in printed
    assert "1 of 2 mutants were found, and 0 others are justified; seed 7" in printed
    left = json.loads((root / "build/results/mutation.json").read_text(encoding="utf-8"))
    assert (left["sources"], left["seed"], left["total"], len(left["tried"])) == (
        "sources",
        7,
        2,
        2,
    )


def test_without_tests_that_pass_nothing_is_measured(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(mutate, "measure", lambda *_words: ["T.A"])
    assert run(root) == 1
    assert "no test passes in the mutated build" in capsys.readouterr().out
    assert not (root / "build/results/mutation.json").exists()


def test_each_change_of_an_entry_justifies_one_mutant(tmp_path: Path) -> None:
    (tmp_path / "code").write_text("a > 0 || b > 0\n", encoding="utf-8")
    entry = Equivalent("code", "run", "a > 0 || b > 0", ["0 + 1"], "Why.", Place("mutants", 1))
    mutant = Mutant("code", 1, "run", "constant", "0 + 1")
    assert Justifications(tmp_path, [entry]).reasons_of([mutant, mutant]) == ["Why.", ""]


def test_a_justified_mutant_is_not_listed(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    entry = Equivalent(
        "src/a.cpp", "A::f", "return 1 + 2;", ["2 + 1"], "Nobody sees it.", Place("m.toml", 1)
    )
    facts = SimpleNamespace(declared=SimpleNamespace(equivalents=[entry]))
    monkeypatch.setattr(mutate, "build", lambda _root: (Model("", "", "sources", {}), facts))
    assert run(root, "--publish") == 0
    printed = capsys.readouterr().out
    assert "no test finds this change" not in printed
    assert "1 of 2 mutants were found, and 1 others are justified" in printed
    model = read_mutation(root, "sources")
    assert model is not None
    assert (model.found, model.justified, len(model.tried)) == (1, 1, 2)
    local = last_mutation(root, "later sources")
    assert local is not None
    assert (local.found, local.justified, local.tried, local.current) == (1, 1, 2, False)
    os.utime(root / "build/results/mutation.json", (0, 0))
    assert last_mutation(root, "later sources") == replace(local, date="1970-01-01")
    (root / "build/results/mutation.json").unlink()
    published = last_mutation(root, "later sources")
    assert published is not None
    assert replace(published, command=local.command) == local


def test_a_resumed_run_tries_only_what_no_test_found(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(root) == 0
    asked: list[int] = []

    def find_all(mutants: list[Mutant], numbers: list[int], goes_on: GoesOn) -> list[Tried]:
        asked.extend(numbers)
        tried = [Tried(mutants[number - 1], ["T.A"], {"FR-1": True}) for number in asked]
        goes_on(tried)
        return tried

    replace_tries(monkeypatch, find_all)
    assert run(root, "--resume") == 0
    assert asked == [2]
    assert "2 of 2 mutants were found" in capsys.readouterr().out
    with (root / "src/a.cpp").open("a", encoding="utf-8") as file:
        file.write("// changed\n")
    asked.clear()
    assert run(root, "--resume") == 0
    assert sorted(asked) == [1, 2], "the mutants of a changed file must be tested again"


def test_an_ended_run_leaves_the_results_until_then(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(mutants: list[Mutant], _numbers: list[int], goes_on: GoesOn) -> list[Tried]:
        goes_on([Tried(mutants[0], ["T.A"], {"FR-1": True})])
        raise KeyboardInterrupt

    replace_tries(monkeypatch, interrupted)
    with pytest.raises(KeyboardInterrupt):
        run(root)
    model = read_mutation(root, "sources")
    assert model is not None
    assert (model.found, len(model.tried), model.total) == (1, 1, 2)


@pytest.mark.parametrize("minutes", ["0", "241", "-1", "x"])
def test_it_never_runs_longer_than_four_hours(root: Path, minutes: str) -> None:
    with pytest.raises(SystemExit) as ended:
        run(root, f"--minutes={minutes}")
    assert ended.value.code == 2
