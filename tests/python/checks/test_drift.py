"""Faults seeded in a copy of the tree are found at their place, with the right check."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from traceability.checks import run_checks
from traceability.model.schema import Finding
from traceability.pipeline import build_model
from traceability.sources import source_hash

ROOT = Path(__file__).parents[3]
COPIED = (
    "src",
    "extensions",
    "sim",
    "tests",
    "requirements",
    "design",
    "traceability/doxygen",
    "build/model/cache",
)

STATES = "src/main_control/operation_states"
MODES = "src/main_control/operation_modes"


def found(root: Path) -> set[tuple[str, int, str]]:
    findings: list[Finding] = run_checks(build_model(root))
    return {(one.place.file, one.place.line, one.check) for one in findings}


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("sound") / "tree"
    for name in COPIED:
        if (ROOT / name).exists():
            ignored = shutil.ignore_patterns("python", "standard.*", "__pycache__")
            shutil.copytree(ROOT / name, root / name, ignore=ignored)
    build_model(root)
    return root


@pytest.fixture(scope="module")
def before(sound: Path) -> set[tuple[str, int, str]]:
    return found(sound)


@pytest.fixture(scope="module")
def caught() -> Iterator[list[str]]:
    """The faults that were caught. When all were seeded, their number is a figure of the run."""
    names: list[str] = []
    yield names
    if len(SEEDED) == len(FAULTS) + 1:
        record = {"sources": source_hash(ROOT), "seeded": len(SEEDED), "caught": len(names)}
        path = ROOT / "build" / "results" / "drift.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(record), encoding="utf-8")


@pytest.fixture
def tree(sound: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(sound, tmp_path / "tree"))


SEEDED: set[str] = set()


def line_of(path: Path, pattern: str) -> int:
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if re.search(pattern, line):
            return number
    raise AssertionError(f"nothing matches {pattern} in {path}")


def change(path: Path, pattern: str, replacement: str) -> None:
    text = path.read_text(encoding="utf-8")
    changed = re.sub(pattern, replacement, text, count=1, flags=re.MULTILINE | re.DOTALL)
    assert changed != text, f"nothing matches {pattern} in {path}"
    path.write_text(changed, encoding="utf-8")


def test_sound_tree_has_findings_of_missing_results_only(
    before: set[tuple[str, int, str]],
) -> None:
    assert {check for _, _, check in before} == {"req-stale"}


FAULTS: list[tuple[str, str, str, str, str, str]] = [
    # file, what is replaced, by what, check, file of the finding ("" = same), line of the finding
    (f"{MODES}/RC.hpp", r"/// @secret.*?///$", "///", "module-secret", "", r"^class RC\b"),
    (
        f"{STATES}/Working.cpp",
        r"  mCtrl\.changeOpState\(waiting_\);",
        "  static_cast<void>(mCtrl);",
        "tree-static",
        "",
        r"^void Working::actionNoMsg",
    ),
    (
        f"{STATES}/Working.cpp",
        r"^#include \"main_control/MainController.hpp\"$",
        '#include "main_control/MainController.hpp"\n#include "devices/FirstTimer.hpp"',
        "uses-allowed",
        "",
        "FirstTimer.hpp",
    ),
    (  # the header is included by another one before: the compiler does not read it again
        f"{STATES}/Waiting.cpp",
        r"^#include \"main_control/MainController.hpp\"$",
        '#include "main_control/MainController.hpp"\n#include "communication/framing/Frame.hpp"',
        "uses-allowed",
        "",
        "Frame.hpp",
    ),
    (
        "src/communication/serialization/OrderMessage.hpp",
        r" : public Serializable",
        "",
        "pattern-serializer-derives",
        "",
        "^class OrderMessage",
    ),
    (
        f"{MODES}/ModeDecorator.hpp",
        r"  Mode& wrapped_;",
        "  ModeDecorator& wrapped_;",
        "pattern-decorator-holds",
        "",
        "^class ModeDecorator",
    ),
    (
        f"{MODES}/RC.hpp",
        r"@role\{reading-modes, Concrete State\}",
        "@role{reading-modes, Concret State}",
        "pattern-role-unknown",
        "",
        "Concret State",
    ),
    (
        f"{MODES}/RC.hpp",
        r"^/// @role\{reading-modes, Concrete State\}\n",
        "",
        "pattern-role-missing",
        "",
        r"^class RC\b",
    ),
    (
        f"{STATES}/OperationState.hpp",
        r"^  void read\(MainController& mCtrl\);",
        "  virtual void read(MainController& mCtrl);",
        "pattern-template-nonvirtual",
        "",
        "^class OperationState",
    ),
    (
        f"{STATES}/Waiting.hpp",
        r"^ private:",
        " private:\n  class Working* after_ = nullptr;",
        "pattern-state-successor",
        "",
        "after_",
    ),
    (
        "src/services/SystemConstants.hpp",
        r" private:\n  constexpr SystemConstants\(\) = default;",
        "  constexpr SystemConstants() = default;\n\n private:",
        "pattern-singleton-constructor",
        "",
        r"constexpr SystemConstants\(\) = default",
    ),
    (
        "src/main_control/ControllerTimeOut.cpp",
        r"mCtrl_\.clockPulse\(\);",
        "",
        "pattern-command-receiver",
        "src/main_control/ControllerTimeOut.hpp",
        "^class ControllerTimeOut",
    ),
    (
        f"{MODES}/PC.hpp",
        r"@satisfies FR-\d+",
        "@satisfies FR-999",
        "req-unknown",
        "",
        "FR-999",
    ),
    (
        f"{MODES}/PC.hpp",
        r"^  /// @param wrapped [^\n]*\n",
        "",
        "module-spec",
        "",
        r"^  PC\(",
    ),
    (
        "design/trees/reading_orders.tree",
        r"Working::actionNoMsg",
        "Working::actionNoMessage",
        "tree-node",
        "",
        "actionNoMessage",
    ),
    (
        "src/k64/K64Pit.cpp",
        r"^void K64Pit::start\([^)]*\) \{$",
        "\\g<0>\n  wdog::REFRESH.write({0});",
        "secret-registers",
        "",
        "wdog::REFRESH",
    ),
    (
        "src/main_control/MainController.cpp",
        r"^#include \"main_control/MainController.hpp\"$",
        '#include "main_control/MainController.hpp"\n#include "k64/K64Watchdog.hpp"',
        "uses-allowed",
        "",
        "k64/K64Watchdog.hpp",
    ),
    (
        "tests/system/OrdersTest.cpp",
        r"^#include ",
        '#include "k64/registers.hpp"\n#include ',
        "uses-board",
        "",
        "k64/registers.hpp",
    ),
    (
        "src/main_control/MainController.cpp",
        r"^#include \"main_control/MainController.hpp\"$",
        '#include "main_control/MainController.hpp"\n#include "bluetooth/Bluetooth.hpp"',
        "uses-extension",
        "",
        "bluetooth/Bluetooth.hpp",
    ),
    (  # no extension uses another one, even where that is allowed
        "extensions/warning/WaitingK.cpp",
        r"^#include \"warning/WaitingK.hpp\"$",
        '#include "warning/WaitingK.hpp"\n#include "bluetooth/Bluetooth.hpp"',
        "uses-extension",
        "",
        "bluetooth/Bluetooth.hpp",
    ),
    (
        "extensions/warning/WaitingK.cpp",
        r"^#include \"warning/WaitingK.hpp\"$",
        '#include "warning/WaitingK.hpp"\n#include "communication/framing/Frame.hpp"',
        "uses-allowed",
        "",
        "Frame.hpp",
    ),
    (
        "extensions/warning/WaitingK.hpp",
        r"^  OperationState& next_;",
        "  OperationState& next_;\n  class WaitingN* after_ = nullptr;",
        "pattern-state-successor",
        "",
        "after_",
    ),
    (
        "extensions/bluetooth/Bluetooth.cpp",
        r"^  ModeDecorator::serve\(\);\n",
        "",
        "tree-static",
        "",
        r"^void Bluetooth::serve",
    ),
    (
        "extensions/bluetooth/Bluetooth.hpp",
        r"@role\{reading-modes, Concrete State\}",
        "@role{reading-modes, Concrete Mode}",
        "pattern-role-unknown",
        "",
        "Concrete Mode",
    ),
    (
        "extensions/bluetooth/BluetoothLink.hpp",
        r"^/// @secret [^\n]*\n",
        "",
        "module-secret",
        "",
        "^class BluetoothLink",
    ),
    (
        "extensions/bluetooth/module.dox",
        r"^@secret [^\n]*\n",
        "",
        "module-folder",
        "",
        "@dir",
    ),
    (
        "sim/k64/Finding.hpp",
        r"^#include <chrono>$",
        '#include <chrono>\n#include "services/StartRecord.hpp"',
        "uses-board",
        "",
        "StartRecord.hpp",
    ),
    (
        "design/uses.toml",
        r"\Z",
        '\n[[allow]]\nfrom = "devices"\nto = "construction"\nwhy = "No reason."\n',
        "uses-unused",
        "",
        "LAST",
    ),
]


@pytest.mark.parametrize("fault", FAULTS, ids=[f"{one[3]}-{Path(one[0]).stem}" for one in FAULTS])
def test_seeded_fault_is_found_at_its_place(
    fault: tuple[str, str, str, str, str, str],
    tree: Path,
    before: set[tuple[str, int, str]],
    caught: list[str],
) -> None:
    file, pattern, replacement, check, other, line = fault
    SEEDED.add(f"{check} {file}")
    change(tree / file, pattern, replacement)
    place = other or file
    if line == "LAST":
        number = len((tree / place).read_text(encoding="utf-8").splitlines()) - 3
    else:
        number = line_of(tree / place, line)
    new = found(tree) - before
    near = {(name, at, kind) for name, at, kind in new if name == place and kind == check}
    assert any(abs(at - number) <= 3 for _, at, _ in near), sorted(new)
    caught.append(check)


def test_removed_verifying_tag_is_found_at_the_test(
    tree: Path, before: set[tuple[str, int, str]], caught: list[str]
) -> None:
    SEEDED.add("req-name")
    path = next(
        path
        for path in sorted((tree / "tests").rglob("*.cpp"))
        if re.search(r"FR15_\w+\)", path.read_text(encoding="utf-8"))
    )
    lines = path.read_text(encoding="utf-8").splitlines()
    test = next(number for number, line in enumerate(lines) if re.search(r"^TEST.*FR15_", line))
    tag = max(number for number in range(test) if "@verifies FR-15" in lines[number])
    del lines[tag]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    file = str(path.relative_to(tree))
    assert (file, test, "req-name") in found(tree) - before
    caught.append("req-name")
