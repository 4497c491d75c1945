"""The capture of the serial line. Wireshark shows the same values that the client decodes."""

import os
import random
import shutil
import struct
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest

from weeding_robot_client.capture import FILTER, Capture, dissector, write_dissector
from weeding_robot_client.frames import Frame, decode, encode
from weeding_robot_client.layout import CODES, LAYOUTS, Layout
from weeding_robot_client.link import Link
from weeding_robot_client.options import open_capture

SEED = int(os.environ.get("WR_SEED", "1"))
tshark = pytest.mark.skipif(not shutil.which("tshark"), reason="tshark is not installed")


def frames_shown(capture: Path, folder: Path) -> list[dict[str, str]]:
    """Returns a dictionary for each packet. The dictionary contains the fields that the dissector
    adds to this packet: filter name -> value."""
    script = folder / "dissector.lua"
    write_dissector(script)
    done = subprocess.run(
        ["tshark", "-X", f"lua_script:{script}", "-r", str(capture), "-T", "pdml"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert "error" not in done.stderr.lower(), done.stderr
    packets = ET.fromstring(done.stdout).findall("packet")
    return [
        {
            str(field.get("name")).removeprefix(f"{FILTER}."): value_of(field)
            for field in packet.iter("field")
            if str(field.get("name")).startswith(f"{FILTER}.")
        }
        for packet in packets
    ]


def value_of(field: ET.Element) -> str:
    """Returns the text that the dissector shows for a value. If the dissector shows no text,
    returns the value itself."""
    words = str(field.get("showname"))
    _, _, named = words.partition(": ")
    text = named.rpartition(" (")[0] if named.endswith(")") else "Unknown"
    return str(field.get("show")) if text == "Unknown" else text


def packet(kind: int, payload: bytes) -> bytes:
    return encode(Frame(kind, 7, payload))


def random_payload(layout: Layout, source: random.Random) -> bytes:
    values: dict[str, Any] = {}
    for field in layout.fields:
        bits = 8 * field.size
        number = source.randrange(1 << bits)
        if field.values:
            number = source.choice([entry.number for entry in field.values.entries])
        elif field.type.startswith("i"):
            number -= 1 << (bits - 1)
        values[field.name] = b"0123abcd" if field.type == "char8" else number
    return struct.pack("<" + "".join(CODES[f.type] for f in layout.fields), *values.values())


def assert_same(shown: dict[str, str], layout: Layout, payload: bytes) -> None:
    """Checks that the dissector shows every value of the frame in the same way as the client."""
    prefix = f"{layout.name.lower()}."
    for name, value in layout.decode(payload).items():
        text = shown.get(prefix + name)
        if value is None:
            assert text in (None, "none"), name
        elif isinstance(value, bool):
            assert text in (("1", "True") if value else ("0", "False")), name
        elif isinstance(value, tuple):
            start = f"{prefix}{name}_"
            bits = {key.removeprefix(start): shown[key] for key in shown if key.startswith(start)}
            known = [bit for bit, is_set in bits.items() if is_set in ("1", "True")]
            assert known == [one for one in value if " " not in one], name
        elif isinstance(value, str):
            assert text == value, name
        else:
            assert text is not None, name
            assert float(text) == pytest.approx(value), name


@tshark
def test_wireshark_shows_every_field_as_the_client_decodes_it(tmp_path: Path) -> None:
    source = random.Random(SEED)
    expected = []
    with Capture(tmp_path / "line.pcapng") as capture:
        for layout in [*LAYOUTS.values()] * 30:
            payload = random_payload(layout, source)
            expected.append((layout, payload))
            add = capture.sent if layout.sender == "PC" else capture.received
            add(packet(layout.kind, payload))
    shown = frames_shown(tmp_path / "line.pcapng", tmp_path)
    assert len(shown) == len(expected)
    for fields, (layout, payload) in zip(shown, expected, strict=True):
        assert "error" not in fields
        assert (fields["version"], fields["sequence"]) == ("2", "7")
        assert int(fields["type"], 16) == layout.kind
        assert_same(fields, layout, payload)


@tshark
def test_a_recorded_line_is_shown_frame_by_frame(mcu: Any, tmp_path: Path) -> None:
    path = tmp_path / "line.pcapng"
    with Link(mcu.path) as link, Capture(path) as link.capture:
        for number, _ in enumerate(link.reports(timeout_s=5)):
            if number == 5:
                break
    sent = [int(fields["type"], 16) for fields in frames_shown(path, tmp_path)]
    assert sent[:3] == [0x01, 0x81, 0x02]
    assert sent.count(0x82) >= 6


@tshark
@pytest.mark.parametrize(
    ("line", "error"),
    [
        (b"\x09\x01\x02\x00", "damaged byte stuffing"),
        (b"\x03\x02\x82\x00", "body too short"),
        (packet(0x03, b"").replace(b"\x07", b"\x08"), "wrong CRC"),
        (packet(0x44, b""), "unknown type"),
    ],
)
def test_a_bad_frame_is_marked(line: bytes, error: str, tmp_path: Path) -> None:
    with Capture(tmp_path / "line.pcapng") as capture:
        capture.received(line)
    (fields,) = frames_shown(tmp_path / "line.pcapng", tmp_path)
    assert fields["error"] == error


def packets_of(path: Path) -> list[tuple[int, bytes]]:
    """Returns the direction and the bytes of each packet. Skips the blocks without a packet."""
    data = path.read_bytes()
    found = []
    while data:
        kind, length = struct.unpack_from("<II", data)
        body, data = data[8 : length - 4], data[length:]
        if kind == 6:
            size = struct.unpack_from("<I", body, 12)[0]
            flags = struct.unpack_from("<I", body, 20 + size + (-size % 4) + 4)[0]
            found.append((flags, body[20 : 20 + size]))
    return found


def test_frames_that_come_in_pieces_are_one_packet_each(tmp_path: Path) -> None:
    frame = packet(0x03, b"")
    with Capture(tmp_path / "line.pcapng", clock=lambda: 1.5) as capture:
        capture.received(b"\0" + frame[:2])
        capture.sent(b"\0" + frame)
        capture.received(frame[2:] + frame + frame[:1])
    assert packets_of(tmp_path / "line.pcapng") == [(2, frame), (1, frame), (1, frame)]
    assert decode(frame[:-1]).kind == 0x03


def test_without_a_path_there_is_no_capture() -> None:
    with Capture(None) as capture:
        capture.sent(packet(0x03, b""))


def test_a_full_disk_ends_the_capture_and_not_the_program(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with Capture(Path("/dev/full")) as capture:
        capture.sent(packet(0x03, b""))
    assert capsys.readouterr().err.count("the capture /dev/full ends here") == 1


def test_a_capture_that_cannot_be_opened_is_explained(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert open_capture(tmp_path / "none" / "line.pcapng") is None
    assert "Name another file" in capsys.readouterr().err


def test_the_dissector_names_every_value_as_the_recording_does() -> None:
    text = dissector()
    for layout in LAYOUTS.values():
        for name in layout.value_names:
            assert f'filter = "{FILTER}.{layout.name.lower()}.{name}"' in text
