"""The value and the unit of each constant of the code. The constants have the same names as in the
texts, such as ``Limits::most``."""

from __future__ import annotations

import pytest

from tests.python.model.small_tree import write_tree
from traceability.model.build import build
from traceability.schema import Constant

HEADER = """\
#pragma once
namespace wr {
/// @brief Angle [0.01 degree].
struct Angle {
  explicit constexpr Angle(int count) : count_(count) {}
  int count_;
};
/// @brief Makes a duration.
/// @param count duration [ms]
constexpr Angle milliseconds(int count) { return Angle(count * 1000); }
inline constexpr int kMost = 128;
inline constexpr int kWhole = kMost + 2;
inline constexpr int kRate = 1'000;  // [Hz]
inline constexpr int kPlain = 5;
inline constexpr double kTrack = 1.582;  // [m]
inline constexpr float kNoise = 0.1F;  // [V]

// Greatest speed of something else [rpm].

enum class Kind : unsigned char { First = 0x01, Last = 0x82 };
struct Gains {
  int proportional = 0;  ///< part of the error [mV]
  int integral = 0;
};
struct Limits {
  /// @return greatest speed [0.1 rpm]
  constexpr int most() const { return 3'200; }
  /// @return number of cycles [2 to 255]
  constexpr int cycles() const { return 4; }
  constexpr Angle period() const { return milliseconds(100); }
  constexpr int twice(int count) const { return 2 * count; }
  int choice() const { if (kMost > 1) { return 1; } return 2; }
  static constexpr Angle kNear{25};
  static int changed;
};
constexpr Gains kGains{.proportional = 5, .integral = 7};
constexpr Gains kOther{.proportional = 5, .integral = 7};  // [mV per rpm]
}  // namespace wr
"""


@pytest.fixture(scope="module")
def constants(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Constant]:
    root = write_tree(tmp_path_factory.mktemp("tree"))
    folder = root / "src" / "main_control"
    (folder / "Limits.hpp").write_text(HEADER)
    (folder / "Other.hpp").write_text(
        "#pragma once\nnamespace wr {\ninline constexpr int kTwo = 2;\n"
        "namespace one { inline constexpr int kDouble = 1; }\n"
        "namespace two { inline constexpr int kDouble = 2; }\n}\n"
    )
    return build(root).model.constants


@pytest.mark.parametrize(
    ("name", "number", "unit"),
    [
        ("kMost", 128, ""),
        ("Limits::kMost", 128, ""),
        ("kWhole", 130, ""),
        ("kRate", 1000, "Hz"),
        ("kPlain", 5, ""),
        ("kTrack", 1.582, "m"),
        ("kNoise", 0.1, "V"),
        ("Kind::First", 1, ""),
        ("Kind::Last", 0x82, ""),
        ("Limits::most", 3200, "0.1 rpm"),
        ("Limits::cycles", 4, ""),
        ("Limits::period", 100, "ms"),
        ("Limits::kNear", 25, "0.01 degree"),
        ("kGains.proportional", 5, "mV"),
        ("kGains.integral", 7, ""),
        ("kOther.proportional", 5, "mV per rpm"),
        ("kOther.integral", 7, "mV per rpm"),
    ],
)
def test_a_constant_has_its_value_and_unit(
    constants: dict[str, Constant], name: str, number: float, unit: str
) -> None:
    found = constants[name]
    assert (found.number, found.unit) == (number, unit)
    assert found.place.file == "src/main_control/Limits.hpp"


@pytest.mark.parametrize("name", ["Limits::twice", "Limits::choice", "Limits::changed", "kDouble"])
def test_what_has_no_value_or_several_is_no_constant(
    constants: dict[str, Constant], name: str
) -> None:
    assert name not in constants
    assert "kTwo" in constants
