"""Frames of the PC protocol: CRC, byte stuffing, and a decoder that finds its place again."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

VERSION = 1
MIN_BODY = 5
MAX_BODY = 128


class FrameError(ValueError):
    """Bytes that are no frame."""


@dataclass(frozen=True)
class Frame:
    kind: int
    sequence: int
    payload: bytes


def crc16(data: bytes) -> int:
    """CRC-16/CCITT-FALSE."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1) ^ 0x1021 if crc & 0x8000 else crc << 1
        crc &= 0xFFFF
    return crc


def stuff(body: bytes) -> bytes:
    """Consistent overhead byte stuffing, without the zero that ends the frame."""
    coded = bytearray()
    for run in body.split(b"\0"):
        rest = run
        while len(rest) >= 254:
            coded += b"\xff" + rest[:254]
            rest = rest[254:]
        coded += bytes([len(rest) + 1]) + rest
    return bytes(coded)


def unstuff(coded: bytes) -> bytes:
    """Reverse of stuff."""
    body = bytearray()
    position = 0
    while position < len(coded):
        code = coded[position]
        run = coded[position + 1 : position + code]
        if code == 0 or len(run) != code - 1 or 0 in run:
            raise FrameError("bad byte stuffing")
        body += run
        position += code
        if code != 0xFF and position < len(coded):
            body.append(0)
    return bytes(body)


def encode(frame: Frame) -> bytes:
    """The bytes on the line."""
    head = bytes([VERSION, frame.kind, frame.sequence]) + frame.payload
    body = head + crc16(head).to_bytes(2, "little")
    if len(body) > MAX_BODY:
        raise FrameError("the payload is too long")
    return stuff(body) + b"\0"


def decode(coded: bytes) -> Frame:
    """The frame in the bytes between two zeros."""
    body = unstuff(coded)
    if not MIN_BODY <= len(body) <= MAX_BODY:
        raise FrameError(f"a body of {len(body)} bytes")
    if crc16(body[:-2]) != int.from_bytes(body[-2:], "little"):
        raise FrameError("wrong CRC")
    if body[0] != VERSION:
        raise FrameError(f"version {body[0]} of the protocol")
    return Frame(body[1], body[2], body[3:-2])


@dataclass
class Decoder:
    """Cuts the bytes of a line into frames; drops and counts what is not a frame."""

    dropped: int = 0
    _kept: bytearray = field(default_factory=bytearray)
    _too_long: bool = False

    def feed(self, data: bytes) -> Iterator[Frame]:
        *ended, rest = data.split(b"\0")
        for piece in ended:
            self._keep(piece)
            coded, too_long = bytes(self._kept), self._too_long
            self._kept.clear()
            self._too_long = False
            if too_long:
                self.dropped += 1
            elif coded:
                try:
                    yield decode(coded)
                except FrameError:
                    self.dropped += 1
        self._keep(rest)

    def _keep(self, piece: bytes) -> None:
        self._kept += piece
        if len(self._kept) > MAX_BODY + 1:
            self._kept.clear()
            self._too_long = True
