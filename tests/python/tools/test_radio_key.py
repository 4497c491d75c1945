"""The key of the Bluetooth device. The key is written into a copy of the firmware image."""

from pathlib import Path

import pytest

from tools.radio_key import KEY_AT, KeyFileError, read_key, with_key

DIGITS = "00112233445566778899aabbccddeeff"
IMAGE = bytes(KEY_AT) + b"\xff" * 16 + b"code"


def key_file(folder: Path, text: str) -> Path:
    file = folder / "robot.key"
    file.write_text(text)
    return file


def test_a_key_is_32_hexadecimal_digits(tmp_path: Path) -> None:
    assert read_key(key_file(tmp_path, DIGITS + "\n")) == bytes.fromhex(DIGITS)
    assert read_key(
        key_file(tmp_path, "0011 2233 4455 6677\n8899 AABB CCDD EEFF")
    ) == bytes.fromhex(DIGITS)


@pytest.mark.parametrize("text", ["", DIGITS[:-1], DIGITS + "0", "g" * 32, "ff" * 16, "\xe4"])
def test_anything_else_is_refused_with_advice(tmp_path: Path, text: str) -> None:
    with pytest.raises(KeyFileError, match="hexadecimal digits"):
        read_key(key_file(tmp_path, text))


def test_a_missing_file_is_an_error_with_advice(tmp_path: Path) -> None:
    with pytest.raises(KeyFileError, match=r"cannot read.*hexadecimal"):
        read_key(tmp_path / "none")


def test_the_key_replaces_the_erased_bytes_and_nothing_else() -> None:
    keyed = with_key(IMAGE, bytes.fromhex(DIGITS))
    assert keyed == bytes(KEY_AT) + bytes.fromhex(DIGITS) + b"code"


def test_an_image_without_a_place_is_refused() -> None:
    with pytest.raises(KeyFileError, match="weeding_robot_pc_bluetooth"):
        with_key(bytes(KEY_AT + 100), bytes.fromhex(DIGITS))
