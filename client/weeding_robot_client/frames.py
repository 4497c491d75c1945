"""Frames of the PC protocol, with CRC, byte stuffing and a decoder.

The decoder resynchronises at each zero byte.
"""

from __future__ import annotations

import binascii
from collections.abc import Iterator
from dataclasses import dataclass, field

from cobs import cobs

VERSION = 2
MAX_PAYLOAD = 200
MIN_BODY = 5
MAX_BODY = MIN_BODY + MAX_PAYLOAD
CRC_START = 0xFFFF  # initial value of CRC-16/CCITT-FALSE


class FrameError(ValueError):
    """Bytes that are not a frame."""


@dataclass(frozen=True)
class Frame:
    kind: int
    sequence: int
    payload: bytes
    version: int = VERSION


def crc16(data: bytes) -> int:
    """Returns the CRC-16/CCITT-FALSE of the bytes."""
    return binascii.crc_hqx(data, CRC_START)


def encode(frame: Frame) -> bytes:
    """Returns the bytes that are sent on the serial line for a frame."""
    head = bytes([frame.version, frame.kind, frame.sequence]) + frame.payload
    body = head + crc16(head).to_bytes(2, "little")
    if len(body) > MAX_BODY:
        raise FrameError(f"the payload has {len(frame.payload)} bytes, more than {MAX_PAYLOAD}")
    coded: bytes = cobs.encode(body)
    return coded + b"\0"


def decode(coded: bytes) -> Frame:
    """Returns the frame in the bytes between two zeros. The version of the frame is not checked."""
    try:
        body: bytes = cobs.decode(coded)
    except cobs.DecodeError as error:
        raise FrameError(f"bad byte stuffing: {error}") from error
    if not MIN_BODY <= len(body) <= MAX_BODY:
        raise FrameError(
            f"the body has {len(body)} bytes, but must have {MIN_BODY} to {MAX_BODY} bytes"
        )
    if crc16(body[:-2]) != int.from_bytes(body[-2:], "little"):
        raise FrameError("wrong CRC")
    return Frame(body[1], body[2], body[3:-2], body[0])


@dataclass
class Decoder:
    """Splits received bytes into frames. Drops each piece that is not a frame, and counts it."""

    dropped: int = 0
    _pending: bytearray = field(default_factory=bytearray)
    _too_long: bool = False

    def feed(self, data: bytes) -> Iterator[Frame]:
        *ended, rest = data.split(b"\0")
        for piece in ended:
            self._append(piece)
            coded, too_long = bytes(self._pending), self._too_long
            self._pending.clear()
            self._too_long = False
            if too_long:
                self.dropped += 1
            elif coded:
                try:
                    yield decode(coded)
                except FrameError:
                    self.dropped += 1
        self._append(rest)

    def _append(self, piece: bytes) -> None:
        self._pending += piece
        if len(self._pending) > MAX_BODY + 1:
            self._pending.clear()
            self._too_long = True
