"""The libraries of the logic modules. The build fails if a module uses another module without
permission in the design."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.python.project_files import write_files
from traceability.reading.declared import read_declared

ROOT = Path(__file__).parents[3]
PROJECT = f"""\
cmake_minimum_required(VERSION 3.25)
project(lamp LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_VERIFY_INTERFACE_HEADER_SETS ON)
add_library(common_options INTERFACE)
add_library(firmware_options INTERFACE)
include({ROOT}/src/logic_modules.cmake)
add_executable(lamp main.cpp)
target_link_libraries(lamp PRIVATE switch)
"""
TREE = {
    "CMakeLists.txt": PROJECT,
    "design/uses.toml": '[uses."switch"]\n"switch/states" = "A switch has states."\n',
    "main.cpp": '#include "switch/Switch.hpp"\n\nint main() { return turn(); }\n',
    "src/switch/Switch.hpp": '#pragma once\n#include "switch/states/On.hpp"\nint turn();\n',
    "src/switch/Switch.cpp": '#include "switch/Switch.hpp"\n\nint turn() { return on(); }\n',
    "src/switch/states/On.hpp": "#pragma once\nint on();\n",
    "src/switch/states/On.cpp": '#include "switch/states/On.hpp"\n\nint on() { return 1; }\n',
    "src/bulb/Bulb.hpp": "#pragma once\n#include <cstdint>\nint glow();\n",
    "src/bulb/Bulb.cpp": '#include "bulb/Bulb.hpp"\n\nint glow() { return 2; }\n',
}
INCLUDE = '\n#include "bulb/Bulb.hpp"\n'
REFUSED = "module switch does not depend on a module exporting 'bulb/Bulb.hpp'"


def build(root: Path, file: str, before: str, after: str) -> str:
    """Builds the small project of a lamp after one change of a file. Returns the messages of a
    failed build. Returns an empty text if the build does not fail."""
    write_files(root, TREE)
    assert before in TREE[file]
    (root / file).write_text(TREE[file].replace(before, after, 1), encoding="utf-8")
    configure = ["cmake", "-G", "Ninja", "-DCMAKE_CXX_COMPILER=clang++", "-S", root, "-B", "build"]
    subprocess.run(configure, cwd=root, check=True, capture_output=True, timeout=60)
    words = ["ninja", "-C", "build", "-k", "0", "all", "all_verify_interface_header_sets"]
    done = subprocess.run(words, cwd=root, capture_output=True, text=True, check=False, timeout=60)
    return done.stdout if done.returncode else ""


@pytest.mark.parametrize(
    ("file", "before", "after", "message"),
    [
        ("main.cpp", "\n", INCLUDE, ""),  # The rules concern only logic modules.
        ("src/switch/Switch.cpp", "\n", INCLUDE, REFUSED),
        ("src/switch/Switch.cpp", "\n", INCLUDE.replace("bulb/", "../bulb/"), "does not depend"),
        ("src/switch/Switch.hpp", "\n", INCLUDE, REFUSED),
        # The header does not compile alone.
        (
            "src/switch/states/On.hpp",
            "on()",
            "on(std::int32_t)",
            "int32_t",
        ),
        ("design/uses.toml", "switch/states", "bulb", "does not depend"),
        ("src/switch/Switch.cpp", "return on", "int glow(); return glow", "undefined reference"),
    ],
)
def test_a_forbidden_use_fails_the_build(
    file: str, before: str, after: str, message: str, tmp_path: Path
) -> None:
    output = build(tmp_path, file, before, after)
    assert message in output
    assert bool(message) == bool(output)


def test_cmake_reads_each_use() -> None:
    """CMake reads design/uses.toml line by line, and Python reads this file as TOML. Each permitted
    use must therefore be on one line that CMake can read."""
    lines = (ROOT / "design" / "uses.toml").read_text(encoding="utf-8").splitlines()
    allowed = read_declared(ROOT).allowed
    assert allowed
    for use in allowed:
        assert lines[use.place.line - 1].startswith(f'"{use.target}" = ')
        assert f'[uses."{use.source}"]' in lines[: use.place.line]
