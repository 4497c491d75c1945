"""The serial line to the robot, with handshake and keep-alive.

When the robot is silent, the client begins a new handshake.
"""

from __future__ import annotations

import errno
import os
import select
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import replace
from pathlib import Path

import serial

from weeding_robot_client.capture import Capture
from weeding_robot_client.frames import VERSION, Decoder, encode
from weeding_robot_client.messages import (
    CLOCK_MS,
    Confirm,
    Hello,
    KeepAlive,
    MessageError,
    Order,
    Report,
    Start,
    ToMcu,
    Welcome,
    from_frame,
    to_frame,
)

BAUD = 115200
HELLO_EVERY_S = 0.5
OLD_HELLO_AFTER = 3  # every third Hello has version 1, for robots that accept no other version
KEEP_ALIVE_AFTER_S = 0.4
SILENT_AFTER_S = 1.0
READ_BYTES = 4096


class BusyError(OSError):
    """Another program uses the serial port."""


def open_line(path: Path) -> serial.Serial:
    """Opens a serial port or pseudo-terminal for exclusive use, with 115200 baud.

    Reads do not wait for data.
    """
    if not path.exists():
        raise FileNotFoundError(errno.ENOENT, "there is no such file", str(path))
    try:
        return serial.Serial(str(path), BAUD, timeout=0, write_timeout=0, exclusive=True)
    except serial.SerialException as error:
        if error.errno == errno.EAGAIN:
            raise BusyError(
                errno.EBUSY, "another program uses it: end that program", str(path)
            ) from error
        if error.errno in (errno.EACCES, errno.EBUSY):
            raise OSError(error.errno, os.strerror(error.errno), str(path)) from error
        raise OSError(errno.ENOTTY, "it is not a serial port", str(path)) from error


def clock_ms(seconds: float) -> int:
    """Converts a time of this computer [s] to the time that an order contains [ms]."""
    return int(seconds * 1000) % CLOCK_MS


class Link(AbstractContextManager["Link"]):
    """A connection to the robot. Call service() at least once in each control cycle, or iterate
    over reports().

    ``connected`` is true from the first report after a handshake until the robot is silent for a
    second. Reports of a connection that another program began are ignored. If the serial port
    disappears, it is opened again as soon as its path exists. When the robot answers with another
    version of the protocol, no connection is possible, and ``incompatible`` contains the reason.
    """

    def __init__(self, path: Path, clock: Callable[[], float] = time.monotonic) -> None:
        self.path = path
        self.welcome: Welcome | None = None
        self.connected = False
        self.damaged = 0
        self.capture = Capture(None)
        self.incompatible: str | None = None
        self.unreported: Start | None = None  # the start, if the robot sent a Welcome but no report
        self.handshake_ms: int | None = None  # time from Hello to Welcome
        self._clock = clock
        self._line: serial.Serial | None = open_line(path)
        self._begin()

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        if self._line is not None:
            self._line.close()
            self._line = None
        self.connected = False

    def service(self, timeout_s: float = 0.0) -> list[Report]:
        """Waits for bytes for at most the given time. Answers the frames. Returns the reports."""
        reports = []
        for message in self._receive(timeout_s):
            if isinstance(message, Welcome):
                self._answer(message)
            elif self.welcome:
                self._heard_at = self._clock()
                self.connected = True
                self.unreported = None
                reports.append(self._timed(message))
        self._keep_up()
        return reports

    def send(self, order: Order) -> bool:
        """Sends an order with the present time. Returns whether the order could be sent.

        A stop is also sent without a connection, because the robot executes it in every state.
        """
        if not (self.connected or order.stop):
            return False
        return self._send(replace(order, sent_at_ms=clock_ms(self._clock())))

    def reports(self, timeout_s: float | None = None) -> Iterator[Report]:
        """Yields all reports until no report arrives for the given time.

        If the connection is lost and begins again, the reports continue.
        """
        last = self._clock()
        while timeout_s is None or self._clock() - last < timeout_s:
            for report in self.service(0.05):
                last = self._clock()
                yield report

    def _answer(self, welcome: Welcome) -> None:
        self._heard_at = self._clock()
        self.connected = False
        self.incompatible = welcome.incompatible
        if self.incompatible is None:
            self.handshake_ms = round((self._heard_at - self._hello_at) * 1000)
            self.welcome = welcome
            self._send(Confirm(welcome.session))

    def _timed(self, report: Report) -> Report:
        """Returns the report with the round trip: the time from the sending of the order to the
        arrival of the report.

        The round trip is added only if the robot has read an order of the PC in the cycle of the
        report.
        """
        if not (report.order_read and report.source == "PC"):
            return report
        passed = (clock_ms(self._clock()) - report.sent_at_ms) % CLOCK_MS
        return replace(report, round_trip_ms=passed)

    def _begin(self) -> None:
        self._decoder = Decoder()
        self._unsent = bytearray()
        self._sequence = 0
        self._hellos = 0
        self._heard_at = self._sent_at = self._hello_at = float("-inf")
        self.connected = False
        self.welcome = None
        self.unreported = None

    def _keep_up(self) -> None:
        """Executes the actions that are due: opens the serial port again, begins a handshake, or
        sends a keep-alive."""
        now = self._clock()
        if self._line is None:
            try:
                self._line = open_line(self.path)
            except OSError:
                return
            self._begin()
        if self.connected and now - self._heard_at >= SILENT_AFTER_S:
            self.connected = False
            self.welcome = None
        if self.connected:
            if now - self._sent_at >= KEEP_ALIVE_AFTER_S:
                self._send(KeepAlive())
        elif now - max(self._hello_at, self._heard_at) >= HELLO_EVERY_S:
            self._hello_at = now
            self._write(b"\0")
            self._hellos += 1
            old = self._hellos % OLD_HELLO_AFTER == 0
            self._send(Hello(1 if old else VERSION))

    def _send(self, message: ToMcu) -> bool:
        if isinstance(message, Hello):
            self._sequence = 0
            self.unreported = self.welcome.start if self.welcome else self.unreported
            self.welcome = None
        sent = self._write(encode(to_frame(message, self._sequence)))
        if sent:
            self._sequence = (self._sequence + 1) % 256
            self._sent_at = self._clock()
        return sent

    def _write(self, data: bytes) -> bool:
        """Sends bytes. Stores those bytes that the serial port does not accept yet.

        Returns false if no port is open, or if too many bytes are stored.
        """
        if self._line is None or len(self._unsent) > READ_BYTES:
            return False
        self._unsent += data
        self.capture.sent(data)
        return self._flush()

    def _flush(self) -> bool:
        try:
            if self._unsent and self._line is not None:
                del self._unsent[: os.write(self._line.fileno(), self._unsent)]
        except BlockingIOError:
            pass
        except OSError:
            self.close()
            return False
        return True

    def _receive(self, timeout_s: float) -> Iterator[Welcome | Report]:
        if self._line is None:
            time.sleep(timeout_s)
            return
        self._flush()
        try:
            select.select([self._line], [], [], timeout_s)
            data = self._line.read(READ_BYTES)
        except OSError:
            self.close()
            return
        self.capture.received(data)
        dropped = self._decoder.dropped
        for frame in self._decoder.feed(data):
            try:
                yield from_frame(frame)
            except MessageError:
                self.damaged += 1
        self.damaged += self._decoder.dropped - dropped
