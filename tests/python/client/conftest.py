"""A microcontroller in Python, at the other end of a pseudo-terminal."""

import os
import select
import struct
import threading
import time
import tty
from collections.abc import Iterator
from pathlib import Path

import pytest
from weeding_robot_client.frames import Decoder, Frame, encode
from weeding_robot_client.messages import Report

CYCLE_S = 0.02


def report_payload(cycle: int, order_id: int, stop: int, conditions: tuple[int, ...]) -> bytes:
    """A report of a robot that measures nothing."""
    wheels = [0] * 8
    measures = [0] * 12
    return Report.form.pack(
        *(cycle, cycle * 100, 0, 1, 1, stop, order_id, 0, *wheels, 0, *measures, 0),
        *(0, 0, 0, 0, 0, 0, *[0] * 11, *conditions, 0, 0, 0),
    )


class FakeMcu:
    """Answers Hello, takes Confirm, keeps orders, and reports while it is connected."""

    def __init__(self) -> None:
        self._line, self._client_end = os.openpty()
        tty.setraw(self._line)
        tty.setraw(self._client_end)
        self.path = Path(os.ttyname(self._client_end))
        self.received: list[Frame] = []
        self.session = 0
        self.connected = False
        self.silent = False
        self.noise = b""
        self.stop = 0
        self.start = (1, 0, 0, 0)
        self.conditions = (0,) * 8
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def end(self) -> None:
        self._ended.set()
        self._thread.join()
        os.close(self._line)
        os.close(self._client_end)

    def fall_silent(self) -> None:
        self.silent = True

    def of_kind(self, kind: int) -> list[Frame]:
        return [frame for frame in list(self.received) if frame.kind == kind]

    def _run(self) -> None:
        decoder = Decoder()
        cycle = 0
        order_id = 0
        while not self._ended.is_set():
            cycle += 1
            pulse = time.monotonic() + CYCLE_S
            while (rest := pulse - time.monotonic()) > 0:
                if not select.select([self._line], [], [], rest)[0]:
                    break
                for frame in decoder.feed(os.read(self._line, 4096)):
                    self.received.append(frame)
                    order_id = self._answer(frame, order_id)
            if self.connected and not self.silent:
                self._send(0x82, cycle, report_payload(cycle, order_id, self.stop, self.conditions))

    def _answer(self, frame: Frame, order_id: int) -> int:
        if self.silent:
            return order_id
        if frame.kind == 0x01:
            self.connected = False
            self.session += 1
            welcome = bytes([self.session, 1, 2, 3]) + b"0123abcd" + bytes([100, 0, 4])
            self._send(0x81, 0, welcome + struct.pack("<BBHI", *self.start))
        elif frame.kind == 0x02 and frame.payload[0] == self.session:
            self.connected = True
        elif frame.kind == 0x04:
            return int.from_bytes(frame.payload[:2], "little")
        return order_id

    def _send(self, kind: int, sequence: int, payload: bytes) -> None:
        os.write(self._line, self.noise + encode(Frame(kind, sequence % 256, payload)))


@pytest.fixture
def mcu() -> Iterator[FakeMcu]:
    fake = FakeMcu()
    yield fake
    fake.end()
