"""The proofs find a defect in the design. A person can read the counterexample, and the simulator
can play it as a scenario."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from tools import proof_runs
from tools.proof_runs import (
    REACHED,
    missing_program,
    prove,
    prove_all,
    record_proofs,
    recorded_proofs,
    search,
)
from traceability.model.metrics import recorded_metric
from traceability.model.promela import ROBOT, step_of, without
from traceability.reading.declared import read_declared
from traceability.reading.proof_record import (
    PROOFS,
    ProofEvent,
    read_properties,
    readable,
    scenario,
)
from traceability.reading.toml_reader import Entries
from traceability.schema import Place, ProofProperty, ProofResult, Proofs

pytestmark = pytest.mark.reads("design", "changes", "sim/scenario", "requirements")

ROOT = Path(__file__).parents[3]
HERE = Place("a.toml", 1)
TRIED = ProofProperty("tried", "FR-1", "It is tried.", "[] !drives", HERE)
needs_spin = pytest.mark.skipif(bool(missing_program()), reason="Spin is not installed")


@pytest.fixture
def design(tmp_path: Path) -> Path:
    shutil.copytree(ROOT / "design", tmp_path / "design")
    return tmp_path


def change(path: Path, find: str, put: str) -> None:
    text = path.read_text(encoding="utf-8")
    changed, count = re.subn(find, put, text)
    assert count == 1, f"{path} must contain this text once, not {count} times: {find}"
    path.write_text(changed, encoding="utf-8")


def proven(root: Path, *names: str) -> dict[str, ProofResult]:
    declared = read_declared(root)
    lines: list[str] = []
    wanted = [declared.proofs[name] for name in names]
    results = prove(root, declared, wanted, lines.append)
    assert all(any(name in line for line in lines) for name in names)
    return results


@needs_spin
@pytest.mark.long
def test_a_transition_without_its_guard_is_found(design: Path) -> None:
    machine = design / "design/fsm/reading_modes.toml"
    name = "modes_change_in_reconnecting_only"
    guard = r'(from = "RC"\non = "noMessage"\nguard = )"in Reconnecting"'
    change(machine, guard, r'\1""')
    result = proven(design, name)[name]
    assert result.verdict == "false"
    assert "transition reading-modes RC PC" in result.events


@needs_spin
@pytest.mark.long
def test_a_stop_that_one_state_loses_is_found(design: Path) -> None:
    heeded = r"  :: stops -> pc_stop = true"
    connected = "  :: stops && pc_mcu_connection == pc_mcu_connection_Connected -> pc_stop = true"
    change(design / ROBOT, heeded, connected)
    result = proven(design, "pc_stop_latches")["pc_stop_latches"]
    assert result.verdict == "false"
    assert any(
        event in result.events for event in ("event pc-order-stop", "event pc-order-stop-dropped")
    )


@needs_spin
@pytest.mark.long
def test_a_false_property_has_a_scenario_that_plays_its_counterexample(design: Path) -> None:
    """The robot can drive in the model. Therefore the property "the robot never drives" is
    false."""
    declared = read_declared(design)
    (result,) = prove(design, declared, [TRIED], print).values()
    assert result.verdict == "false"
    assert result.states > 0
    text = (design / result.scenario).read_text(encoding="utf-8")
    assert text.count("rc velocity 0 steering 0") == 1
    assert "rc velocity 1000 steering 0" in text
    assert re.search(r"^at \d+ end\n\Z", text, re.MULTILINE)


@needs_spin
@pytest.mark.parametrize(
    "reached", ["steering_fault && protected", "connected && commands_pc && acknowledges"]
)
def test_the_model_reaches_what_the_properties_speak_of(design: Path, reached: str) -> None:
    wanted = replace(TRIED, formula=f"[] !({reached})")
    depth_and_errors = REACHED.search(search(design, read_declared(design), wanted))
    assert depth_and_errors
    assert depth_and_errors[2] != "0"


@needs_spin
def test_an_error_in_the_model_names_the_property(design: Path) -> None:
    wanted = replace(TRIED, formula="[] (drives &&)")
    with pytest.raises(proof_runs.FailureError, match="tried: spin"):
        prove(design, read_declared(design), [wanted], print)


def test_without_spin_nothing_is_recorded(design: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(proof_runs, "SPIN", "no-such-spin")
    with (design / "log").open("w") as log:
        outcome = prove_all(design, log)
    assert outcome.note == "not run in this build, because no-such-spin is not installed"
    assert not (design / PROOFS).exists()


def test_every_transition_is_in_the_model() -> None:
    for machine in read_declared(ROOT).machines.values():
        text = step_of(machine)
        changes = [one for one in machine.transitions if one.source != one.target]
        for step in changes:
            assert f"transition {machine.id} {step.source} {step.target}" in text


def test_observers_that_a_formula_does_not_need_are_no_states() -> None:
    text = without((ROOT / ROBOT).read_text(encoding="utf-8"), "[] !drives")
    assert "\nbool drives;" in text
    assert "\nhidden byte armed" in text


def test_at_least_twenty_properties_are_declared() -> None:
    assert len(read_properties(ROOT, Entries(ROOT))) >= 20


def test_an_event_without_an_action_has_no_scenario() -> None:
    known = {
        "order": ProofEvent("order", "it orders", HERE, "order velocity 0"),
        "fails": ProofEvent("fails", "it fails", HERE),
        "press": ProofEvent("press", "it is pressed", HERE, "estop press", "estop release"),
        "late": ProofEvent("late", "1 s passed", HERE, wait=1000),
    }
    played = ["round", "event order", "event press", "round", "event late"]
    assert scenario(TRIED, played, known).splitlines()[2:] == [
        "at 50 order velocity 0",
        "at 60 estop press",
        "at 150 estop release",
        "at 1350 end",
    ]
    assert scenario(TRIED, ["round", "event fails"], known) == ""
    words = readable([*played, "transition modes RC PC"], known)
    assert words[1] == ("round 2", ["1 s passed", "modes: RC \N{RIGHTWARDS ARROW} PC"])


def test_a_recorded_proof_counts_for_the_same_model_only(design: Path) -> None:
    declared = read_declared(design)
    result = ProofResult("proven", 10, 5, 0.1)
    record_proofs(design, declared, dict.fromkeys(declared.proofs, result))
    recorded = recorded_proofs(design, declared)
    assert set(recorded) == set(declared.proofs)
    metric = recorded_metric(Proofs(declared.proofs, recorded))["proofs.proven"]
    assert (metric["command"], metric["value"]) == ("./wr prove --again", len(recorded))
    assert metric["date"]
    machine = design / "design/fsm/reading_modes.toml"
    change(machine, r'(from = "RC"\non = "noMessage"\nguard = )"in Reconnecting"', r'\1""')
    assert recorded_proofs(design, read_declared(design)) == {}


def test_a_property_that_is_not_proven_is_not_recorded(design: Path) -> None:
    declared = read_declared(design)
    record_proofs(design, declared, {next(iter(declared.proofs)): ProofResult("false", 1, 1, 0.1)})
    assert recorded_proofs(design, declared) == {}
