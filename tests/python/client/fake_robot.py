"""A robot in Python, which a client controls through a pseudo-terminal. The robot supports protocol
version 2, arming, protective stop, remote control and emergency stop. Its four wheels turn freely.
"""

from __future__ import annotations

import contextlib
import os
import select
import socket
import struct
import threading
import time
import tty
from dataclasses import dataclass, field
from pathlib import Path

from weeding_robot_client.frames import Decoder, Frame, encode
from weeding_robot_client.layout import LAYOUTS, SCHEMA_HASH

CYCLE_S = 0.02
ARM_S = 0.1
ORDER_S = 0.2
RPM_PER_VOLT = 12.0
COUNTS_PER_TURN = 60
NONE, NO_ORDER, STOP, NOT_ARMED, PROTECTIVE_STOP = range(5)
EMERGENCY_STOP = 1
STEERING_FAULT = 2
DEAD_BAND = 15


@dataclass
class FakeWheel:
    """A wheel that is off the ground."""

    leads_swapped: bool = False
    hall_swapped: bool = False
    hall_dead: bool = False
    blocked: bool = False
    current_reversed: bool = False
    rpm: float = 0.0
    turns: float = 0.0

    def step(self, rpm: float, seconds: float) -> None:
        self.rpm = 0.0 if self.blocked else (-rpm if self.leads_swapped else rpm)
        self.turns += self.rpm / 60 * seconds

    def measured(self, value: float) -> float:
        return 0.0 if self.hall_dead else (-value if self.hall_swapped else value)


@dataclass
class FakeRobot:
    """A robot that reacts to Hello, Confirm and orders. While a client is connected, the robot
    sends a report in each cycle. If ``silent`` is true, the robot sends nothing."""

    versions: tuple[int, int] = (2, 2)
    schema: int = SCHEMA_HASH
    start: tuple[int, int, int, int] = (1, 0, 0, 0)
    conditions: tuple[int, ...] = (1, 0, 0, 0, 0, 0, 0, 0)
    # offset in the report -> byte that replaces the computed byte at this offset
    numbers: dict[int, int] = field(default_factory=dict)
    more: bytes = b""  # bytes that a later protocol version appends to Report and Welcome
    noise: bytes = b""
    silent: bool = False
    restarts: bool = False  # If true, the robot restarts after each Welcome and sends no report.
    has_safety: bool = True
    angle: int = 0  # position of the steering [0.01 degree]
    steering_speed: int = 50  # greatest change of the steering angle in a cycle [0.01 degree]
    steering_reversed: bool = False
    steering_stuck: bool = False
    enable: str = "pc"
    transmitter: bool = True
    # If true, the receiver repeats the last pulses when the transmitter is off.
    hold_last: bool = False
    estop: bool = False
    estop_wired: bool = True
    stop: bool = False
    rc_stop: bool = False
    latched: int = 0
    left_end: bool = False
    right_end: bool = False
    armed: bool = False
    connected: bool = False
    session: int = 0
    wheels: list[FakeWheel] = field(default_factory=lambda: [FakeWheel() for _ in range(4)])
    received: list[Frame] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._line, self._client_end = os.openpty()
        tty.setraw(self._line)
        tty.setraw(self._client_end)
        os.set_blocking(self._line, False)  # If nobody reads the frames, they are lost.
        self.path = Path(os.ttyname(self._client_end))
        self._cycle = 0
        self._order = struct.pack("<HIhBhBhBhBhB", *[0] * 12)
        self._order_at = float("-inf")
        self._unread = False
        self._source = 255
        self._neutral_since: float | None = None
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def end(self) -> None:
        self._ended.set()
        self._thread.join()
        os.close(self._line)
        os.close(self._client_end)

    def of_kind(self, kind: int) -> list[Frame]:
        return [frame for frame in list(self.received) if frame.kind == kind]

    def control(self, words: str) -> str:
        """Executes an action of a simulated operator. Returns an answer in the same form as the
        simulator."""
        match words.split():
            case ["fault" | "repair" as what, "left-end"]:
                self.left_end = what == "fault"
            case ["fault" | "repair" as what, "right-end"]:
                self.right_end = what == "fault"
            case ["rc", "enable", position]:
                self.enable, self.transmitter = position, True
            case ["rc", "off"]:
                self.transmitter = False
            case ["rc", "velocity", "0", "steering", "0"]:
                self.transmitter = True
            case ["estop", what]:
                self.estop = what == "press"
            case ["grip", "0"]:
                pass
            case ["expect", name, "between", low, high]:
                rpm = 10 * self.wheels[int(name[-1])].rpm
                if not int(low) <= rpm <= int(high):
                    return f"{name} is {rpm}"
            case _:
                return f"there is no action '{words}'"
        return "ok"

    # ---- cycle of the robot -----------------------------------------------------------

    def _run(self) -> None:
        decoder = Decoder()
        while not self._ended.is_set():
            self._cycle += 1
            pulse = time.monotonic() + CYCLE_S
            while (rest := pulse - time.monotonic()) > 0:
                if select.select([self._line], [], [], rest)[0]:
                    for frame in decoder.feed(os.read(self._line, 4096)):
                        self.received.append(frame)
                        self._answer(frame)
            self._step()

    def _answer(self, frame: Frame) -> None:
        if frame.kind == 0x04 and frame.payload[20] & 1:
            self.stop = True
        if self.silent:
            return
        if frame.kind == 0x01:
            self._welcome(frame)
        elif frame.version != self.versions[1]:
            return
        elif frame.kind == 0x02 and frame.payload[0] == self.session:
            self.connected = not self.restarts
        elif frame.kind == 0x04 and self.connected:
            self._order, self._order_at, self._unread = frame.payload, time.monotonic(), True

    def _welcome(self, frame: Frame) -> None:
        if self.versions == (1, 1) and frame.version != 1:
            return
        self.connected = False
        self.session += 1
        payload = bytes([self.session, 1, 2, 3]) + b"0123abcd" + bytes([100, 0, 4])
        payload += struct.pack("<BBHI", *self.start)
        if self.versions != (1, 1):
            payload += struct.pack("<BBI", *self.versions, self.schema)
        self._send(0x81, 0, payload + self.more)

    def _send(self, kind: int, sequence: int, payload: bytes) -> None:
        frame = Frame(kind, sequence % 256, payload, self.versions[1])
        with contextlib.suppress(BlockingIOError):
            os.write(self._line, self.noise + encode(frame))

    def _step(self) -> None:
        now = time.monotonic()
        read = self._unread and self.enable != "drive"
        self._unread = False
        values = struct.unpack("<HIhBhBhBhBhB", self._order)
        points, commands = values[3:11], values[11]
        live = now - self._order_at < ORDER_S
        if read:
            self._source = 1
            neutral = not any(points[1::2])
            if neutral and not commands & 1:
                self.stop = False
            if commands & 2:
                self.latched = 0
            neutral = neutral and not commands
            self._neutral_since = (self._neutral_since or now) if neutral else self._neutral_since
        elif self.enable == "drive" and self.transmitter:
            self._source, read = 0, True
        self.rc_stop = self.enable == "stop" or (not self.transmitter and not self.hold_last)
        if self.estop and self.estop_wired:
            self.latched = self.latched or EMERGENCY_STOP
        held = self.stop or self.rc_stop or self.latched or not live
        if held or commands & 2:
            self.armed, self._neutral_since = False, None
        elif self._neutral_since and now - self._neutral_since >= ARM_S:
            self.armed = True
        for number, wheel in enumerate(self.wheels):
            moves = live and (self.armed or not self.has_safety) and self._source == 1
            scale = {0: 0.1, 1: RPM_PER_VOLT / 1000, 2: 0.0}[points[2 * number]]
            wheel.step(points[2 * number + 1] * scale if moves else 0.0, CYCLE_S)
        if live and self.armed and self._source == 1:
            self._steer(values[2])
        if self.connected and not self.silent:
            self._send(0x82, self._cycle, self._report(read, values))

    def _steer(self, target: int) -> None:
        """Turns the steering. If the steering is reversed or stuck, latches a fault."""
        away = target - self.angle
        if abs(away) <= DEAD_BAND:
            return
        if self.steering_reversed or self.steering_stuck:
            if self.steering_reversed:
                self.angle += self.steering_speed if away < 0 else -self.steering_speed
            self.latched = self.latched or STEERING_FAULT
        else:
            self.angle += max(-self.steering_speed, min(self.steering_speed, away))

    def _inhibit(self) -> int:
        if not self.has_safety:
            return NONE
        if self.stop or self.rc_stop:
            return STOP
        if self.latched:
            return PROTECTIVE_STOP
        if self._source == 255:
            return NO_ORDER
        return NONE if self.armed else NOT_ARMED

    def _report(self, read: bool, values: tuple[int, ...]) -> bytes:
        of_pc = self._source == 1
        flags = (self.stop or self.rc_stop) | read << 1 | self.armed << 4
        points = values[3:11] if of_pc else [0] * 8
        measures: list[int] = []
        for wheel in self.wheels:
            amperes = (-1 if wheel.current_reversed else 1) * wheel.rpm / RPM_PER_VOLT
            counts = int(wheel.measured(wheel.turns) * COUNTS_PER_TURN)
            measures += [round(wheel.measured(wheel.rpm) * 10), round(amperes * 300), counts]
        ends = self.left_end | self.right_end << 1
        payload = bytearray(
            struct.pack(
                "<IIBBBBHhBhBhBhBhhhhihhihhihhiH4hbB11H4B4H3I4BIH",
                *(self._cycle, self._cycle * 100, 0, int(self._source != 0), self._source, flags),
                *(values[0] if of_pc else 0, values[2] if of_pc else 0, *points, self.angle),
                *(*measures, 0x1FFF, 0, 0, 0, 0, 0, 0, *[0] * 11),
                *(self.conditions[0], self.conditions[1] | ends, *self.conditions[2:], 0, 0, 0),
                *(self._inhibit(), self.latched, 255, self.rc_stop | self.stop << 1),
                *(values[1], 0),
            )
        )
        for offset, number in self.numbers.items():
            payload[offset] = number
        return bytes(payload).ljust(LAYOUTS["Report"].size, b"\0") + self.more


class FakeControl:
    """A control socket like that of the simulator. It passes each received action to the robot in
    Python, and sends the answer back."""

    def __init__(self, path: Path, robot: FakeRobot) -> None:
        self._robot = robot
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.bind(str(path))
        self._socket.settimeout(0.05)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def end(self) -> None:
        self._ended.set()
        self._thread.join()
        self._socket.close()

    def _run(self) -> None:
        while not self._ended.is_set():
            try:
                words, sender = self._socket.recvfrom(4096)
            except TimeoutError:
                continue
            self._socket.sendto(self._robot.control(words.decode()).encode(), sender)
