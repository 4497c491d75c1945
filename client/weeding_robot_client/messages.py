"""Messages of the PC protocol, in the units that people use."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import ClassVar

from weeding_robot_client.frames import VERSION, Frame
from weeding_robot_client.layout import LAYOUTS, SCHEMA_HASH, Layout

WHEELS = ("front left", "front right", "rear left", "rear right")
STATES = ("Working", "Waiting", "WaitingN", "Reconnecting", "WaitingK")
MODES = ("RC", "PC", "Bluetooth")
STEERING_STATES = ("off", "holding", "turning", "fault")
NO_SOURCE = 255
NO_WHEEL = 255
INHIBITS = ("none", "no order", "stop", "not armed", "protective stop")
STOP_CAUSES = (
    "none",
    "emergency stop",
    "steering fault",
    "overcurrent",
    "no motion",
    "wrong direction",
    "overspeed",
    "tracking error",
    "missing measurement",
    "Hall signals",
    "reversal",
)
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
    "stale_orders",
)
STOP_COMMAND = 1
ACKNOWLEDGE_COMMAND = 2
CLOCK_MS = 1 << 32  # the clock of the sender begins again at 0


class MessageError(ValueError):
    """A frame that is no message, or a message that the protocol does not allow."""


def named(names: Sequence[str], number: int, kind: str) -> str:
    """Returns the name of a number, or the number itself in words when it has no name here."""
    return names[number] if number < len(names) else f"{kind} {number}"


class Quantity(Enum):
    """Quantity of a set-point: its number on the line, unit, steps of a unit, limit."""

    VELOCITY = (0, "rpm", 10, 300.0)
    TENSION = (1, "V", 1000, 24.0)
    CURRENT = (2, "A", 1000, 10.0)

    def __init__(self, code: int, unit: str, scale: int, limit: float) -> None:
        self.code = code
        self.unit = unit
        self.scale = scale
        self.limit = limit


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

    def __str__(self) -> str:
        return f"{self.value:g} {self.quantity.unit}"


@dataclass(frozen=True)
class ReportedSetPoint:
    """Set-point in a report: any number, in any quantity, also one without a name here."""

    value: float
    unit: str

    @classmethod
    def from_raw(cls, code: int, value: int) -> ReportedSetPoint:
        for quantity in Quantity:
            if quantity.code == code:
                return cls(value / quantity.scale, quantity.unit)
        return cls(float(value), f"(quantity {code})")

    def __str__(self) -> str:
        return f"{self.value:g} {self.unit}"


@dataclass(frozen=True)
class Hello:
    """Request for a connection, with the versions and the layout that this client has."""

    version: int = VERSION  # of the frame
    kind: ClassVar[int] = 0x01

    def payload(self) -> bytes:
        if self.version != VERSION:
            return b""  # other versions have their own layout; an empty Hello fits each
        return LAYOUTS["Hello"].pack(
            lowest_version=VERSION, highest_version=VERSION, schema_hash=SCHEMA_HASH
        )


@dataclass(frozen=True)
class Confirm:
    session: int
    kind: ClassVar[int] = 0x02

    def payload(self) -> bytes:
        return LAYOUTS["Confirm"].pack(session=self.session)


@dataclass(frozen=True)
class KeepAlive:
    kind: ClassVar[int] = 0x03

    def payload(self) -> bytes:
        return b""


@dataclass(frozen=True)
class Order:
    """One complete set of set-points; ``sent_at_ms`` is the clock of this computer."""

    order_id: int
    steering_degrees: float  # positive to the left
    wheels: tuple[WheelSetPoint, WheelSetPoint, WheelSetPoint, WheelSetPoint]
    stop: bool = False
    acknowledge: bool = False
    sent_at_ms: int = 0
    kind: ClassVar[int] = 0x04
    steering_limit_degrees: ClassVar[float] = 32.0

    def __post_init__(self) -> None:
        if not abs(self.steering_degrees) <= self.steering_limit_degrees:
            raise MessageError(f"{self.steering_degrees} degrees: not within -32 to 32")
        if not 0 <= self.order_id <= 0xFFFF:
            raise MessageError(f"order id {self.order_id}: not within 0 to 65535")

    def payload(self) -> bytes:
        wheels: dict[str, int] = {}
        for number, wheel in enumerate(self.wheels):
            wheels[f"quantity{number}"], wheels[f"set_point{number}"] = wheel.raw()
        return LAYOUTS["Order"].pack(
            order_id=self.order_id,
            sent_at=self.sent_at_ms % CLOCK_MS,
            steering_set_point=round(self.steering_degrees * 100),
            commands=STOP_COMMAND * self.stop + ACKNOWLEDGE_COMMAND * self.acknowledge,
            **wheels,
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
    protocol_versions: tuple[int, int] = (VERSION, VERSION)  # lowest and highest
    schema_hash: int | None = SCHEMA_HASH  # None: the robot states none
    kind: ClassVar[int] = 0x81
    layout: ClassVar[Layout] = LAYOUTS["Welcome"]
    appended: ClassVar[int] = 6  # bytes that version 1 did not have

    @classmethod
    def from_payload(cls, payload: bytes, frame_version: int = VERSION) -> Welcome:
        """Reads a Welcome; one of version 1 ends before the versions that the robot supports."""
        short = len(payload) < cls.layout.size
        fields = cls.layout.unpack(payload + bytes(cls.appended))
        build: object = fields["build_id"]
        assert isinstance(build, bytes)
        lowest, highest = fields["lowest_version"], fields["highest_version"]
        return cls(
            session=fields["session"],
            version=(fields["firmware_major"], fields["firmware_minor"], fields["firmware_patch"]),
            build_id=build.decode("ascii", "replace"),
            cycle_period_ms=fields["cycle_period_ms"],
            waiting_cycles=fields["waiting_cycles"],
            start=Start(
                fields["reset_cause"],
                fields["fault"],
                fields["fault_number"],
                fields["fault_address"],
            ),
            protocol_versions=(frame_version,) * 2 if short else (lowest, highest),
            schema_hash=None if short else fields["schema_hash"],
        )

    @property
    def incompatible(self) -> str | None:
        """Why there can be no connection, and the next action; None when there can be one."""
        lowest, highest = self.protocol_versions
        if lowest <= VERSION <= highest:
            return None
        spoken = f"version {lowest}" if lowest == highest else f"versions {lowest} to {highest}"
        action = "Update this client" if lowest > VERSION else "Flash the robot (./wr flash)"
        return (
            f"The robot speaks {spoken} of the PC protocol, this client speaks version {VERSION}. "
            f"{action}, and connect again."
        )

    @property
    def schema_note(self) -> str | None:
        """How the frames differ within one version; None when they are the same."""
        if self.incompatible or self.schema_hash in (SCHEMA_HASH, None):
            return None
        return (
            f"The robot's frames have the layout 0x{self.schema_hash:08x}, this client's "
            f"0x{SCHEMA_HASH:08x}. Fields that only one side has are ignored. To use all fields, "
            "take client and firmware from one version of the project."
        )


@dataclass(frozen=True)
class WheelReport:
    """Set-point, measured values and output of one wheel; None where a value is missing."""

    set_point: ReportedSetPoint
    velocity_rpm: float | None
    current_amperes: float | None
    position_counts: int | None
    tension_volts: float | None
    cut_off: bool
    blind: bool
    rejected_edges: int

    @classmethod
    def from_fields(cls, fields: dict[str, int], wheel: int) -> WheelReport:
        measured = fields["measured"] >> 3 * wheel
        applied = fields["applied"] >> wheel
        return cls(
            set_point=ReportedSetPoint.from_raw(
                fields[f"quantity{wheel}"], fields[f"set_point{wheel}"]
            ),
            velocity_rpm=fields[f"velocity{wheel}"] / 10 if measured & 1 else None,
            current_amperes=fields[f"current{wheel}"] / 1000 if measured & 2 else None,
            position_counts=fields[f"position{wheel}"] if measured & 4 else None,
            tension_volts=fields[f"tension{wheel}"] / 1000 if applied & 1 else None,
            cut_off=bool(fields["cut_offs"] >> wheel & 1),
            blind=bool(fields["blind_wheels"] >> wheel & 1),
            rejected_edges=fields[f"rejected_edges{wheel}"],
        )


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
    armed: bool
    inhibit: str  # why the robot does not follow its set-points
    stop_cause: str  # of the latched protective stop
    stop_wheel: int | None  # wheel that the cause concerns
    stop_sources: tuple[str, ...]  # sources that order stop
    order_id: int
    sent_at_ms: int  # echo of the order in force
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
    round_trip_ms: int | None = None  # from the order to this report, by the clock of this computer
    kind: ClassVar[int] = 0x82
    layout: ClassVar[Layout] = LAYOUTS["Report"]

    @classmethod
    def from_payload(cls, payload: bytes) -> Report:
        """Reads a report. A number that has no name here is shown as a number."""
        fields = cls.layout.unpack(payload)
        flags, source, sources = fields["flags"], fields["source"], fields["stop_sources"]
        front_left, front_right, rear_left, rear_right = (
            WheelReport.from_fields(fields, wheel) for wheel in range(len(WHEELS))
        )
        return cls(
            cycle=fields["cycle"],
            time_ms=fields["time_ms"],
            state=named(STATES, fields["state"], "state"),
            mode=named(MODES, fields["mode"], "mode"),
            source=None if source == NO_SOURCE else named(MODES, source, "source"),
            stop=bool(flags & 1),
            order_read=bool(flags & 2),
            held=bool(flags & 4),
            overran=bool(flags & 8),
            armed=bool(flags & 16),
            inhibit=named(INHIBITS, fields["inhibit"], "reason"),
            stop_cause=named(STOP_CAUSES, fields["stop_cause"], "cause"),
            stop_wheel=None if fields["stop_wheel"] == NO_WHEEL else fields["stop_wheel"],
            stop_sources=tuple(named(MODES, n, "source") for n in range(8) if sources >> n & 1),
            order_id=fields["order_id"],
            sent_at_ms=fields["sent_at"],
            steering_set_point_degrees=fields["steering_set_point"] / 100,
            steering_degrees=fields["steering"] / 100 if fields["measured"] & 1 << 12 else None,
            turn=fields["turn"] if fields["applied"] & 16 else None,
            steering_state=named(STEERING_STATES, fields["steering_state"], "state"),
            left_end=bool(fields["steering_ends"] & 1),
            right_end=bool(fields["steering_ends"] & 2),
            wheels=(front_left, front_right, rear_left, rear_right),
            counters={name: fields[name] for name in COUNTERS},
            report_cycles=fields["report_cycles"],
            awake_cycles=fields["awake_cycles"],
            start_cycles=fields["start_cycles"],
        )

    @property
    def ready(self) -> bool:
        """Whether an order of the PC that moves the robot would be followed now."""
        return self.armed or (self.inhibit == "none" and self.order_read and self.source == "PC")


ToMcu = Hello | Confirm | KeepAlive | Order
FromMcu = Welcome | Report


def to_frame(message: ToMcu, sequence: int) -> Frame:
    version = message.version if isinstance(message, Hello) else VERSION
    return Frame(message.kind, sequence, message.payload(), version)


def from_frame(frame: Frame) -> FromMcu:
    """Returns the message of the MCU in a frame.

    A payload that is longer than known is accepted, a shorter one is not. A Welcome of another
    version is accepted, because it names the versions that the robot supports.
    """
    if frame.kind == Welcome.kind:
        others = frame.version != VERSION
        _check_size(frame, Welcome.layout.size - (Welcome.appended if others else 0))
        return Welcome.from_payload(frame.payload, frame.version)
    if frame.version != VERSION:
        raise MessageError(f"version {frame.version} of the protocol, not {VERSION}")
    if frame.kind == Report.kind:
        _check_size(frame, Report.layout.size)
        return Report.from_payload(frame.payload)
    raise MessageError(f"unknown type of frame 0x{frame.kind:02x}")


def _check_size(frame: Frame, least: int) -> None:
    if len(frame.payload) < least:
        raise MessageError(f"type 0x{frame.kind:02x}: {len(frame.payload)} bytes, not {least}")


def all_wheels(
    quantity: Quantity, value: float
) -> tuple[WheelSetPoint, WheelSetPoint, WheelSetPoint, WheelSetPoint]:
    point = WheelSetPoint(quantity, value)
    return point, point, point, point
