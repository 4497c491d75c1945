"""Random bytes and damaged scripts never crash the client. The client accepts each message and each
script, or reports an error.
"""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.python.random_edits import edited, randomised
from weeding_robot_client.frames import MAX_PAYLOAD, Decoder, Frame, encode
from weeding_robot_client.messages import MessageError, Report, Welcome, from_frame
from weeding_robot_client.script import ScriptError, parse

SCRIPT = """\
# three wheels turn
at 0s velocity 0 rpm
at 1.5s velocity 150 rpm steering 10 deg
at 3s wheel 0 tension 1 V
at 4s current -2.5 A steering -5 deg
at 6s stop
at 7s release
at 8s acknowledge
at 9s end
"""

byte = st.integers(0, 255)
frames = st.builds(Frame, byte, byte, st.binary(max_size=MAX_PAYLOAD), byte)


@given(st.lists(frames, max_size=5), st.lists(st.binary(max_size=300), max_size=3))
@randomised(300)
def test_frames_come_back_whole_between_random_bytes(sent: list[Frame], noise: list[bytes]) -> None:
    decoder = Decoder()
    for piece in noise:
        list(decoder.feed(piece))
    list(decoder.feed(b"\0"))
    assert [got for frame in sent for got in decoder.feed(encode(frame))] == sent


@given(st.binary(max_size=2000), st.integers(1, 50))
@randomised(300)
def test_random_bytes_give_the_same_frames_in_any_pieces(data: bytes, size: int) -> None:
    whole, pieces = Decoder(), Decoder()
    frames_of_pieces = [
        frame for at in range(0, len(data), size) for frame in pieces.feed(data[at : at + size])
    ]
    assert list(whole.feed(data)) == frames_of_pieces
    assert whole.dropped == pieces.dropped


@given(st.sampled_from([Welcome.kind, Report.kind, 0, 255]), st.binary(max_size=MAX_PAYLOAD), byte)
@randomised(500)
def test_any_payload_is_a_message_or_refused(kind: int, payload: bytes, version: int) -> None:
    try:
        message = from_frame(Frame(kind, 0, payload, version))
    except MessageError:
        return
    assert message.kind == kind
    assert str(message)


@given(edited(SCRIPT))
@randomised(500)
def test_a_damaged_script_is_a_script_or_has_a_line_with_an_error(text: str) -> None:
    try:
        script = parse(text)
    except ScriptError as error:
        assert str(error).startswith("script")
        return
    assert all(0 <= start <= script.end_s for start, _ in script.wishes)


def test_the_sound_script_is_accepted() -> None:
    assert parse(SCRIPT).end_s == pytest.approx(9)
