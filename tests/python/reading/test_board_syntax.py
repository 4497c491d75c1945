"""Sources of the K64 are read for the K64, and their uses are seen like those of all others."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
from traceability.checks.use_checks import check
from traceability.model.build import Built, build
from traceability.schema import HOST

FILES = {
    "src/k64/K64Watchdog.hpp": """\
#pragma once

#include <cstdint>

namespace wr {

/// @brief The watchdog of the chip.
class K64Watchdog {
 public:
  /// @brief Refreshes it.
  void refresh();
};

}  // namespace wr
""",
    "src/k64/K64Watchdog.cpp": """\
#include "k64/K64Watchdog.hpp"

#include "k64/registers.hpp"

namespace wr {

static_assert(sizeof(void*) == 4, "an address of the K64 has four bytes");

void K64Watchdog::refresh() {
  asm volatile("cpsid i" ::: "memory");
  *reinterpret_cast<volatile std::uint16_t*>(wdog::kRefresh) = 0xA602;
}

}  // namespace wr
""",
    "src/k64/registers.hpp": """\
#pragma once

#include <cstdint>

namespace wr {

namespace wdog {
inline constexpr std::uint32_t kRefresh = 0x4005200CU;
}  // namespace wdog

}  // namespace wr
""",
    "src/k64/start_up/main.cpp": """\
#include "k64/K64Watchdog.hpp"
#include "main_control/MainController.hpp"

int main() {
  wr::K64Watchdog watchdog;
  watchdog.refresh();
  return 0;
}
""",
    "src/k64/module.dox": """\
/** @dir src/k64
@brief K64 is the board.

@function Drives the chip.

@secret Which chip it is.
*/
""",
}


def write_board(root: Path) -> Path:
    write_tree(root)
    for name, text in FILES.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return root


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_board(tmp_path_factory.mktemp("board"))


@pytest.fixture(scope="module")
def built(tree: Path) -> Built:
    return build(tree)


def test_they_compile_for_the_target_with_its_own_headers(built: Built) -> None:
    assert built.facts.syntax.errors == []
    assert built.model.modules["K64Watchdog"].qualified == "wr::K64Watchdog"


def test_blocks_of_registers_are_noted_where_they_are_used(built: Built) -> None:
    found = {(b.block, b.file, b.place.file) for b in built.facts.syntax.blocks if not b.declares}
    assert found == {("wdog", "src/k64/registers.hpp", "src/k64/K64Watchdog.cpp")}
    assert [place.file for place in built.facts.syntax.casts] == ["src/k64/K64Watchdog.cpp"]


def test_composition_without_classes_has_uses(built: Built) -> None:
    model = built.model
    uses = {(use.source, use.target) for use in model.uses}
    assert ("k64/start_up", "k64") in uses
    assert ("k64/start_up", "main_control") in uses
    assert model.logic_modules["k64"].children == ["k64/start_up"]
    assert model.logic_modules["k64/start_up"].modules == []


@pytest.mark.parametrize(
    "change",
    [
        '#include "k64/K64Watchdog.hpp"\n',
        '#include "k64/start_up/start.hpp"\nnamespace wr { void act() { startBoard(); } }\n',
    ],
)
def test_only_the_composition_sees_the_board(tmp_path: Path, change: str) -> None:
    root = write_board(tmp_path)
    start = root / "src/k64/start_up/start.hpp"
    start.write_text("#pragma once\nnamespace wr {\nvoid startBoard();\n}\n", encoding="utf-8")
    file = "src/main_control/operation_modes/RC.cpp"
    (root / file).write_text(change + (root / file).read_text(encoding="utf-8"), encoding="utf-8")
    built = build(root)
    found = [
        one.place.line
        for one in check(*built)
        if one.check == "uses-allowed" and one.place.file == file and "k64" in one.text
    ]
    assert found == [1]


def test_a_method_of_the_board_lies_outside_the_trace_of_the_host(tmp_path: Path) -> None:
    root = write_board(tmp_path)
    tree = root / "design/trees/board.tree"
    tree.write_text("FR-15\nK64Watchdog::refresh\n", encoding="utf-8")
    (root / "design/trees/reading.tree").unlink()
    node = build(root).model.requirements["FR-15"].tree
    assert node is not None
    assert node.reachable
    assert node.outside == [HOST]
