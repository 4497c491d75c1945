"""The constants of the simulator and of the Python programs."""

from __future__ import annotations

import pytest

from tests.python.project_files import write_files
from traceability.reading.plain_constants import plain_constants
from traceability.schema import Constant

HEADER = """\
struct Wheel {
  static constexpr double kRadius = 0.272;  ///< radius [m]
  static constexpr int kLast =
      680;  ///< number of steps
  static constexpr std::chrono::milliseconds kPeriod{20};
  static constexpr Clock::duration kLate = std::chrono::seconds(2);
  double mass = 175.0;  ///< [kg]
  double computed = 2 * kRadius;
};
constexpr int kTwice = 1;
constexpr Microseconds kStart(5364);
constexpr Range kSupply{.low = -0.5, .high = 29.0};  // [V]
"""
PROGRAM = """\
KEY_AT = 0x410  # in the flash [address]
DEAD_MAN_S = 0.3
NAME = "drive"
ON = True
SUM = KEY_AT + 1
"""


@pytest.fixture(scope="module")
def constants(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Constant]:
    files = {
        "sim/plant/Wheel.hpp": HEADER,
        "sim/plant/Wheel.cpp": "constexpr int kTwice = 2;\n",
        "tools/key.py": PROGRAM,
    }
    return plain_constants(write_files(tmp_path_factory.mktemp("project"), files))


@pytest.mark.parametrize(
    ("name", "number", "unit", "line"),
    [
        ("plant::Wheel::kRadius", 0.272, "m", 2),
        ("plant::Wheel::kLast", 680, "", 3),
        ("plant::Wheel::kPeriod", 20, "ms", 5),
        ("plant::Wheel::kLate", 2, "s", 6),
        ("plant::Wheel::mass", 175, "kg", 7),
        ("plant::Wheel::kStart", 5364, "us", 11),
        ("plant::Wheel::kSupply.low", -0.5, "V", 12),
        ("plant::Wheel::kSupply.high", 29, "V", 12),
        ("key.KEY_AT", 0x410, "address", 1),
        ("key.DEAD_MAN_S", 0.3, "s", 2),
    ],
)
def test_a_constant_has_its_value_and_unit(
    constants: dict[str, Constant], name: str, number: float, unit: str, line: int
) -> None:
    found = constants[name]
    assert (found.number, found.unit, found.place.line) == (number, unit, line)


@pytest.mark.parametrize(
    "name", ["plant::Wheel::computed", "plant::Wheel::kTwice", "key.NAME", "key.ON", "key.SUM"]
)
def test_a_constant_without_a_single_number_is_left_out(
    constants: dict[str, Constant], name: str
) -> None:
    assert name not in constants
