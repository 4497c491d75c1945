"""The seeded faults are tested in groups. If one fault hides the other faults of its group, only a
few additional runs are needed."""

from __future__ import annotations

from pathlib import Path

from tools.seed_faults import Copy
from traceability.reading.seeded_faults import Edit, Fault, Outcome
from traceability.schema import Finding


class Hiding(Copy):
    """A copy of the project. If other faults are inserted together with the fault ``hides``, the
    checks find none of these faults. The checks never find the fault ``lost``."""

    def __init__(self) -> None:
        self.runs: list[list[str]] = []

    def _seed(self, faults: list[Fault]) -> list[Outcome]:
        names = [fault.name for fault in faults]
        self.runs.append(names)
        hidden = "hides" in names and len(names) > 1
        return [
            Outcome(
                name=name,
                check="",
                says="",
                file="",
                line=1,
                caught=name != "lost" and not hidden,
                compiles=True,
                said=[],
            )
            for name in names
        ]


def fault(name: str) -> Fault:
    return Fault(name, "check", "A fault.", [Edit(name, "a", "b")], name)


def seeded(*names: str) -> tuple[dict[str, bool], int]:
    copy = Hiding()
    outcomes = copy.seed([fault(name) for name in names])
    assert [one.name for one in outcomes] == list(names)
    return {one.name: one.caught for one in outcomes}, len(copy.runs)


def test_a_group_that_is_found_needs_one_run() -> None:
    caught, runs = seeded(*"abcdefgh")
    assert all(caught.values())
    assert runs == 1


def test_a_fault_that_hides_the_others_is_separated_in_halves() -> None:
    names = [str(number) for number in range(127)]
    caught, runs = seeded(*names, "hides")
    assert all(caught.values())
    assert runs <= 15


def test_a_fault_that_no_check_finds_is_missed() -> None:
    caught, _ = seeded("a", "lost", "b")
    assert caught == {"a": True, "lost": False, "b": True}


class Broken(Copy):
    """A copy whose checks end with an error."""

    def __init__(self, tree: Path) -> None:
        self.tree = tree
        self.before = set()
        self.cache = {}
        self.stamps = {}

    def findings(self) -> list[Finding]:
        raise TypeError("no order")


def test_a_fault_that_breaks_the_checks_is_an_outcome_with_the_error(tmp_path: Path) -> None:
    (tmp_path / "build/model").mkdir(parents=True)
    (tmp_path / "code").write_text("a\n")
    edit = Edit("code", "a", "b")
    outcome = Broken(tmp_path).seed([Fault("broken", "check", "A fault.", [edit], "code")])[0]
    assert not outcome.caught
    assert outcome.said == ["TypeError: no order"]
    assert (tmp_path / "code").read_text() == "a\n"
