"""The firmware image of the K64 contains all parts that the chip needs, and no forbidden part."""

from __future__ import annotations

import re
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from tests.python.firmware.contents import (
    BORDER,
    BUILD,
    CODE,
    COMPILER,
    CORE,
    ROOT,
    SRAM_LOWER,
    VECTORS,
    across_border,
    output,
    sections,
    symbols,
    vector_problems,
)
from tools.forbidden_parts import FORBIDDEN, forbidden
from tools.image import lock_problems
from tools.sizes import place_in_binary
from weeding_robot_client.layout import SCHEMA_HASH

ELF = BUILD / "weeding_robot.elf"
BIN = BUILD / "weeding_robot.bin"
HARD_FLOAT = ("-mfloat-abi=hard", "-mfpu=fpv4-sp-d16")

# For each forbidden part: a program that contains it, and the compiler options for this program.
HOLDERS = {
    "heap": ("int* f() { return new int; }", HARD_FLOAT),
    "heap, in C": ('extern "C" void free(void*); void f(int* p) { free(p); }', HARD_FLOAT),
    "unwinder": (
        "void g(); struct S { ~S(); }; void f() { S s; g(); }",
        (*HARD_FLOAT, "-fexceptions"),
    ),
    "unwinder, tables only": ("void g(); void f() { g(); g(); }", (*HARD_FLOAT, "-funwind-tables")),
    "RTTI": ("struct S { virtual void f(); }; void S::f() {}", HARD_FLOAT),
    "soft float": ("double f(double a, double b) { return a * b; }", HARD_FLOAT),
    "soft float, conversion": ("double f(int a) { return a; }", HARD_FLOAT),
    "soft float, single": ("float f(float a, float b) { return a + b; }", ("-mfloat-abi=soft",)),
}
PLAIN = ("-fno-exceptions", "-fno-unwind-tables", "-fno-asynchronous-unwind-tables")


def kind_of(name: str) -> str:
    return name.partition(",")[0]


def compiled(folder: Path, source: str, *options: str) -> Path:
    (folder / "holder.cpp").write_text(source, encoding="utf-8")
    words = [COMPILER, *CORE, "-Os", *PLAIN, *options, "-c", "holder.cpp", "-o", "holder.o"]
    subprocess.run(words, check=True, cwd=folder, timeout=60)
    return folder / "holder.o"


@pytest.fixture(scope="module")
def image() -> bytes:
    if not BIN.exists():
        pytest.fail("there is no image: build it with ./wr firmware")
    return BIN.read_bytes()


def test_the_image_does_not_lock_the_chip(image: bytes) -> None:
    assert lock_problems(image) == []
    field = image[0x400:0x410]
    assert field[0xC] == 0xFE  # The chip is not secured, and mass erase is allowed.
    assert field[0xD] == 0xF9  # EzPort and NMI are disabled, even if PTA4 is low at the reset.
    assert set(field[:0xC] + field[0xE:]) == {0xFF}


@pytest.mark.parametrize("offset", range(16))
def test_each_bit_of_the_flash_configuration_field_counts(image: bytes, offset: int) -> None:
    for bit in range(8):
        damaged = bytearray(image)
        damaged[0x400 + offset] ^= 1 << bit
        (problem,) = lock_problems(bytes(damaged))
        assert f"0x{0x400 + offset:X}" in problem


def test_the_vectors_lead_to_code_and_the_stack_is_in_the_lower_memory(image: bytes) -> None:
    assert vector_problems(image) == []
    address = {symbol.name: symbol.address for symbol in symbols(ELF)}
    stack, reset = struct.unpack_from("<2I", image)
    assert stack == address["stackTop"]
    # The stack is at the lower end of the memory. Therefore a stack overflow causes a fault.
    assert address["stackBottom"] == SRAM_LOWER
    assert reset & ~1 == address["resetHandler"] & ~1


@pytest.mark.parametrize("number", range(VECTORS))
def test_a_wrong_vector_is_found(image: bytes, number: int) -> None:
    for wrong in (0, CODE, 0xFFFFFFFF, len(image) | 1):
        damaged = bytearray(image)
        struct.pack_into("<I", damaged, 4 * number, wrong)
        assert len(vector_problems(bytes(damaged))) == 1


def test_nothing_lies_across_the_border_of_the_two_memories() -> None:
    assert across_border(ELF) == []


def test_what_lies_across_the_border_is_found(tmp_path: Path) -> None:
    program = compiled(tmp_path, "int before[8]; int behind[8];")
    for start, objects in ((BORDER - 40, 1), (BORDER - 32, 0)):
        linked = tmp_path / "linked.elf"
        place = f"-Tbss=0x{start:X}"
        output("arm-none-eabi-ld", "-e", "0", "-Ttext=0", place, "-o", linked, program)
        section, *found = across_border(linked)
        assert section == ".bss"
        assert len(found) == objects


@pytest.mark.runs_tools
def test_the_image_names_the_version_and_the_sources_of_the_project(tmp_path: Path) -> None:
    version = re.search(
        r"project\(weeding_robot VERSION (\d+)\.(\d+)\.(\d+)", (ROOT / "CMakeLists.txt").read_text()
    )
    assert version
    made = tmp_path / "identity.cpp"
    output(
        "cmake",
        f"-DSOURCE_DIR={ROOT}",
        f"-DOUTPUT={made}",
        f"-DVERSION={'.'.join(version.groups())}",
        f"-DPYTHON={sys.executable}",
        "-P",
        ROOT / "src" / "identity.cmake",
    )
    build_id = "".join(re.findall(r"'(.)'", made.read_text()))
    assert len(build_id) == 8
    (place,) = [one for one in symbols(ELF) if one.name.endswith("firmwareIdentityE")]
    expected = bytes(map(int, version.groups())) + build_id.encode()
    expected += bytes(1) + SCHEMA_HASH.to_bytes(4, "little")
    at = place_in_binary(ELF, place.address)
    assert BIN.read_bytes()[at:][: len(expected)] == expected, "the image is old: build it again"


def test_the_binary_holds_what_the_program_does(image: bytes, tmp_path: Path) -> None:
    """The binary contains all data that are loaded into the flash, and nothing else."""
    copy = tmp_path / "copy.bin"
    output("arm-none-eabi-objcopy", "-O", "binary", ELF, copy)
    assert copy.read_bytes() == image
    start, size = sections(ELF)[".start_up"]
    assert start == CODE
    assert start + size <= len(image) <= 0x100000
    begin, code = sections(ELF)[".text"]
    assert SRAM_LOWER < begin < begin + code < BORDER


def test_the_image_has_nothing_that_the_firmware_must_not_have() -> None:
    assert forbidden(ELF) == set()


@pytest.mark.parametrize("name", HOLDERS)
def test_what_the_firmware_must_not_have_is_found(tmp_path: Path, name: str) -> None:
    source, options = HOLDERS[name]
    assert forbidden(compiled(tmp_path, source, *options)) == {kind_of(name)}


def test_each_kind_has_a_program_that_holds_it() -> None:
    assert {kind_of(name) for name in HOLDERS} == set(FORBIDDEN)


def test_a_plain_program_has_nothing_of_that(tmp_path: Path) -> None:
    source = "struct S { float a; void free(); }; void S::free() { a *= 2; }"
    assert forbidden(compiled(tmp_path, source, *HARD_FLOAT)) == set()
