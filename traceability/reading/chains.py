"""Follows a value through a recording. The design declares the calls and events of such a chain."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from traceability.reading.call_record import DECLARED, BoardEvent, Recording
from traceability.reading.toml_reader import Entries
from traceability.schema import Place
from weeding_robot_client.frames import FrameError, decode
from weeding_robot_client.layout import BY_QUANTITY, LAYOUTS, Field, value_name

WITHIN = "> "  # The call of the last step without this mark contains the step with the mark.
HEAD = 4  # number of bytes before the payload: byte stuffing, version, type and sequence number
CHANNELS = 8  # number of channels of an FTM
BYTES = ("byte_received", "byte_sent")


@dataclass(frozen=True)
class Chain:
    name: str
    title: str
    says: str
    recording: str
    steps: Sequence[str]
    last: bool  # The chain begins at the last matching place, and not at the first one.
    place: Place


@dataclass(frozen=True)
class Step:
    """A step in the recording. It is a call, or an event with its text."""

    wanted: str
    at: int
    depth: int  # depth below the step that contains it
    span: int | None = None
    text: str = ""


@dataclass
class FrameBytes:
    """A frame on the line, with the times of its bytes and with its values."""

    kind: str
    events: list[BoardEvent] = field(default_factory=list)
    values: dict[str, object] = field(default_factory=dict)


def declared_chains(root: Path, entries: Entries | None = None) -> list[Chain]:
    entries = entries or Entries(root)
    return entries.records(root / DECLARED, "chain", Chain, "name", may=["last"])


def frames_in(recording: Recording, direction: str) -> Iterator[FrameBytes]:
    """Yields the complete frames that a line carried, in their order."""
    pending: list[BoardEvent] = []
    for event in recording.events:
        if event.kind != direction or event.number != 0:
            continue
        if event.value:
            pending.append(event)
            continue
        events, pending = pending, []
        try:
            frame = decode(bytes(event.value for event in events))
        except FrameError:
            continue  # The first bytes of the frame were sent before the recording.
        layout = next(
            (frame_layout for frame_layout in LAYOUTS.values() if frame_layout.kind == frame.kind),
            None,
        )
        if layout and len(frame.payload) >= layout.size:
            yield FrameBytes(layout.name, [*events, event], layout.decode(frame.payload))


def follow(chain: Chain, recording: Recording) -> list[Step] | None:
    """Returns the steps of a chain. Returns None if the recording does not contain them in this
    order."""
    places = list(_places(chain.steps[0], recording, 0, None))
    for first in reversed(places) if chain.last else places:
        if steps := _from(first, chain, recording):
            return steps
    return None


def first_missing(chain: Chain, recording: Recording) -> str:
    """Returns the first step of a chain that is missing in the recording."""
    for number in range(1, len(chain.steps) + 1):
        part = Chain(chain.name, "", "", "", chain.steps[:number], chain.last, chain.place)
        if follow(part, recording) is None:
            return chain.steps[number - 1]
    return ""


def _from(first: Step, chain: Chain, recording: Recording) -> list[Step] | None:
    steps, around = [first], [first]
    for step_name in chain.steps[1:]:
        inside = step_name.startswith(WITHIN)
        while around and inside and not _contains(recording, around[-1], step_name, steps[-1].at):
            around.pop()
        if inside and not around:
            return None
        outer = around[-1] if inside else None
        name = step_name.removeprefix(WITHIN)
        next_step = next(_places(name, recording, steps[-1].at, outer), None)
        if next_step is None:
            return None
        step = Step(
            name, next_step.at, len(around) if inside else 0, next_step.span, next_step.text
        )
        around = [*around, step] if inside else [step]
        steps.append(step)
    return steps


def _contains(recording: Recording, outer: Step, name: str, after: int) -> bool:
    return next(_places(name.removeprefix(WITHIN), recording, after, outer), None) is not None


def _places(name: str, recording: Recording, after: int, outer: Step | None) -> Iterator[Step]:
    """Yields the calls or events of a step that begin after a time. If a call is given, they are
    within this call.
    """
    kind, _, rest = name.partition(" ")
    if kind in BYTES:
        yield from _field_places(name, recording, kind, rest, after)
    elif kind == "pwm_changed":
        for event in recording.events:
            if event.kind == kind and event.number == int(rest) and event.at >= after:
                timer, channel = divmod(event.number, CHANNELS)
                share = event.value / 1e4
                text = f"The duty cycle of channel {channel} of FTM{timer} becomes {share:.2f} %."
                yield Step(name, event.at, 0, None, text)
    else:
        span = recording.spans[outer.span] if outer and outer.span is not None else None
        for number, call in enumerate(recording.spans):
            if call.method != name or call.begin < after:
                continue
            if span and not (call.begin < span.end and call.activation == span.activation):
                continue
            yield Step(name, call.begin, 0, number)


def _field_places(
    field_name: str, recording: Recording, direction: str, named: str, after: int
) -> Iterator[Step]:
    """Yields the first byte of a field in each frame that has this field."""
    kind, _, name = named.partition(".")
    field_ = LAYOUTS[kind].of(name)
    number = HEAD + field_.offset
    for frame in frames_in(recording, direction):
        if frame.kind != kind or frame.events[number].at < after:
            continue
        event, shown = frame.events[number], value_name(field_)
        unit = f" {_unit_of_quantity(kind, field_, frame)}" if field_.unit == BY_QUANTITY else ""
        verb = "has received" if direction == "byte_received" else "has sent"
        text = (
            f"The serial port {verb} the byte 0x{event.value:02X}. This is byte {number + 1} of "
            f"{len(frame.events)} of the frame {kind}, in which {shown} is "
            f"{frame.values[shown]}{unit}."
        )
        yield Step(field_name, event.at, 0, None, text)


def _unit_of_quantity(kind: str, field_: Field, frame: FrameBytes) -> str:
    """Returns the unit of a set-point. It is the unit of the quantity in the same frame."""
    quantity = LAYOUTS[kind].of(f"{BY_QUANTITY}{field_.wheel}")
    shown = frame.values[quantity.name]
    entries = quantity.values.entries if quantity.values else ()
    return next((entry.unit for entry in entries if entry.shown == shown), "")
