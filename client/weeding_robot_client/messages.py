"""Messages of the PC protocol, in the units that people use."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from enum import Enum
from typing import ClassVar

from weeding_robot_client.frames import Frame

WHEELS = ("front left", "front right", "rear left", "rear right")
STATES = ("Working", "Waiting", "WaitingN", "Reconnecting", "WaitingK")
MODES = ("RC", "PC", "Bluetooth")
STEERING_STATES = ("off", "holding", "turning", "fault")
SOURCES = {0: "RC", 1: "PC", 2: "Bluetooth", 255: None}
RESET_CAUSES = (
    "unknown cause",
    "power on",
    "low voltage",
    "reset pin",
    "watchdog",
    "clock lost",
    "lockup",
    "software",
    "debugger",
)
FAULTS = {
    1: "assertion {number} failed",
    2: "hard fault",
    3: "memory fault",
    4: "bus fault",
    5: "usage fault",
    6: "unexpected interrupt, exception {number}",
    7: "clock failed in step {number}",
}
COUNTERS = (
    "overruns",
    "lost_bytes",
    "damaged",
    "too_long",
    "unknown_version",
    "unknown_type",
    "wrong_length",
    "out_of_range",
    "unexpected",
    "sequence_gaps",
    "reports_not_sent",
)


class MessageError(ValueError):
    """A frame that is no message, or a message that the protocol does not allow."""


class Quantity(Enum):
    """What a wheel is ordered to do: its number on the line, unit, units on the line, limit."""

    VELOCITY = (0, "rpm", 10, 300.0)
    TENSION = (1, "V", 1000, 24.0)
    CURRENT = (2, "A", 1000, 10.0)

    def __init__(self, code: int, unit: str, scale: int, limit: float) -> None:
        self.code = code
        self.unit = unit
        self.scale = scale
        self.limit = limit

    @classmethod
    def of(cls, code: int) -> Quantity:
        for quantity in cls:
            if quantity.code == code:
                return quantity
        raise MessageError(f"no quantity has the number {code}")


@dataclass(frozen=True)
class WheelSetPoint:
    """Value in the unit of the quantity; velocity is that of the motor shaft."""

    quantity: Quantity
    value: float

    def __post_init__(self) -> None:
        if not abs(self.value) <= self.quantity.limit:
            raise MessageError(
                f"{self.value} {self.quantity.unit}: not within "
                f"-{self.quantity.limit} to {self.quantity.limit}"
            )

    def raw(self) -> tuple[int, int]:
        return self.quantity.code, round(self.value * self.quantity.scale)

    @classmethod
    def from_raw(cls, code: int, value: int) -> WheelSetPoint:
        quantity = Quantity.of(code)
        return cls(quantity, value / quantity.scale)


@dataclass(frozen=True)
class Hello:
    kind: ClassVar[int] = 0x01

    def payload(self) -> bytes:
        return b""


@dataclass(frozen=True)
class Confirm:
    session: int
    kind: ClassVar[int] = 0x02

    def payload(self) -> bytes:
        return bytes([self.session])


@dataclass(frozen=True)
class KeepAlive:
    kind: ClassVar[int] = 0x03

    def payload(self) -> bytes:
        return b""


@dataclass(frozen=True)
class Order:
    order_id: int
    steering_degrees: float  # positive to the left
    wheels: tuple[WheelSetPoint, WheelSetPoint, WheelSetPoint, WheelSetPoint]
    stop: bool = False
    kind: ClassVar[int] = 0x04
    steering_limit_degrees: ClassVar[float] = 32.0
    form: ClassVar[struct.Struct] = struct.Struct("<HhBhBhBhBhB")

    def __post_init__(self) -> None:
        if not abs(self.steering_degrees) <= self.steering_limit_degrees:
            raise MessageError(f"{self.steering_degrees} degrees: not within -32 to 32")
        if not 0 <= self.order_id <= 0xFFFF:
            raise MessageError(f"order id {self.order_id}: not within 0 to 65535")

    def payload(self) -> bytes:
        wheels = [part for wheel in self.wheels for part in wheel.raw()]
        return self.form.pack(
            self.order_id, round(self.steering_degrees * 100), *wheels, int(self.stop)
        )


@dataclass(frozen=True)
class Start:
    """Why the firmware started, and what ended it before, in the numbers of the protocol."""

    cause: int
    fault: int = 0
    number: int = 0
    address: int = 0

    @property
    def faulted(self) -> bool:
        return self.fault != 0

    def __str__(self) -> str:
        known = self.cause < len(RESET_CAUSES)
        cause = RESET_CAUSES[self.cause] if known else f"cause {self.cause}"
        if not self.faulted:
            return cause
        form = FAULTS.get(self.fault, f"fault {self.fault}, number {{number}}")
        place = f" at 0x{self.address:08x}" if self.address else ""
        return f"{cause}, after {form.format(number=self.number)}{place}"


@dataclass(frozen=True)
class Welcome:
    session: int
    version: tuple[int, int, int]
    build_id: str
    cycle_period_ms: int
    waiting_cycles: int
    start: Start
    kind: ClassVar[int] = 0x81
    form: ClassVar[struct.Struct] = struct.Struct("<4B8sHBBBHI")

    @classmethod
    def from_payload(cls, payload: bytes) -> Welcome:
        session, major, minor, patch, build, period, waiting, *start = cls.form.unpack(payload)
        return cls(
            session,
            (major, minor, patch),
            build.decode("ascii", "replace"),
            period,
            waiting,
            Start(*start),
        )


@dataclass(frozen=True)
class WheelReport:
    """What one wheel was ordered, measured and given; None where the value is missing."""

    set_point: WheelSetPoint
    velocity_rpm: float | None
    current_amperes: float | None
    position_counts: int | None
    tension_volts: float | None
    cut_off: bool
    blind: bool
    rejected_edges: int


@dataclass(frozen=True)
class Report:
    cycle: int
    time_ms: int
    state: str
    mode: str
    source: str | None  # None: no order was read since start
    stop: bool
    order_read: bool
    held: bool
    overran: bool
    order_id: int
    steering_set_point_degrees: float
    steering_degrees: float | None
    turn: int | None  # -1 right, 0 none, 1 left
    steering_state: str
    left_end: bool
    right_end: bool
    wheels: tuple[WheelReport, WheelReport, WheelReport, WheelReport]
    counters: dict[str, int]
    report_cycles: int  # of the processor; 0 where the platform counts none, as the next two
    awake_cycles: int
    start_cycles: int
    kind: ClassVar[int] = 0x82
    form: ClassVar[struct.Struct] = struct.Struct("<IIBBBBHhBhBhBhBhhhhihhihhihhiH4hbB11H4B4H3I")

    @classmethod
    def from_payload(cls, payload: bytes) -> Report:
        values = cls.form.unpack(payload)
        cycle, time_ms, state, mode, source, flags, order_id, steering = values[:8]
        set_points, position, measures = values[8:16], values[16], values[17:29]
        measured, tensions, turn, applied = values[29], values[30:34], values[34], values[35]
        counters, (steering_state, ends, cut_offs, blind), rejected = (
            values[36:47],
            values[47:51],
            values[51:55],
        )
        report_cycles, awake_cycles, start_cycles = values[55:]
        if state >= len(STATES) or mode >= len(MODES) or source not in SOURCES:
            raise MessageError("a report with an unknown state, mode or source")
        if steering_state >= len(STEERING_STATES):
            raise MessageError("a report with an unknown state of the steering")
        wheels = []
        for wheel in range(len(WHEELS)):
            velocity, current, counts = measures[3 * wheel : 3 * wheel + 3]
            bits = measured >> 3 * wheel
            wheels.append(
                WheelReport(
                    WheelSetPoint.from_raw(set_points[2 * wheel], set_points[2 * wheel + 1]),
                    velocity / 10 if bits & 1 else None,
                    current / 1000 if bits & 2 else None,
                    counts if bits & 4 else None,
                    tensions[wheel] / 1000 if applied >> wheel & 1 else None,
                    bool(cut_offs >> wheel & 1),
                    bool(blind >> wheel & 1),
                    rejected[wheel],
                )
            )
        return cls(
            cycle=cycle,
            time_ms=time_ms,
            state=STATES[state],
            mode=MODES[mode],
            source=SOURCES[source],
            stop=bool(flags & 1),
            order_read=bool(flags & 2),
            held=bool(flags & 4),
            overran=bool(flags & 8),
            order_id=order_id,
            steering_set_point_degrees=steering / 100,
            steering_degrees=position / 100 if measured & 1 << 12 else None,
            turn=turn if applied & 16 else None,
            steering_state=STEERING_STATES[steering_state],
            left_end=bool(ends & 1),
            right_end=bool(ends & 2),
            wheels=(wheels[0], wheels[1], wheels[2], wheels[3]),
            counters=dict(zip(COUNTERS, counters, strict=True)),
            report_cycles=report_cycles,
            awake_cycles=awake_cycles,
            start_cycles=start_cycles,
        )


ToMcu = Hello | Confirm | KeepAlive | Order
FromMcu = Welcome | Report


def to_frame(message: ToMcu, sequence: int) -> Frame:
    return Frame(message.kind, sequence, message.payload())


def from_frame(frame: Frame) -> FromMcu:
    """The message of the MCU in a frame."""
    for form in (Welcome, Report):
        if frame.kind == form.kind:
            if len(frame.payload) != form.form.size:
                raise MessageError(f"a {form.__name__} of {len(frame.payload)} bytes")
            return form.from_payload(frame.payload)
    raise MessageError(f"unknown type of frame 0x{frame.kind:02x}")


def all_wheels(quantity: Quantity, value: float) -> tuple[WheelSetPoint, ...]:
    return (WheelSetPoint(quantity, value),) * len(WHEELS)
