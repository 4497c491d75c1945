"""Runs the programs whose output the readers use."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable
from pathlib import Path


def output_of(*command: str | Path, given: str | None = None) -> str:
    """Returns the output of a program that reads the text ``given``. Raises CalledProcessError if
    the program fails."""
    return subprocess.run(command, input=given, capture_output=True, text=True, check=True).stdout


def disassembly(elf: Path) -> str:
    return output_of("arm-none-eabi-objdump", "-d", "--no-show-raw-insn", elf)


def source_lines(elf: Path, addresses: Iterable[int], *options: str) -> dict[int, list[str]]:
    """Returns the text lines that addr2line prints for each instruction: the place of the
    instruction, and then the places of the inlined calls that contain it, from the innermost to the
    outermost call."""
    request = "\n".join(f"{address:#x}" for address in addresses)
    said = output_of("arm-none-eabi-addr2line", "-e", elf, "-a", "-i", *options, given=request)
    by_address: dict[int, list[str]] = {}
    current: list[str] = []
    for line in said.splitlines():
        if line.startswith("0x"):
            current = by_address.setdefault(int(line, 16), [])
        else:
            current.append(line)
    return by_address
