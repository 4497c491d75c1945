"""The image of the K64: its flash configuration field, which can lock the chip."""

from __future__ import annotations

FIELD = 0x400
SIZE = 16
FLASH = 0x100000
SECURITY = 0x40C
# The field is as after an erase, except for two bytes. Security: not secured, mass erase allowed.
# Options: no
# mode for programming over a serial line (EzPort) when PTA4 is low during a reset.
WANTED = bytes([0xFF] * 12 + [0xFE, 0xFD] + [0xFF] * 2)
PURPOSES = (
    (0x400, 0x407, "a backdoor key would be set"),
    (0x408, 0x40B, "parts of the flash would be protected from being written again"),
    (0x40D, 0x40D, "the chip would boot with other options"),
    (0x40E, 0x40F, "this part has no such memory to protect"),
)


def lock_problems(image: bytes) -> list[str]:
    """Returns the fault in the flash configuration field of an image; empty when it has none."""
    if len(image) < FIELD + SIZE:
        return [f"the image has {len(image)} bytes: it ends before the field at 0x400 to 0x40F"]
    if len(image) > FLASH:
        return [f"the image has {len(image)} bytes, the flash of the chip {FLASH}"]
    field = image[FIELD : FIELD + SIZE]
    return [
        f"byte 0x{address:X} is 0x{value:02X}, not 0x{expected:02X}: {_why(address, value)}"
        for address, (value, expected) in enumerate(zip(field, WANTED, strict=True), FIELD)
        if value != expected
    ]


def _why(address: int, value: int) -> str:
    if address == SECURITY:
        secured = value & 0b11 != 0b10
        no_erase = value & 0b110000 == 0b100000
        if secured and no_erase:
            return "the chip would be locked for ever: secured, and without mass erase"
        if secured:
            return "the chip would be secured: only a mass erase opens it again"
        if no_erase:
            return "mass erase would be off"
        return "the keys or the access of the manufacturer would differ"
    return next(why for first, last, why in PURPOSES if first <= address <= last)
