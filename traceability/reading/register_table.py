"""Reads src/k64/registers.hpp, the table of the registers that the firmware uses."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

TABLE = Path("src/k64/registers.hpp")
BLOCK = re.compile(
    r"/// @brief ([^\n]+(?:\n/// [^\n]+)*)\nnamespace (\w+) \{\n(.*?)\n\}  // namespace", re.DOTALL
)
REGISTER = re.compile(r"Register<std::uint(\d+)_t, (0x[0-9A-F]+)(?:, Access::(\w+))?> (\w+);")
BIT = re.compile(r"auto (\w+) = (\w+)\.bit\((\d+)\);")
DISTANCE = re.compile(r"k(?:Port|Port4|Converter)Distance = (0x[0-9A-F]+);")


@dataclass(frozen=True)
class Register:
    name: str
    address: int
    bits: int
    access: str  # enumerator of the C++ enumeration ``Access``
    flags: dict[str, int] = field(default_factory=dict)  # name of a bit -> number of the bit


@dataclass(frozen=True)
class RegisterBlock:
    name: str  # name of the namespace in the table
    brief: str
    registers: list[Register]
    # distance to the next block of the same kind [byte]; 0 if there is only one block
    distance: int


def read_registers(root: Path) -> list[RegisterBlock]:
    """Returns the blocks of registers in the order of the table."""
    text = (root / TABLE).read_text(encoding="utf-8")
    return [_block(*match.groups()) for match in BLOCK.finditer(text)]


def _block(brief: str, block: str, body: str) -> RegisterBlock:
    flags: dict[str, dict[str, int]] = {}
    for bit, register, number in BIT.findall(body):
        flags.setdefault(register, {})[bit.removeprefix(f"{register}_")] = int(number)
    registers = [
        Register(
            register, int(address, 16), int(bits), access or "ReadWrite", flags.get(register, {})
        )
        for bits, address, access, register in REGISTER.findall(body)
    ]
    distance = DISTANCE.search(body)
    return RegisterBlock(
        block, brief.replace("\n///", ""), registers, int(distance[1], 16) if distance else 0
    )
