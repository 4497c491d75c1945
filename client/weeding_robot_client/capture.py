"""Frames of the line as a capture for Wireshark, and the dissector that shows them."""

from __future__ import annotations

import struct
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType
from typing import Any

from weeding_robot_client.layout import BY_QUANTITY, FRAMES, Field, Layout, value_name

DISSECTOR = Path(__file__).with_name("dissector.lua")
FILTER = "weeding_robot"
USER0 = 147  # link type for private use
SECTION, INTERFACE, PACKET = 0x0A0D0D0A, 1, 6  # blocks of a pcapng file
FLAGS = 2  # option of a packet
RECEIVED, SENT = 1, 2  # values of the direction, as seen from the PC
MOST = 0xFFFF  # bytes of a packet


class Capture(AbstractContextManager["Capture"]):
    """Writes each frame of the line to a pcapng file; without a path it writes nothing.

    A full disk ends the capture, but not the program: the robot continues to drive.
    """

    def __init__(self, path: Path | None, clock: Callable[[], float] = time.time) -> None:
        self._path = path
        self._file = path.open("wb", buffering=0) if path else None
        self._clock = clock
        self._pending = {RECEIVED: bytearray(), SENT: bytearray()}
        self._write(SECTION, struct.pack("<IHHq", 0x1A2B3C4D, 1, 0, -1))
        self._write(INTERFACE, struct.pack("<HHI", USER0, 0, 0))

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._file:
            self._file.close()

    def received(self, data: bytes) -> None:
        self._add(RECEIVED, data)

    def sent(self, data: bytes) -> None:
        self._add(SENT, data)

    def _add(self, direction: int, data: bytes) -> None:
        if self._file is None:
            return
        pending = self._pending[direction]
        for byte in data:
            pending.append(byte)
            if byte == 0 or len(pending) == MOST:
                if len(pending) > 1:  # successive zeros contain no frame
                    self._packet(direction, bytes(pending))
                pending.clear()

    def _packet(self, direction: int, data: bytes) -> None:
        now = round(self._clock() * 1e6)
        head = struct.pack("<IIIII", 0, now >> 32, now & 0xFFFFFFFF, len(data), len(data))
        options = struct.pack("<HHIHH", FLAGS, 4, direction, 0, 0)
        self._write(PACKET, head + data + bytes(-len(data) % 4) + options)

    def _write(self, kind: int, body: bytes) -> None:
        if self._file is None:
            return
        length = struct.pack("<I", len(body) + 12)
        try:
            self._file.write(struct.pack("<I", kind) + length + body + length)
        except OSError as error:
            self._file.close()
            self._file = None
            print(f"\nthe capture {self._path} ends here: {error.strerror}", file=sys.stderr)


def dissector() -> str:
    """Returns a Wireshark dissector of all frames, in Lua."""
    frames = [_frame(layout) for layout in FRAMES.frames.values()]
    head = "-- Made by the client from design/frames.toml.\n"
    return f"{head}local frames = {_lua(frames)}\n\n{DISSECTOR.read_text(encoding='utf-8')}"


def write_dissector(path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(dissector(), encoding="utf-8")


def _frame(layout: Layout) -> dict[str, Any]:
    fields = [_field(layout, field) for field in layout.fields]
    return {"name": layout.name, "type": layout.kind, "size": layout.size, "fields": fields}


def _field(layout: Layout, one: Field) -> dict[str, Any]:
    prefix = f"{FILTER}.{layout.name.lower()}."
    item: dict[str, Any] = {
        **{"label": value_name(one), "filter": prefix + value_name(one)},
        **{"type": one.type, "offset": one.offset, "size": one.size},
        "bits": [
            {"label": name, "filter": prefix + name.replace(" ", "_"), "number": number}
            for number, name in _bits(one)
        ],
    }
    for mask in layout.fields:
        if one.name in mask.valid:
            bit = mask.valid.index(one.name)
            item["valid"] = {"offset": mask.offset, "size": mask.size, "bit": bit}
    names = {entry.number: entry.shown for entry in one.values.entries} if one.values else {}
    names |= {one.none: "none"} if one.none is not None else {}
    if names:
        item["values"] = names
    if one.scale != 1:
        item["scale"] = round(1 / one.scale)
    if one.unit == BY_QUANTITY:
        quantity = layout.of(f"{BY_QUANTITY}{one.wheel}")
        assert quantity.values
        scales = {entry.number: round(1 / entry.scale) for entry in quantity.values.entries}
        item |= {"scale": 1, "scales": scales, "scale_offset": quantity.offset}
    return item


def _bits(one: Field) -> Iterator[tuple[int, str]]:
    yield from ((bit.number, bit.name) for bit in one.bits)
    for entry in one.bits_of.entries if one.bits_of else ():
        yield entry.number, f"{one.name}_{entry.name}"


def _lua(value: Any) -> str:
    if isinstance(value, dict):
        keys = ((f"[{key}]" if isinstance(key, int) else key, one) for key, one in value.items())
        return "{" + ", ".join(f"{key} = {_lua(one)}" for key, one in keys) + "}"
    if isinstance(value, list):
        return "{" + ",\n".join(map(_lua, value)) + "}"
    return f'"{value}"' if isinstance(value, str) else str(value)
