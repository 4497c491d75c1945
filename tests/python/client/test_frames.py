"""The codec of the client, tested with the worked examples of the protocol and with random data."""

import os
import random

import pytest
from cobs import cobs

from tests.python.client.examples import EXAMPLES, examples, present
from weeding_robot_client.frames import (
    MAX_PAYLOAD,
    VERSION,
    Decoder,
    Frame,
    FrameError,
    crc16,
    decode,
    encode,
)

SEED = int(os.environ.get("WR_SEED", "1"))


def test_the_examples_have_the_present_layout() -> None:
    assert EXAMPLES.read_text(encoding="utf-8") == present(), "run tests/python/client/examples.py"


def test_there_are_examples_of_both_directions() -> None:
    assert {example[1] for example in examples()} == {"pc", "mcu"}


@pytest.mark.parametrize("example", examples(), ids=lambda example: example[0].split(":")[0])
def test_worked_example_is_coded_and_decoded(example: list[str]) -> None:
    _, _, head, crc, line = example
    body = bytes.fromhex(head)
    assert crc16(body) == int(crc, 16)
    frame = Frame(body[1], body[2], body[3:], version=body[0])
    assert encode(frame) == bytes.fromhex(line)
    assert list(Decoder().feed(bytes.fromhex(line))) == [frame]


def test_check_value_of_the_crc() -> None:
    assert crc16(b"123456789") == 0x29B1


def test_a_payload_of_200_bytes_is_the_longest() -> None:
    longest = Frame(0x82, 1, bytes(200))
    assert list(Decoder().feed(encode(longest))) == [longest]
    with pytest.raises(FrameError, match="201 bytes, more than 200"):
        encode(Frame(0x82, 1, bytes(201)))


def test_a_frame_on_the_line_has_one_zero_at_its_end() -> None:
    source = random.Random(SEED)
    for size in range(MAX_PAYLOAD + 1):
        line = encode(Frame(0x82, 0, bytes(source.choices((0, 1, 255), k=size))))
        assert line.index(0) == len(line) - 1, f"seed {SEED}"
        assert len(line) == size + 7  # 3 bytes of header, 2 of CRC, 1 of stuffing, 1 zero


def test_random_frames_come_out_of_a_line_that_is_cut_anywhere() -> None:
    source = random.Random(SEED)
    frames = [
        Frame(source.randrange(256), source.randrange(256), source.randbytes(source.randrange(201)))
        for _ in range(300)
    ]
    line = b"".join(encode(frame) for frame in frames)
    decoder = Decoder()
    found = []
    while line:
        size = source.randrange(1, 40)
        found += list(decoder.feed(line[:size]))
        line = line[size:]
    assert found == frames, f"seed {SEED}"
    assert decoder.dropped == 0


def test_a_damaged_frame_is_dropped_and_the_next_one_is_found() -> None:
    source = random.Random(SEED)
    good = Frame(0x82, 7, source.randbytes(96))
    for _ in range(500):
        line = bytearray(encode(good))
        place = source.randrange(len(line) - 1)
        line[place] ^= source.randrange(1, 256)
        decoder = Decoder()
        assert list(decoder.feed(bytes(line) + encode(good))) == [good], f"seed {SEED}"
        assert decoder.dropped >= 1


def test_lost_bytes_drop_at_most_the_two_frames_that_they_touch() -> None:
    frames = [Frame(0x82, number, bytes([number] * 96)) for number in range(4)]
    line = b"".join(encode(frame) for frame in frames)
    size = len(line) // 4
    cut = line[: size + 30] + line[2 * size + 30 :]
    assert list(Decoder().feed(cut)) == [frames[0], frames[3]]


def test_zeros_between_frames_mean_nothing() -> None:
    frame = Frame(1, 0, b"")
    decoder = Decoder()
    assert list(decoder.feed(b"\0\0" + encode(frame) + b"\0\0" + encode(frame))) == [frame] * 2
    assert decoder.dropped == 0


def test_a_frame_that_never_ends_is_dropped_in_bounded_memory() -> None:
    decoder = Decoder()
    for _ in range(1000):
        assert not list(decoder.feed(b"\1" * 100))
    frame = Frame(1, 0, b"")
    assert list(decoder.feed(b"\0" + encode(frame))) == [frame]
    assert decoder.dropped == 1


@pytest.mark.parametrize(
    ("coded", "reason"),
    [
        (cobs.encode(b"\1\2\3\4"), "4 bytes"),
        (b"\5\1", "stuffing"),
        (b"\3\1\0", "stuffing"),
        (cobs.encode(bytes.fromhex("010100c89e")), "CRC"),
        (cobs.encode(bytes(206)), "206 bytes"),
    ],
)
def test_bytes_that_are_no_frame_are_refused(coded: bytes, reason: str) -> None:
    with pytest.raises(FrameError, match=reason):
        decode(coded)


def test_a_frame_of_another_version_is_decoded_with_its_version() -> None:
    body = b"\3\x81\0"
    coded = cobs.encode(body + crc16(body).to_bytes(2, "little"))
    assert decode(coded) == Frame(0x81, 0, b"", version=3)


def test_frames_are_of_version_2() -> None:
    assert VERSION == 2
    assert cobs.decode(encode(Frame(1, 0, b""))[:-1])[0] == 2
