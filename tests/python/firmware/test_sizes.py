"""Sizes of the parts of the image: each byte belongs to one part."""

from pathlib import Path

import pytest

from tests.python.firmware.contents import BUILD, output
from tools import firmware, sizes
from tools.sizes import Size
from tools.steps import FailureError

ELF = BUILD / "weeding_robot.elf"
MAP = BUILD / "weeding_robot.map"


@pytest.fixture(scope="module")
def parts() -> dict[str, Size]:
    return sizes.image_sizes(ELF, MAP)


def test_the_table_ends_with_the_sizes_of_the_whole_image(
    parts: dict[str, Size], capsys: pytest.CaptureFixture[str]
) -> None:
    text, data, bss = map(int, output("arm-none-eabi-size", ELF).splitlines()[1].split()[:3])
    assert sizes.total(parts) == Size(text + data, data + bss)
    firmware.print_sizes(parts)
    rows = [line.rsplit(maxsplit=2) for line in capsys.readouterr().out.splitlines()[2:]]
    assert [row[0].strip() for row in rows[-6:]] == [*sizes.PARTS, "the image"]
    assert rows[-1][1:] == [str(text + data), str(data + bss)]
    assert sum(int(row[1]) for row in rows[:-1]) == text + data


def test_modules_and_other_parts_are_separate(parts: dict[str, Size]) -> None:
    assert parts["flash configuration field"] == Size(flash=16, ram=0)
    assert parts["stack"].flash == 0
    assert parts["stack"].ram > 0
    assert parts["C library"].flash > 0
    assert parts["MainController"].flash > 0


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("Linker script and memory map", "", "no memory map"),
        ("\n .bss.", "\n .bss.x 0x0 0x99999 a.o\n .bss.", "has more in it"),
    ],
)
def test_a_map_that_does_not_fit_the_image_is_an_error(
    tmp_path: Path, old: str, new: str, reason: str
) -> None:
    text = MAP.read_text(encoding="utf-8")
    before, found, after = text.rpartition(old)
    assert found
    (tmp_path / "wrong.map").write_text(before + new + after, encoding="utf-8")
    with pytest.raises(FailureError, match=reason):
        sizes.image_sizes(ELF, tmp_path / "wrong.map")


def test_an_image_that_is_missing_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(FailureError, match="No such file"):
        sizes.sections(tmp_path / "no.elf")
