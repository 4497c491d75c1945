"""Ways past the interface of a module: what the reader of the code notes of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from traceability.reading.ast_facts import Syntax
from traceability.reading.syntax import read_syntax

HEADER = """\
#pragma once
#include <functional>
#include <optional>
namespace wr {
class State {};
class Part {};
class Lamp {
 public:
  void change(State& next);
  void other(State& next);

 private:
  FRIEND
  std::reference_wrapper<State> state_;
};
}  // namespace wr
"""
SOURCE = """\
#include "lamp/Lamp.hpp"
#include <memory>
namespace wr {
BESIDE
void Lamp::change(State& next) { state_ = next; }
void Lamp::other(State& next) { BODY }
}  // namespace wr
"""


def read(root: Path, *, body: str = "", beside: str = "", friend: str = "") -> Syntax:
    folder = root / "src" / "lamp"
    folder.mkdir(parents=True)
    (folder / "Lamp.hpp").write_text(HEADER.replace("FRIEND", friend))
    (folder / "Lamp.cpp").write_text(SOURCE.replace("BODY", body).replace("BESIDE", beside))
    found = read_syntax(root, root / "cache")
    assert found.errors == []
    return found


@pytest.mark.parametrize(
    ("body", "changes"),
    [
        ("state_ = next;", True),
        ("(state_) = next;", True),
        ("state_.operator=(next);", True),
        ("auto& present = state_; present = next;", True),
        ("auto* present = &state_; *present = next;", True),
        ("const auto& present = state_; (void)present; (void)next;", False),
        ("State& present = state_; (void)present; (void)next;", False),
    ],
)
def test_each_way_to_assign_a_member_is_noted(tmp_path: Path, body: str, changes: bool) -> None:
    bodies = {one.id: one for one in read(tmp_path, body=body).bodies}
    noted = [name for name, _ in bodies["Lamp::other"].assigns]
    assert ("Lamp::state_" in noted) is changes


@pytest.mark.parametrize(
    ("friend", "noted"),
    [
        ("friend void open(Lamp& lamp);", ["open"]),
        ("template <class Any> friend class Opener;", ["Opener"]),
        ("friend class Other;", ["Other"]),
        ("friend bool operator==(const Lamp&, const Lamp&) { return true; }", []),
    ],
)
def test_each_friend_that_stands_elsewhere_is_noted(
    tmp_path: Path, friend: str, noted: list[str]
) -> None:
    assert [one.target for one in read(tmp_path, friend=friend).friends] == noted


@pytest.mark.parametrize(
    ("beside", "noted"),
    [
        ("int count = 0;", ["count"]),
        ("namespace { int count = 0; }", ["count"]),
        ("inline void f() { static int count = 0; ++count; }", ["count"]),
        ("const int count = 0;", []),
        ("inline int f() { const int count = 0; return count; }", []),
        ("inline int f() { int count = 0; return ++count; }", []),
        ('[[gnu::section(".noinit")]] int count;', []),
    ],
)
def test_objects_that_outlive_every_call_are_noted(
    tmp_path: Path, beside: str, noted: list[str]
) -> None:
    assert [one.name for one in read(tmp_path, beside=beside).objects] == noted


@pytest.mark.parametrize(
    "beside",
    [
        "std::optional<Part> f() { return std::optional<Part>(std::in_place); }",
        "void f(Part* place) { std::construct_at(place); }",
        "void f() { Part part; (void)part; }",
    ],
)
def test_what_the_library_makes_is_noted(tmp_path: Path, beside: str) -> None:
    made = {one.target for one in read(tmp_path, beside=beside).names if one.how == "construct"}
    assert "Part" in made


def test_a_base_is_what_its_alias_means(tmp_path: Path) -> None:
    found = read(tmp_path, beside="using Kind = State; struct Bright : Kind {};")
    assert {one.name: one.bases for one in found.classes}["Bright"] == ["State"]


def test_an_instruction_is_noted(tmp_path: Path) -> None:
    found = read(tmp_path, body='asm volatile("nop"); (void)next;')
    assert [one.line for one in found.instructions] == [6]


def test_an_instruction_outside_of_functions_is_noted(tmp_path: Path) -> None:
    assert [one.line for one in read(tmp_path, beside='asm("nop");').instructions] == [4]


@pytest.mark.parametrize(
    ("body", "noted"),
    [
        ("union { unsigned long number; int* place; } both{4}; *both.place = 1;", True),
        ("union { unsigned long number; float share; } both{4}; (void)both;", False),
        ("*(static_cast<char*>(nullptr) + 4) = 1;", True),
        ("int* place; long number = 4; __builtin_memcpy(&place, &number, sizeof place);", True),
        ("int copy; long number = 4; __builtin_memcpy(&copy, &number, sizeof copy);", False),
    ],
)
def test_each_way_to_make_an_address_is_noted(tmp_path: Path, body: str, noted: bool) -> None:
    found = read(tmp_path, body=f"{body} (void)next;")
    assert bool(found.casts) is noted
