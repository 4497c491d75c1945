"""The check compares the stated bound of a loop over an array with the number of elements of the
array. It finds a bound that is lower than this number."""

from pathlib import Path

from tests.python.model.small_tree import write_tree
from traceability.checks import time_checks
from traceability.model.build import build

HEADER = """\
  std::array<std::pair<int, int>, 4> pairs_{};
  std::array<int, kPlaces> places_{};
  static constexpr unsigned kPlaces = 6;
"""
SOURCE = """\
#include "main_control/MainController.hpp"
  // bound: 4
  for (auto& pair : pairs_) {
  }
  // bound: 3
  for (auto& pair : pairs_) {
  }
  // bound: 3
  for (auto& pair : std::span(pairs_).first(count_)) {
  }
  // bound: MainController::kPlaces - 3
  for (int place : places_) {
  }
  // bound: MainController::kPlaces - 3
  for (int place : std::span(places_).first(count_)) {
  }
  // bound: nameOfTheDesign
  for (int place : places_) {
  }
  // bound: 1
  for (int other : others_) {
  }
"""


def test_a_bound_that_is_lower_than_the_number_of_elements_is_found(tmp_path: Path) -> None:
    root = write_tree(tmp_path)
    header = root / "src" / "main_control" / "MainController.hpp"
    header.write_text(header.read_text().replace(" private:\n", f" private:\n{HEADER}", 1))
    (root / "src" / "main_control" / "MainController.cpp").write_text(SOURCE)
    found = [(one.place.line, one.text) for one in time_checks.check(*build(root))]
    assert found == [
        (5, "the bound 3 is lower than the 4 elements of the array"),
        (8, "the bound 3 is lower than the 4 elements of the array"),
        (11, "the bound MainController::kPlaces - 3 is lower than the 6 elements of the array"),
    ]
