"""Follows a value, such as a set-point, through a recording. A chain in the design declares the
calls and events through which the value passes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from traceability.reading.call_record import DECLARED, BoardEvent, Recording
from traceability.reading.toml_reader import Entries
from traceability.schema import Place
from weeding_robot_client.frames import FrameError, decode
from weeding_robot_client.layout import BY_QUANTITY, LAYOUTS, Field, value_name

WITHIN = "> "  # A step with this mark is inside the call of an earlier step.
# number of bytes before the payload of a frame: one byte of byte stuffing, version, type and
# sequence number
HEAD = 4
CHANNELS = 8  # number of channels of an FTM
BYTES = ("byte_received", "byte_sent")


@dataclass(frozen=True)
class Chain:
    name: str
    title: str
    says: str
    recording: str
    steps: Sequence[str]
    # A recording can contain the chain several times. True if the last of these chains is followed,
    # false for the first of these chains.
    last: bool
    place: Place


@dataclass(frozen=True)
class Step:
    """A step of a chain that was found in the recording. It is a call, or an event that ``text``
    describes."""

    wanted: str
    at: int
    depth: int  # number of steps whose calls enclose this step
    span: int | None = None
    text: str = ""


@dataclass
class FrameBytes:
    """A frame on the serial line. ``events`` are its bytes with their times, and ``values`` are the
    decoded fields."""

    kind: str
    events: list[BoardEvent] = field(default_factory=list)
    values: dict[str, object] = field(default_factory=dict)


def declared_chains(root: Path, entries: Entries | None = None) -> list[Chain]:
    entries = entries or Entries(root)
    return entries.records(root / DECLARED, "chain", Chain, "name", may=["last"])


def frames_in(recording: Recording, direction: str) -> Iterator[FrameBytes]:
    """Yields the complete frames that were received or sent on the serial line, in the order of
    time."""
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
            continue  # The recording began in the middle of this frame.
        layout = next((each for each in LAYOUTS.values() if each.kind == frame.kind), None)
        if layout and len(frame.payload) >= layout.size:
            yield FrameBytes(layout.name, [*events, event], layout.decode(frame.payload))


def follow(chain: Chain, recording: Recording) -> list[Step] | None:
    """Returns the steps of a chain as found in the recording. Returns None if the recording does
    not contain all steps in the declared order."""
    places = list(_places(chain.steps[0], recording, 0, None))
    for first in reversed(places) if chain.last else places:
        if steps := _from(first, chain, recording):
            return steps
    return None


def first_missing(chain: Chain, recording: Recording) -> str:
    """Returns the name of the first step that cannot be found in the recording. Returns "" if all
    steps are found."""
    for number in range(1, len(chain.steps) + 1):
        if follow(replace(chain, steps=chain.steps[:number]), recording) is None:
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
        step = replace(next_step, depth=len(around) if inside else 0)
        around = [*around, step] if inside else [step]
        steps.append(step)
    return steps


def _contains(recording: Recording, outer: Step, name: str, after: int) -> bool:
    return next(_places(name.removeprefix(WITHIN), recording, after, outer), None) is not None


def _places(name: str, recording: Recording, after: int, outer: Step | None) -> Iterator[Step]:
    """Yields the calls or events in the recording that match a step and do not begin before the
    time ``after``. If ``outer`` is a call, only the calls inside this call are considered."""
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
    """Yields an event for each frame of the named kind: the first byte of the named field."""
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
    """Returns the unit of a set-point in a frame. Another field of the same frame contains the
    quantity of the set-point, and the quantity determines the unit."""
    quantity = LAYOUTS[kind].of(f"{BY_QUANTITY}{field_.wheel}")
    shown = frame.values[quantity.name]
    entries = quantity.values.entries if quantity.values else ()
    return next((entry.unit for entry in entries if entry.shown == shown), "")
