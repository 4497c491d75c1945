"""The serial line to the robot: handshake, keep-alive, and a new handshake when it falls silent."""

from __future__ import annotations

import os
import select
import termios
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import TracebackType

from weeding_robot_client.frames import Decoder, encode
from weeding_robot_client.messages import (
    Confirm,
    Hello,
    KeepAlive,
    MessageError,
    Order,
    Report,
    ToMcu,
    Welcome,
    from_frame,
    to_frame,
)

HELLO_EVERY_S = 0.5
KEEP_ALIVE_AFTER_S = 0.4
SILENT_AFTER_S = 1.0
READ_BYTES = 4096


def open_line(path: Path) -> int:
    """Opens a serial port or pseudo-terminal: 115200 baud, 8 data bits, raw, never waiting."""
    line = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    try:
        settings = termios.tcgetattr(line)
        settings[0] = 0
        settings[1] = 0
        settings[2] = termios.CS8 | termios.CREAD | termios.CLOCAL
        settings[3] = 0
        settings[4] = settings[5] = termios.B115200
        settings[6][termios.VMIN] = settings[6][termios.VTIME] = 0
        termios.tcsetattr(line, termios.TCSANOW, settings)
        termios.tcflush(line, termios.TCIFLUSH)
    except termios.error as error:
        os.close(line)
        raise OSError(f"{path} is not a serial port") from error
    return line


class Link:
    """A connection to the robot. Call service() at least every 100 ms, or iterate over reports().

    ``connected`` is true from the first report after a handshake until the robot is silent for a
    second. Reports of a connection that another program began are not taken. A line that went
    away is opened again as soon as its path exists.
    """

    def __init__(self, path: Path, clock: Callable[[], float] = time.monotonic) -> None:
        self.path = path
        self.welcome: Welcome | None = None
        self.connected = False
        self.damaged = 0
        self._clock = clock
        self._line: int | None = open_line(path)
        self._begin()

    def __enter__(self) -> Link:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        if self._line is not None:
            os.close(self._line)
            self._line = None
        self.connected = False

    def service(self, timeout_s: float = 0.0) -> list[Report]:
        """Waits for bytes for at most the time given, answers them, and returns the reports."""
        reports = []
        for message in self._receive(timeout_s):
            if isinstance(message, Welcome):
                self._heard_at = self._clock()
                self.welcome = message
                self.connected = False
                self._send(Confirm(message.session))
            elif self.welcome:
                self._heard_at = self._clock()
                self.connected = True
                reports.append(message)
        self._keep_up()
        return reports

    def send(self, order: Order) -> bool:
        """Sends an order, and returns whether there is a connection to send it on."""
        return self.connected and self._send(order)

    def reports(self, timeout_s: float | None = None) -> Iterator[Report]:
        """All reports, across lost connections, until none came for the time given."""
        last = self._clock()
        while timeout_s is None or self._clock() - last < timeout_s:
            for report in self.service(0.05):
                last = self._clock()
                yield report

    def _begin(self) -> None:
        self._decoder = Decoder()
        self._unsent = bytearray()
        self._sequence = 0
        self._heard_at = self._sent_at = self._hello_at = float("-inf")
        self.connected = False
        self.welcome = None

    def _keep_up(self) -> None:
        """What the time demands: open the line again, begin again, or keep the connection."""
        now = self._clock()
        if self._line is None:
            try:
                self._line = open_line(self.path)
            except OSError:
                return
            self._begin()
        if now - self._heard_at >= SILENT_AFTER_S:
            self.connected = False
        if self.connected:
            if now - self._sent_at >= KEEP_ALIVE_AFTER_S:
                self._send(KeepAlive())
        elif now - max(self._hello_at, self._heard_at) >= HELLO_EVERY_S:
            self._hello_at = now
            self._write(b"\0")
            self._send(Hello())

    def _send(self, message: ToMcu) -> bool:
        if isinstance(message, Hello):
            self._sequence = 0
            self.welcome = None
        sent = self._write(encode(to_frame(message, self._sequence)))
        if sent:
            self._sequence = (self._sequence + 1) % 256
            self._sent_at = self._clock()
        return sent

    def _write(self, data: bytes) -> bool:
        """Sends the bytes, some of them later when the line is slow; false when it is full."""
        if self._line is None or len(self._unsent) > READ_BYTES:
            return False
        self._unsent += data
        return self._flush()

    def _flush(self) -> bool:
        try:
            while self._unsent and self._line is not None:
                del self._unsent[: os.write(self._line, self._unsent)]
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
        data = b""
        try:
            if select.select([self._line], [], [], timeout_s)[0]:
                data = os.read(self._line, READ_BYTES)
                if not data:
                    raise OSError("the line was closed")
        except BlockingIOError:
            return
        except OSError:
            self.close()
            return
        dropped = self._decoder.dropped
        for frame in self._decoder.feed(data):
            try:
                yield from_frame(frame)
            except MessageError:
                self.damaged += 1
        self.damaged += self._decoder.dropped - dropped
