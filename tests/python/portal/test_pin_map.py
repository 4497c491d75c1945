"""The table of pins on the page about bring-up."""

import csv
from pathlib import Path

import pytest

from portal.pin_map import COLUMNS, HEADER, PinMapError, pin_map

pytestmark = pytest.mark.reads("src/k64/pins.hpp")

ROOT = Path(__file__).parents[3]
HEADER_TEXT = """\
enum class Role : std::uint8_t {
  LowOutput,  ///< output, safe when low
  Input       ///< input, pulled up
};
inline constexpr auto kPinTable = std::to_array<PinRow>({
    // Buttons.
    {{Port::A, 4, Mux::Gpio, Role::Input}, "button", "SW3, left", "Not used."},

    {{Port::C, 12, Mux::Alt3, Role::LowOutput}, "light", "J1-2", "Low lights it."},
});
"""


def of(root: Path, text: str) -> list[list[str]]:
    header = root / HEADER
    header.parent.mkdir(parents=True, exist_ok=True)
    header.write_text(text)
    return list(csv.reader(pin_map(root).splitlines()))


def test_each_entry_is_a_row(tmp_path: Path) -> None:
    assert of(tmp_path, HEADER_TEXT) == [
        list(COLUMNS),
        ["PTA4", "GPIO", "input, pulled up", "button", "SW3, left", "Not used."],
        ["PTC12", "ALT3", "output, safe when low", "light", "J1-2", "Low lights it."],
    ]


@pytest.mark.parametrize(
    ("old", "new", "place"),
    [
        ("Port::C, 12", "Port::F, 12", "pins.hpp:9: "),
        (", Role::LowOutput}", "}", "pins.hpp:9: "),
        ("Role::LowOutput}", "Role::HighOutput}", "pins.hpp:9: "),
        ('"Low lights it."', '"Low " "lights it."', "pins.hpp:9: "),
        ('"Not used."},', '"Not used."}, {Port::A, 5},', "pins.hpp:7: "),
        ("kPinTable = ", "kOthers = ", "missing or has no end"),
        ("});", "}};", "pins.hpp:10: "),
    ],
)
def test_a_table_that_does_not_read_as_expected_is_an_error(
    tmp_path: Path, old: str, new: str, place: str
) -> None:
    assert old in HEADER_TEXT
    with pytest.raises(PinMapError, match=place):
        of(tmp_path, HEADER_TEXT.replace(old, new))


def test_an_empty_table_is_an_error(tmp_path: Path) -> None:
    lines = [line for line in HEADER_TEXT.splitlines() if "{Port::" not in line]
    with pytest.raises(PinMapError, match="no entry"):
        of(tmp_path, "\n".join(lines))


def test_the_table_of_the_firmware_has_each_pin_that_its_header_names() -> None:
    text = (ROOT / HEADER).read_text()
    table, _, _ = text.partition("kPinTable =")[2].partition("\n});")
    rows = list(csv.reader(pin_map(ROOT).splitlines()))[1:]
    assert len(rows) == table.count("{Port::") > 0
    assert "PTB16" in {row[0] for row in rows}
