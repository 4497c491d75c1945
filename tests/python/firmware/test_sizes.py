"""The sizes of the parts of the firmware image. Each byte of the image is counted in exactly one
part."""

from pathlib import Path

import pytest

from tests.python.firmware.contents import BUILD, ROOT, output
from tools import firmware, sizes
from tools.sizes import Size
from tools.steps import FailureError
from traceability.reading.products import DEFAULT

ELF = BUILD / "weeding_robot.elf"


@pytest.fixture(scope="module")
def parts() -> dict[str, Size]:
    return sizes.sizes_of(ROOT, DEFAULT)


def test_the_table_ends_with_the_sizes_of_the_whole_image(
    parts: dict[str, Size], capsys: pytest.CaptureFixture[str]
) -> None:
    text, data, _bss = map(int, output("arm-none-eabi-size", ELF).splitlines()[1].split()[:3])
    whole = sizes.total(parts)
    assert whole.flash == text + data
    assert whole == sizes.whole_of(ELF)
    firmware.print_sizes(parts)
    rows = [line.rsplit(maxsplit=2) for line in capsys.readouterr().out.splitlines()[2:]]
    assert [row[0].strip() for row in rows[-6:]] == [*sizes.PARTS, "the image"]
    assert rows[-1][1:] == [str(whole.flash), str(whole.ram)]
    assert sum(int(row[1]) for row in rows[:-1]) == text + data


def test_modules_and_other_parts_are_separate(parts: dict[str, Size]) -> None:
    assert parts["flash configuration field"] == Size(flash=16, ram=0)
    assert parts["stack"].flash == 0
    assert parts["stack"].ram > 0
    assert parts["C and C++ library"].flash > 0
    assert parts["MainController"].flash > 0


def test_an_image_that_is_missing_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(FailureError, match="No such file"):
        sizes.sections(tmp_path / "no.elf")
