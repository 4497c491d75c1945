"""The worked examples of the protocol. This script converts the file of the examples to the present
layout of the frames.

New fields at the end of a payload get the value 0. The schema hash is replaced by the present hash.
"""

from __future__ import annotations

from pathlib import Path

from weeding_robot_client.frames import Frame, crc16, encode
from weeding_robot_client.layout import LAYOUTS, SCHEMA_HASH

EXAMPLES = Path(__file__).parents[3] / "docs" / "protocol_examples.txt"
BY_KIND = {layout.kind: layout for layout in LAYOUTS.values()}


def examples() -> list[list[str]]:
    lines = EXAMPLES.read_text(encoding="utf-8").splitlines()[1:]
    return [[cell.strip() for cell in line.split(";")] for line in lines]


def with_present_layout(name: str, sender: str, old: str) -> str:
    """Converts an example to the present layout. Returns the text line for the file of examples.
    ``old`` is the body of the example in the previous layout."""
    version, kind, sequence, *values = bytes.fromhex(old)
    layout = BY_KIND[kind]
    payload = bytearray(values).ljust(layout.size, b"\0")
    if "schema_hash" in layout.names:
        offset = layout.of("schema_hash").offset
        payload[offset : offset + 4] = SCHEMA_HASH.to_bytes(4, "little")
    body = bytes((version, kind, sequence, *payload))
    line = encode(Frame(kind, sequence, bytes(payload), version=version))
    return f"{name}; {sender}; {body.hex()}; {crc16(body):04x}; {line.hex()}"


def present() -> str:
    """Returns the text of the file in the present layout."""
    head = EXAMPLES.read_text(encoding="utf-8").splitlines()[0]
    return "\n".join([head, *(with_present_layout(*one[:3]) for one in examples())]) + "\n"


if __name__ == "__main__":
    EXAMPLES.write_text(present(), encoding="utf-8")
