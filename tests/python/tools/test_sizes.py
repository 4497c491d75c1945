"""Sizes of the parts of an image: their sum is what the compiler's own tool says."""

import subprocess
from pathlib import Path

import pytest

from tools import firmware, sizes
from tools.sizes import Size
from tools.steps import FailureError

SCRIPT = """\
MEMORY {
  FLASH (rx) : ORIGIN = 0, LENGTH = 1M
  LOWER (rw) : ORIGIN = 0x1FFF0000, LENGTH = 64K
  UPPER (rw) : ORIGIN = 0x20000000, LENGTH = 192K
}
SECTIONS {
  .vectors : { KEEP(*(.vectors)) } > FLASH
  .configuration 0x400 : { KEEP(*(.configuration)) } > FLASH
  .text : { *(.text*) *(.rodata*) . = ALIGN(8); } > FLASH
  .stack (NOLOAD) : { . += 8K; stackTop = .; } > LOWER
  .noinit (NOLOAD) : { *(.noinit*) } > LOWER
  .data : { *(.data*) . = ALIGN(4); } > UPPER AT > FLASH
  .bss : { *(.bss*) *(COMMON) . = ALIGN(4); } > UPPER
  /DISCARD/ : { *(.ARM.exidx*) }
}
"""
START = """\
#include <cstring>
extern "C" char stackTop;
extern "C" void start();
char longTextWithAVeryLongName[] = "in data";
int zeros[25];
[[gnu::section(".vectors"), gnu::used]] void* const stack = &stackTop;
[[gnu::section(".configuration"), gnu::used]] const char field[16] = {1};
[[gnu::section(".noinit")]] int kept;
const char* other(int number);
void start() {
  std::memset(zeros, other(kept)[1], sizeof zeros);
  longTextWithAVeryLongName[zeros[3]] = 'i';
}
"""
OTHER = """\
const char* other(int number);
const char* never(int number);
const char* never(int number) { return number ? "thrown" : "away"; }
namespace wr {
struct Identity { unsigned char version[3]; char build[8]; };
extern const Identity firmwareIdentity;
const Identity firmwareIdentity{{1, 20, 3}, {'0', '1', '2', '3', 'a', 'b', 'c', 'd'}};
}
const char* other(int number) { return number ? "hello" : wr::firmwareIdentity.build; }
"""


@pytest.fixture(scope="module")
def image(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The ELF of a small program, with its map beside it."""
    folder = tmp_path_factory.mktemp("image")
    (folder / "script.ld").write_text(SCRIPT)
    flags = ["-mcpu=cortex-m4", "-mthumb", "-Os", "-ffunction-sections", "-fdata-sections"]
    flags += ["-fno-exceptions"]
    for name, text in (("Start", START), ("Other", OTHER)):
        (folder / f"{name}.cpp").write_text(text)
        compiled = [f"{name}.cpp", "-c", "-o", f"{name}.cpp.obj"]
        subprocess.run(["arm-none-eabi-g++", *flags, *compiled], cwd=folder, check=True)
    subprocess.run(
        ["arm-none-eabi-ar", "rc", "libother.a", "Other.cpp.obj"], cwd=folder, check=True
    )
    linked = ["-nostartfiles", "--specs=nano.specs", "-T", "script.ld", "-Wl,-estart"]
    linked += ["-Wl,--gc-sections", "-Wl,-Map,image.map", "Start.cpp.obj", "libother.a"]
    words = ["arm-none-eabi-gcc", *flags, *linked, "-o", "image.elf"]
    subprocess.run(words, cwd=folder, check=True)
    copy = ["arm-none-eabi-objcopy", "-O", "binary", "image.elf", "image.bin"]
    subprocess.run(copy, cwd=folder, check=True)
    return folder / "image.elf"


def measured(elf: Path) -> tuple[int, int]:
    """Flash and RAM as arm-none-eabi-size says."""
    words = ["arm-none-eabi-size", elf]
    table = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    text, data, bss = (int(number) for number in table.splitlines()[1].split()[:3])
    return text + data, data + bss


def parts(elf: Path) -> dict[str, Size]:
    return sizes.image_sizes(elf, elf.with_suffix(".map"))


def test_each_byte_belongs_to_one_part(image: Path) -> None:
    whole = sizes.total(parts(image))
    assert (whole.flash, whole.ram) == measured(image)


def test_modules_and_other_parts_are_told_apart(image: Path) -> None:
    found = parts(image)
    assert found["vectors"] == Size(flash=4, ram=0)
    assert found["flash configuration field"] == Size(flash=16, ram=0)
    assert found["stack"] == Size(flash=0, ram=8192)
    assert found["Start"].ram == len(b"in data\0") + 25 * 4 + 4
    assert found["Other"].flash >= len(b"hello\0")
    assert found["C library"].flash > 0
    assert found["padding"].flash > 0
    assert set(found) == {"Start", "Other", *sizes.PARTS}


def test_what_the_linker_threw_away_has_no_size(image: Path) -> None:
    text = image.with_suffix(".map").read_text()
    assert "_Z5neveri" in text
    assert "_Z5neveri" not in text.partition("Linker script and memory map")[2]


def test_a_map_that_does_not_fit_the_image_is_not_taken(image: Path, tmp_path: Path) -> None:
    wrong = tmp_path / "image.map"
    text = image.with_suffix(".map").read_text()
    before, start, section = text.partition("\n .bss.zeros")
    assert start
    wrong.write_text(before + start + section.replace("0x64", "0x640", 1))
    with pytest.raises(FailureError, match=r"\.bss has more in it"):
        sizes.image_sizes(image, wrong)
    wrong.write_text("")
    with pytest.raises(FailureError, match="no memory map"):
        sizes.image_sizes(image, wrong)


def test_an_image_that_is_missing_is_said(tmp_path: Path) -> None:
    with pytest.raises(FailureError, match="No such file"):
        sizes.sections(tmp_path / "no.elf")


def test_the_identity_is_read_from_the_bytes_of_the_image(image: Path) -> None:
    found = firmware.identity(image, image.with_suffix(".bin"))
    assert found == ("1.20.3", "0123abcd")


def test_the_table_ends_with_the_sum(image: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = parts(image)
    firmware.print_sizes(found)
    rows = [line.rsplit(maxsplit=2) for line in capsys.readouterr().out.splitlines()[2:]]
    assert [row[0].strip() for row in rows[-6:]] == [*sizes.PARTS, "the image"]
    flash, ram = measured(image)
    assert rows[-1][1:] == [str(flash), str(ram)]
    assert sum(int(row[1]) for row in rows[:-1]) == flash
    assert sum(int(row[2]) for row in rows[:-1]) == ram
