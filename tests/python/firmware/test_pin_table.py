"""The pin table of the firmware. An invalid entry does not compile."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
HEADER = Path("k64/pins.hpp")
TWICE = '{{Port::B, 22, Mux::Gpio, Role::LowOutput}, "second_light", "D12 red", "A second use."},'
COMPILER = ("arm-none-eabi-g++", "-std=c++20", "-mcpu=cortex-m4", "-mthumb", "-fsyntax-only")


def compiled(folder: Path, text: str) -> subprocess.CompletedProcess[str]:
    header = folder / HEADER
    header.parent.mkdir(parents=True)
    header.write_text(text, encoding="utf-8")
    unit = folder / "unit.cpp"
    unit.write_text(f'#include "{HEADER}"\n', encoding="utf-8")
    return subprocess.run(
        [*COMPILER, "-I", folder, unit], capture_output=True, text=True, check=False
    )


def header_text() -> str:
    return (ROOT / "src" / HEADER).read_text(encoding="utf-8")


def test_the_table_of_the_firmware_compiles(tmp_path: Path) -> None:
    assert compiled(tmp_path, header_text()).returncode == 0


@pytest.mark.parametrize(
    ("row", "message"),
    [
        (TWICE, "each pin and each signal must be used only once"),
        (TWICE.replace("B, 22", "B, 21").replace("second_light", "light_red"), "used only once"),
        (TWICE.replace("B, 22", "B, 12"), "each used pin must exist on the microcontroller"),
        (TWICE.replace("B, 22", "A, 3"), "the pins of the debugger must not be used"),
        (
            TWICE.replace("B, 22", "B, 21").replace("Role::LowOutput", "Role::Peripheral"),
            "each pin must support its connection",
        ),
        (
            TWICE.replace("B, 22", "B, 21").replace(
                "Gpio, Role::LowOutput", "Alt4, Role::LateOutput"
            ),
            "each pin must support its connection",
        ),
    ],
)
def test_a_row_that_must_not_be_does_not_compile(tmp_path: Path, row: str, message: str) -> None:
    begin = "std::to_array<PinRow>({\n"
    text = header_text()
    assert begin in text
    result = compiled(tmp_path, text.replace(begin, f"{begin}    {row}\n"))
    assert result.returncode != 0
    assert message in result.stderr
