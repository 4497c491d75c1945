"""The flash configuration field of a firmware image. A wrong field can lock the chip."""

from __future__ import annotations

FIELD = 0x400
SIZE = 16
FLASH = 0x100000
SECURITY = 0x40C
# Two bytes of the field differ from erased flash. The security byte means: not secured, mass erase
# allowed. The options byte disables the non-maskable interrupt. It also disables EzPort, the mode
# for programming over a serial line. Otherwise the chip would start in this mode if PTA4 is low
# during a reset.
WANTED = bytes([0xFF] * 12 + [0xFE, 0xF9] + [0xFF] * 2)
PURPOSES = (
    (0x400, 0x407, "a backdoor key would be set"),
    (0x408, 0x40B, "parts of the flash would be protected against writing"),
    (0x40D, 0x40D, "the chip would boot with other options"),
    (0x40E, 0x40F, "the byte protects a memory that this chip does not have"),
)


def lock_problems(image: bytes) -> list[str]:
    """Returns the faults in the flash configuration field of a firmware image. The list is empty if
    there is no fault."""
    if len(image) < FIELD + SIZE:
        return [f"the image has {len(image)} bytes, and ends before the field at 0x400 to 0x40F"]
    if len(image) > FLASH:
        return [f"the image has {len(image)} bytes, but the flash of the chip has {FLASH}"]
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
            return (
                "the chip would be locked for ever, because it would be secured and could not "
                "be erased"
            )
        if secured:
            return "the chip would be secured; only a mass erase could open it again"
        if no_erase:
            return "mass erase would be disabled"
        return "the settings for backdoor keys or for the manufacturer's access would differ"
    return next(why for first, last, why in PURPOSES if first <= address <= last)
