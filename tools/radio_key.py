"""The key of the Bluetooth device. The key is written into a copy of the firmware image before
the copy is flashed."""

from __future__ import annotations

import re
from pathlib import Path

KEY_AT = 0x410  # in the flash [address]
KEY_BYTES = 16
ERASED = b"\xff" * KEY_BYTES
ADVICE = (
    "A key file contains 32 hexadecimal digits. Make a key file with: head -c 16 /dev/urandom | "
    "od -An -tx1 > robot.key"
)


class KeyFileError(Exception):
    """A key cannot be used, or a firmware image has no place for the key."""


def read_key(file: Path) -> bytes:
    """Returns the 16 bytes of a key file. Blanks may separate its digits."""
    try:
        text = "".join(file.read_text(encoding="ascii").split())
    except (OSError, UnicodeDecodeError) as error:
        raise KeyFileError(f"cannot read the key {file}: {error}. {ADVICE}") from error
    if not re.fullmatch(f"[0-9a-fA-F]{{{2 * KEY_BYTES}}}", text):
        raise KeyFileError(f"{file} is not a key file. {ADVICE}")
    key = bytes.fromhex(text)
    if key == ERASED:
        raise KeyFileError(f"{file}: a key of 16 bytes FF means that there is no key. {ADVICE}")
    return key


def with_key(image: bytes, key: bytes) -> bytes:
    """Returns the firmware image with the key at the place for the key."""
    if image[KEY_AT : KEY_AT + KEY_BYTES] != ERASED:
        raise KeyFileError(
            "this image has no place for a key; use the image of weeding_robot_pc_bluetooth"
        )
    return image[:KEY_AT] + key + image[KEY_AT + KEY_BYTES :]
