"""Messages of the PC protocol, with values in SI units or in common units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any, ClassVar

from weeding_robot_client.frames import VERSION, Frame
from weeding_robot_client.layout import FRAMES, LAYOUTS, SCHEMA_HASH, Layout, scaled, text_of

WHEELS = ("front left", "front right", "rear left", "rear right")
STEERING = LAYOUTS["Order"].of("steering_set_point")
UNITS = {entry.shown: entry.unit for entry in FRAMES.enumerations["quantity"].entries}
CLOCK_MS = 1 << 32  # the sending time in an order restarts at 0 when it reaches this value [ms]


class MessageError(ValueError):
    """A frame that is not a message, or a message that the protocol does not allow."""


class Quantity(Enum):
    """The quantity of a set-point. It has a number in a frame, a unit, a number of steps per unit,
    and a limit."""

    VELOCITY = "Velocity"
    TENSION = "Tension"
    CURRENT = "Current"

    def __init__(self, name: str) -> None:
        (entry,) = (one for one in FRAMES.enumerations["quantity"].entries if one.name == name)
        assert entry.limit is not None
        self.code = entry.number
        self.unit = entry.unit
        self.scale = round(1 / entry.scale)
        self.limit = entry.limit / self.scale


@dataclass(frozen=True)
class WheelSetPoint:
    """A set-point: a value in the unit of its quantity. A velocity is the velocity of the motor
    shaft."""

    quantity: Quantity
    value: float

    def __post_init__(self) -> None:
        if not abs(self.value) <= self.quantity.limit:
            raise MessageError(
                f"{self.value} {self.quantity.unit} is not within "
                f"-{self.quantity.limit} to {self.quantity.limit}"
            )

    def raw(self) -> tuple[int, int]:
        return self.quantity.code, round(self.value * self.quantity.scale)

    def __str__(self) -> str:
        return f"{self.value:g} {self.quantity.unit}"


@dataclass(frozen=True)
class ReportedSetPoint:
    """A set-point in a report. Its number may be out of range, and its quantity may be unknown."""

    value: float
    unit: str

    def __str__(self) -> str:
        return f"{self.value:g} {self.unit}"


@dataclass(frozen=True)
class Hello:
    """A request for a connection, with the versions and the layout of this client."""

    version: int = VERSION  # version of the frame
    kind: ClassVar[int] = LAYOUTS["Hello"].kind

    def payload(self) -> bytes:
        if self.version != VERSION:
            return b""  # other versions have another layout, but all versions accept an empty Hello
        return LAYOUTS["Hello"].pack(
            lowest_version=VERSION, highest_version=VERSION, schema_hash=SCHEMA_HASH
        )


@dataclass(frozen=True)
class Confirm:
    session: int
    kind: ClassVar[int] = LAYOUTS["Confirm"].kind

    def payload(self) -> bytes:
        return LAYOUTS["Confirm"].pack(session=self.session)


@dataclass(frozen=True)
class KeepAlive:
    kind: ClassVar[int] = LAYOUTS["KeepAlive"].kind

    def payload(self) -> bytes:
        return b""


@dataclass(frozen=True)
class Order:
    """One complete set of set-points. ``sent_at_ms`` is a time of this computer's clock."""

    order_id: int
    steering_degrees: float  # positive to the left
    wheels: tuple[WheelSetPoint, WheelSetPoint, WheelSetPoint, WheelSetPoint]
    stop: bool = False
    acknowledge: bool = False
    sent_at_ms: int = 0
    kind: ClassVar[int] = LAYOUTS["Order"].kind
    steering_limit_degrees: ClassVar[float] = scaled(STEERING.limit or 0, STEERING.scale)

    def __post_init__(self) -> None:
        if not abs(self.steering_degrees) <= self.steering_limit_degrees:
            limit = self.steering_limit_degrees
            raise MessageError(
                f"{self.steering_degrees} degrees is not within -{limit:g} to {limit:g}"
            )
        if not 0 <= self.order_id <= 0xFFFF:
            raise MessageError(f"order id {self.order_id} is not within 0 to 65535")

    def payload(self) -> bytes:
        wheels: dict[str, int] = {}
        for number, wheel in enumerate(self.wheels):
            wheels[f"quantity{number}"], wheels[f"set_point{number}"] = wheel.raw()
        layout = LAYOUTS["Order"]
        return layout.pack(
            order_id=self.order_id,
            sent_at=self.sent_at_ms % CLOCK_MS,
            steering_set_point=round(self.steering_degrees / STEERING.scale),
            commands=layout.of("commands").number(stop=self.stop, acknowledge=self.acknowledge),
            **wheels,
        )


@dataclass(frozen=True)
class Start:
    """The cause of the start and the fault before the start, as numbers of the protocol."""

    cause: int
    fault: int = 0
    number: int = 0
    address: int = 0

    @property
    def faulted(self) -> bool:
        return self.fault != 0

    def __str__(self) -> str:
        cause = FRAMES.enumerations["reset cause"].shown(self.cause)
        if not self.faulted:
            return cause
        known = FRAMES.enumerations["fault kind"].find(self.fault)
        form = known.shown if known else f"fault {self.fault}, number {{number}}"
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
    schema_hash: int | None = SCHEMA_HASH  # None: the robot reports no hash
    kind: ClassVar[int] = LAYOUTS["Welcome"].kind
    layout: ClassVar[Layout] = LAYOUTS["Welcome"]
    appended: ClassVar[int] = 6  # bytes that are missing in version 1

    @classmethod
    def from_payload(cls, payload: bytes, frame_version: int = VERSION) -> Welcome:
        """Reads a Welcome.

        A Welcome of version 1 does not contain the versions that the robot supports.
        """
        short = len(payload) < cls.layout.size
        fields = cls.layout.unpack(payload + bytes(cls.appended))
        lowest, highest = fields["lowest_version"], fields["highest_version"]
        return cls(
            session=fields["session"],
            version=(fields["firmware_major"], fields["firmware_minor"], fields["firmware_patch"]),
            build_id=text_of(fields["build_id"]),
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
        """Returns the reason why no connection is possible, and the next action.

        Returns None when a connection is possible.
        """
        lowest, highest = self.protocol_versions
        if lowest <= VERSION <= highest:
            return None
        spoken = f"version {lowest}" if lowest == highest else f"versions {lowest} to {highest}"
        action = "Update this client" if lowest > VERSION else "Flash the robot (./wr flash)"
        return (
            f"The robot uses {spoken} of the PC protocol. This client uses version {VERSION}. "
            f"{action}, and connect again."
        )

    @property
    def schema_note(self) -> str | None:
        """Returns a text about the difference between the layouts of the robot and this client.

        Returns None when the layouts are equal.
        """
        if self.incompatible or self.schema_hash in (SCHEMA_HASH, None):
            return None
        return (
            f"The frames of the robot have the layout 0x{self.schema_hash:08x}, but this client "
            f"uses the layout 0x{SCHEMA_HASH:08x}. Additional fields are ignored, but a frame that "
            "is too short for its receiver is dropped. Use client and firmware of one version of "
            "the project."
        )


@dataclass(frozen=True)
class WheelReport:
    """The set-point, the measured values and the output of one wheel. A missing value is None."""

    set_point: ReportedSetPoint
    velocity_rpm: float | None
    current_amperes: float | None
    position_counts: int | None
    tension_volts: float | None
    cut_off: bool
    blind: bool
    rejected_edges: int

    @classmethod
    def from_values(cls, values: Mapping[str, Any], wheel: int) -> WheelReport:
        unit = UNITS.get(values[f"quantity{wheel}"], f"({values[f'quantity{wheel}']})")
        return cls(
            set_point=ReportedSetPoint(float(values[f"set_point{wheel}"]), unit),
            velocity_rpm=values[f"velocity{wheel}_rpm"],
            current_amperes=values[f"current{wheel}_amperes"],
            position_counts=values[f"position{wheel}_counts"],
            tension_volts=values[f"tension{wheel}_volts"],
            cut_off=values[f"cut_off{wheel}"],
            blind=values[f"blind{wheel}"],
            rejected_edges=values[f"rejected_edges{wheel}"],
        )


@dataclass(frozen=True)
class Report:
    cycle: int
    time_ms: int
    state: str
    mode: str
    source: str | None  # None: no order was read since the start
    stop: bool
    order_read: bool
    held: bool
    overran: bool
    armed: bool
    inhibit: str  # reason why the robot does not follow its set-points
    stop_cause: str  # cause of the latched protective stop
    stop_wheel: int | None  # wheel that caused the protective stop
    stop_sources: tuple[str, ...]  # sources that order a stop
    order_id: int
    sent_at_ms: int  # sending time that the order in force contains
    steering_set_point_degrees: float
    steering_degrees: float | None
    turn: int | None  # -1 right, 0 none, 1 left
    steering_state: str
    left_end: bool
    right_end: bool
    wheels: tuple[WheelReport, WheelReport, WheelReport, WheelReport]
    counters: dict[str, int]
    # The next three fields are numbers of processor cycles, or 0 if the platform does not count
    # them.
    report_cycles: int
    awake_cycles: int
    start_cycles: int
    values: Mapping[str, Any]  # all values, by name and unit
    # time from the order to this report, by the clock of this computer
    round_trip_ms: int | None = None
    kind: ClassVar[int] = LAYOUTS["Report"].kind
    layout: ClassVar[Layout] = LAYOUTS["Report"]

    @classmethod
    def from_payload(cls, payload: bytes) -> Report:
        """Reads a report. The text for an unknown number contains the number."""
        values = cls.layout.decode(payload)
        front_left, front_right, rear_left, rear_right = (
            WheelReport.from_values(values, wheel) for wheel in range(len(WHEELS))
        )
        names = cls.__dataclass_fields__.keys() & values.keys()
        return cls(
            **{name: values[name] for name in names},
            wheels=(front_left, front_right, rear_left, rear_right),
            counters={
                field.name: values[field.name] for field in cls.layout.fields if field.counts
            },
            values=values,
        )

    @property
    def ready(self) -> bool:
        """Returns whether the robot reads the orders of the PC and would now follow an order to
        move."""
        if self.mode != "PC":
            return False
        return self.armed or (self.inhibit == "none" and self.order_read and self.source == "PC")


ToMcu = Hello | Confirm | KeepAlive | Order
FromMcu = Welcome | Report


def to_frame(message: ToMcu, sequence: int) -> Frame:
    version = message.version if isinstance(message, Hello) else VERSION
    return Frame(message.kind, sequence, message.payload(), version)


def from_frame(frame: Frame) -> FromMcu:
    """Returns the message in a frame from the MCU.

    A payload may be longer than expected, but not shorter. A Welcome of another version is
    accepted, because it contains the versions that the robot supports.
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
