"""Reads the properties that the state machines must have, and the results of their proofs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from traceability.reading.results import RESULTS, read_record
from traceability.reading.task_record import PROOFS as TASK
from traceability.reading.task_record import is_fresh
from traceability.reading.toml_reader import Entries
from traceability.schema import Place, ProofProperty, ProofResult

PROPERTIES = Path("design/proofs/properties.toml")
PROOFS = RESULTS / "proofs.json"
PROVE = "./wr prove --again"  # the command that proves all properties and writes the record
SCENARIOS = RESULTS / "proofs"  # folder for scenarios that play counterexamples
FOLDER = Path("build/proofs")
ROUND_MS = 100
# time of the events in the first cycle [ms]; the clock pulse of this cycle is later
START_MS = 50
AFTER_MS = 10  # time between two events in the same cycle [ms]


@dataclass(frozen=True)
class ProofEvent:
    """An event of the environment in the proof model, and the actions with which a scenario causes
    this event."""

    id: str
    says: str
    place: Place
    action: str = ""  # actions that cause the event, separated by semicolons
    # action in the next cycle that ends the effect of the event; "" if no action is needed
    without: str = ""
    wait: int = 0  # time that the scenario waits for the event [ms]


def read_properties(root: Path, entries: Entries) -> dict[str, ProofProperty]:
    return entries.named(root / PROPERTIES, "property", ProofProperty, "name")


def read_events(root: Path, entries: Entries) -> dict[str, ProofEvent]:
    may = ["action", "without", "wait"]
    return entries.named(root / PROPERTIES, "event", ProofEvent, "id", may=may)


def read_proofs(root: Path) -> dict[str, ProofResult] | None:
    """Returns the results of the proofs. Returns None if the machines, ``robot.pml`` or the
    properties have changed since the proofs ran."""
    if not is_fresh(root, TASK):
        return None
    return read_record(root / PROOFS, dict[str, ProofResult])


def readable(
    events: Sequence[str], declared: Mapping[str, ProofEvent]
) -> list[tuple[str, list[str]]]:
    """Returns the cycles of a counterexample for the pages. Each cycle has a title, and a list of
    its events and transitions."""
    rounds: list[tuple[str, list[str]]] = []
    for line in events:
        kind, _, rest = line.partition(" ")
        if kind == "round":
            rounds.append((f"round {len(rounds) + 1}", []))
        elif kind == "event" and rounds:
            rounds[-1][1].append(declared[rest].says if rest in declared else rest)
        elif kind == "transition" and rounds:
            machine, source, target = rest.split(" ")
            rounds[-1][1].append(f"{machine}: {source} \N{RIGHTWARDS ARROW} {target}")
        elif rounds:
            rounds[-1][1].append(line)
    return rounds


def scenario(
    proof: ProofProperty, events: Sequence[str], declared: Mapping[str, ProofEvent]
) -> str:
    """Returns a scenario whose execution repeats a counterexample. Returns "" if the counterexample
    contains an event that neither an action nor waiting can cause."""
    lines, at, number, lasting = [], START_MS, 0, dict[str, str]()
    ending: dict[str, str] = {}
    for line in events:
        kind, _, rest = line.partition(" ")
        if kind == "round":
            at += ROUND_MS if number else 0
            number, after = number + 1, 0
            lines += [f"at {at} {action}" for action in ending.values()]
            ending = {}
        elif kind == "event" and rest in declared:
            event = declared[rest]
            actions = list(filter(None, map(str.strip, event.action.split(";"))))
            if not actions and not event.wait:
                return ""
            at += event.wait
            for action in actions:
                word = action.rpartition(" ")[0]
                if lasting.get(word) != action or not rest.startswith("rc-"):
                    lines.append(f"at {at + after} {action}")
                    lasting[word] = action
            after += AFTER_MS
            if event.without:
                ending[rest] = event.without
    head = f"# Counterexample of the property {proof.name}: {proof.says}"
    return "\n".join([head, "seed 1", *lines, f"at {at + 2 * ROUND_MS} end"]) + "\n"
