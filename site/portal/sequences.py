"""Draws sequence diagrams of recorded calls from one module to another. A diagram shows only calls
in the invocation trees of chosen requirements."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

from markupsafe import Markup

from portal.diagrams import MARKERS, Diagram, draw, node, preamble
from portal.links import Links
from portal.portal import Portal
from portal.recorded_calls import (
    COMMAND,
    PULSE,
    name_of,
    recordings_of,
    requirements_by_method,
    windows_of,
)
from traceability.reading.call_record import DECLARED, Recording, Window
from traceability.reading.chains import frames_in
from traceability.reading.toml_reader import Entries
from traceability.schema import Place

LOGIC = "logic modules"
PC, LINE = "PC", "serial line"
LONGEST = 12  # maximum number of messages in a repeated group
CLASSES_ONLY = ("hide ", "set ")  # beginnings of lines that only class diagrams need
ROUND = 2  # decimal digits of a time [ms]


@dataclass(frozen=True)
class DeclaredSequence:
    """A sequence diagram that a file of the design declares."""

    name: str
    title: str
    says: str
    recordings: Sequence[str]
    requirements: Sequence[str]
    participants: str  # "logic modules", or "" for modules
    place: Place

    @property
    def by_logic(self) -> bool:
        return self.participants == LOGIC


@dataclass(frozen=True)
class Message:
    """A call from a participant to another participant, or a frame on the serial line. The call can
    pass through methods that are not shown."""

    source: str
    target: str
    text: str
    method: str = ""  # called method; empty for a frame


@dataclass(frozen=True)
class Loop:
    """A group of messages that occurs several times without another message in between. ``times``
    is the number of occurrences."""

    times: int
    messages: tuple[Message, ...]


@dataclass
class CycleMessages:
    """The messages from a clock pulse to the next clock pulse. Equal consecutive cycles are stored
    once; ``times`` is their number."""

    begin: int  # [ns]
    parts: tuple[Message | Loop, ...]
    times: int = 1


@dataclass
class Drawn:
    """A sequence with its recordings and its diagram."""

    declared: DeclaredSequence
    windows: list[Window]
    recorded: bool  # true: this build contains all recordings of the sequence
    cycles: list[CycleMessages]
    diagram: Diagram | None
    methods: list[tuple[str, list[str]]]  # each called method, with the shown requirements


def declared_sequences(root: Path) -> list[DeclaredSequence]:
    return Entries(root).records(
        root / DECLARED, "sequence", DeclaredSequence, "name", may=["participants"]
    )


# ---- messages ----------------------------------------------------------------


def messages_of(
    portal: Portal, recording: Recording, methods: frozenset[str], by_logic: bool
) -> Iterator[tuple[int, Message]]:
    """Yields the messages of a recording in the order of their times, each with its time."""
    timed = [*_calls(portal, recording, methods, by_logic), *_frames(recording)]
    yield from sorted(timed, key=lambda pair: pair[0])


def _calls(
    portal: Portal, recording: Recording, methods: frozenset[str], by_logic: bool
) -> Iterator[tuple[int, Message]]:
    def participant(method: str) -> str:
        module = portal.model.modules.get(method.partition("::")[0])
        if module is None or not by_logic:
            return method.partition("::")[0]
        return module.logic

    chosen = [span.method in methods for span in recording.spans]
    for number, span in enumerate(recording.spans):
        if not chosen[number]:
            continue
        above = span.parent
        while above >= 0 and not chosen[above]:
            above = recording.spans[above].parent
        target = participant(span.method)
        if above >= 0:
            source = participant(recording.spans[above].method)
        else:
            source = name_of(portal, recording.activations[span.activation])
        if source != target:
            text = span.method if by_logic else span.method.partition("::")[2]
            yield span.begin, Message(source, target, f"{text}()", span.method)


def _frames(recording: Recording) -> Iterator[tuple[int, Message]]:
    """Yields the frames as messages. The time of a frame is the time of its last byte."""
    for frame in frames_in(recording, "byte_received"):
        yield frame.events[-1].at, Message(PC, LINE, frame.kind)
    for frame in frames_in(recording, "byte_sent"):
        yield frame.events[-1].at, Message(LINE, PC, frame.kind)


def cycles_of(recording: Recording, messages: Iterator[tuple[int, Message]]) -> list[CycleMessages]:
    """Returns the messages of each cycle, with repeated groups and equal cycles combined."""
    pulses = [
        recording.activations[span.activation].raised
        for span in recording.spans
        if span.method == PULSE
    ]
    begins = [recording.spans[0].begin, *pulses]
    cycles: list[CycleMessages] = []
    for begin, group in groupby(messages, lambda pair: max(b for b in begins if b <= pair[0])):
        parts = folded([message for _, message in group])
        if cycles and cycles[-1].parts == parts:
            cycles[-1].times += 1
        else:
            cycles.append(CycleMessages(begin, parts))
    return cycles


def folded(messages: list[Message]) -> tuple[Message | Loop, ...]:
    """Returns the messages, with a loop in place of each group that is repeated immediately. If
    groups overlap, the group that covers more messages becomes the loop."""
    parts: list[Message | Loop] = []
    at = 0
    while at < len(messages):
        best, times = _repetition(messages, at)
        later = max(math.prod(_repetition(messages, at + step)) for step in range(1, LONGEST))
        if times > 1 and best * times >= later:
            parts.append(Loop(times, tuple(messages[at : at + best])))
            at += best * times
        else:
            parts.append(messages[at])
            at += 1
    return tuple(parts)


def _repetition(messages: list[Message], at: int) -> tuple[int, int]:
    """Returns the length of the repeated group that begins at ``at``, and the number of its
    occurrences. If several groups begin there, the group that covers the most messages is chosen.
    """
    best, times = 1, 1
    for length in range(1, LONGEST + 1):
        group = messages[at : at + length]
        count = 1
        while group and messages[at + count * length : at + (count + 1) * length] == group:
            count += 1
        if count > 1 and count * length > best * times:
            best, times = length, count
    return best, times


# ---- diagram -----------------------------------------------------------------


def flat(parts: Sequence[Message | Loop]) -> Iterator[Message]:
    for part in parts:
        yield from part.messages if isinstance(part, Loop) else (part,)


def sequence_diagram(
    sequence: DeclaredSequence, cycles: list[CycleMessages], links: Links
) -> Diagram:
    sent = (message for cycle in cycles for message in flat(cycle.parts))
    names = dict.fromkeys(name for message in sent for name in (message.source, message.target))
    ordered = sorted(names, key=lambda name: (name != PC, name not in (PC, LINE)))
    common = [line for line in preamble() if not line.startswith(CLASSES_ONLY)]
    lines = [*common, *_look()]
    lines += [_participant(name, links) for name in ordered]
    for cycle in cycles:
        alike = f": {cycle.times} equal cycles" if cycle.times > 1 else ""
        lines.append(f"== {round(cycle.begin / 1e6, ROUND)} ms{alike} ==")
        for part in cycle.parts:
            if isinstance(part, Loop):
                lines.append(f"loop {part.times} times")
                lines += [_arrow(message, links) for message in part.messages]
                lines.append("end")
            else:
                lines.append(_arrow(part, links))
    lines.append("@enduml")
    words = f"Sequence diagram: {sequence.title}. The table below lists the called methods."
    return Diagram(f"sequence-{sequence.name}", words, "\n".join(lines))


def _look() -> list[str]:
    """Returns the PlantUML settings that only sequence diagrams need."""
    return [
        f"skinparam sequenceLifeLineBorderColor {MARKERS['edge']}",
        f"skinparam participantBackgroundColor {MARKERS['plain']}",
        f"skinparam participantBorderColor {MARKERS['edge']}",
        f"skinparam participantFontColor {MARKERS['text']}",
        "skinparam participantFontSize 12",
        f"skinparam sequenceArrowColor {MARKERS['line']}",
        f"skinparam sequenceDividerBackgroundColor {MARKERS['plain']}",
        f"skinparam sequenceDividerBorderColor {MARKERS['edge']}",
        f"skinparam sequenceDividerFontColor {MARKERS['soft']}",
        "skinparam sequenceDividerFontSize 12",
        "skinparam sequenceDividerBorderThickness 1",
        f"skinparam sequenceGroupBorderColor {MARKERS['edge']}",
        f"skinparam sequenceGroupBackgroundColor {MARKERS['plain']}",
        f"skinparam sequenceGroupFontColor {MARKERS['soft']}",
        f"skinparam sequenceGroupHeaderFontColor {MARKERS['soft']}",
        f"skinparam hyperlinkColor {MARKERS['text']}",
        "hide footbox",
    ]


def _participant(name: str, links: Links) -> str:
    address = links.logic(name) or links.module(name)
    if name == PC or address is None:
        return f'participant "{name}" as {node(name)}'
    logic = links.model.logic_modules.get(name)
    name, module = (logic.name if logic else name), name
    fill = MARKERS["role-concrete-fill"]
    return f'participant "{name}" as {node(module)} [[{address}]] {fill}'


def _arrow(message: Message, links: Links) -> str:
    address = links.method(message.method) if message.method else None
    text = f"[[{address} {message.text}]]" if address else message.text
    arrow = "->" if message.method else "->>"
    return f"{node(message.source)} {arrow} {node(message.target)} : {text}"


# ---- the page ----------------------------------------------------------------


def drawn_sequences(portal: Portal) -> list[Drawn]:
    """Returns the declared sequences. A sequence with a missing recording has no cycles."""
    recordings = recordings_of(portal) or {}
    windows = windows_of(portal)
    trees = requirements_by_method(portal)
    drawn = []
    for sequence in declared_sequences(portal.root):
        recorded = all(name in recordings for name in sequence.recordings)
        lines = {
            method: [identifier for identifier in ids if identifier in sequence.requirements]
            for method, ids in trees.items()
        }
        methods = frozenset(method for method, ids in lines.items() if ids)
        cycles: list[CycleMessages] = []
        for recording in (recordings[name] for name in sequence.recordings if recorded):
            messages = messages_of(portal, recording, methods, sequence.by_logic)
            cycles += cycles_of(recording, messages)
        sent = (message for cycle in cycles for message in flat(cycle.parts))
        called = dict.fromkeys(message.method for message in sent if message.method)
        drawn.append(
            Drawn(
                sequence,
                [windows[name] for name in sequence.recordings],
                recorded,
                cycles,
                sequence_diagram(sequence, cycles, portal.links) if cycles else None,
                [(method, lines[method]) for method in called],
            )
        )
    return drawn


def sequences(portal: Portal) -> dict[str, Any]:
    drawn = drawn_sequences(portal)
    diagrams = [sequence.diagram for sequence in drawn if sequence.diagram]
    svgs = draw(diagrams, portal.root / "build" / "diagrams")
    return {
        "sequences": drawn,
        "svgs": {name: Markup(svg) for name, svg in svgs.items()},
        "command": COMMAND,
        "wide": True,
    }
