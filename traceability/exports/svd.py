"""Exports the registers that the firmware uses, in the CMSIS-SVD format for debuggers."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

from traceability.reading.register_table import Register, RegisterBlock, read_registers

NAME = "weeding_robot.svd"
VERSION = "1.3"
PAGE = 0x1000  # usual size [byte] of the address range of one block of registers
ACCESS = {
    "Read": "read-only",
    "Write": "write-only",
    "ReadWrite": "read-write",
    "Flags": "read-write",
}
# Name of a block of registers that exists several times -> names of the copies. The table of
# registers states the distance between the addresses of two copies.
PORTS = tuple("ABCDE")
INSTANCES = {"port": PORTS, "gpio": PORTS, "adc": ("0", "1"), "uart": ("0", "4")}


def write_svd(root: Path, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(svd_of(read_registers(root)), encoding="utf-8")


def svd_of(blocks: list[RegisterBlock]) -> str:
    device = ET.Element("device", schemaVersion=VERSION)
    description = "The registers that the firmware of the weeding robot uses"
    _texts(device, name="MK64FN1M0VLL12", version="1.0", description=description)
    cpu = ET.SubElement(device, "cpu")
    _texts(cpu, name="CM4", revision="r0p1", endian="little", mpuPresent="false")
    _texts(cpu, fpuPresent="true", nvicPrioBits="4", vendorSystickConfig="false")
    _texts(device, addressUnitBits="8", width="32")
    peripherals = ET.SubElement(device, "peripherals")
    for block in blocks:
        _add(peripherals, block)
    ET.indent(device)
    return f'<?xml version="1.0" encoding="utf-8"?>\n{ET.tostring(device, encoding="unicode")}\n'


def _add(peripherals: ET.Element, block: RegisterBlock) -> None:
    """Adds a block of registers. If the microcontroller has several blocks of this kind, also adds
    the other blocks, which have the same registers at other addresses."""
    first, *others = INSTANCES.get(block.name, ("",))
    name, base = f"{block.name.upper()}{first}", _base(block)
    peripheral = ET.SubElement(peripherals, "peripheral")
    _texts(peripheral, name=name, description=block.brief, baseAddress=f"0x{base:08X}")
    size = max(register.address + register.bits // 8 for register in block.registers) - base
    area = ET.SubElement(peripheral, "addressBlock")
    _texts(area, offset="0x0", size=f"0x{size:X}", usage="registers")
    registers = ET.SubElement(peripheral, "registers")
    for register in block.registers:
        _add_register(registers, register, base)
    for number, other in enumerate(others, 1):
        derived = ET.SubElement(peripherals, "peripheral", derivedFrom=name)
        address = base + number * block.distance
        _texts(derived, name=f"{block.name.upper()}{other}", baseAddress=f"0x{address:08X}")


def _base(block: RegisterBlock) -> int:
    """Returns the base address of a block. Usually, a block begins at a multiple of the page size.
    The blocks of GPIO are smaller, and several of them are in one page."""
    step = min(PAGE, block.distance or PAGE)
    return min(register.address for register in block.registers) // step * step


def _add_register(registers: ET.Element, register: Register, base: int) -> None:
    element = ET.SubElement(registers, "register")
    _texts(
        element,
        name=register.name,
        description=f"{register.name} at 0x{register.address:08X}",
        addressOffset=f"0x{register.address - base:X}",
        size=str(register.bits),
        access=ACCESS[register.access],
    )
    if register.flags:
        fields = ET.SubElement(element, "fields")
        for name, number in register.flags.items():
            field = ET.SubElement(fields, "field")
            _texts(field, name=name, bitRange=f"[{number}:{number}]")


def _texts(element: ET.Element, **texts: str) -> None:
    for tag, text in texts.items():
        ET.SubElement(element, tag).text = text
