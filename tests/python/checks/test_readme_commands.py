"""The README and the pages may name only commands, folders, pins and programs that exist. The
checks find all other names."""

from pathlib import Path

from traceability.checks.link_checks import (
    missing_commands,
    missing_parts,
    missing_paths,
)


def test_commands_options_and_folders_that_are_missing_are_found(tmp_path: Path) -> None:
    (tmp_path / "tools").mkdir()
    (tmp_path / "tools" / "sim.py").write_text('add_parser("sim")\nadd("--board")\n')
    readme = tmp_path / "README.md"
    readme.write_text(
        "./wr sim --board  # runs, or --bord\n./wr sim --help\n./wr fly --high\n| `lost/` |\n"
    )
    assert [finding.text for finding in missing_commands(tmp_path)] == [
        "./wr has no --bord",
        "./wr has no fly",
        "./wr has no --high",
    ]
    assert [finding.text for finding in missing_paths(tmp_path)] == ["there is no lost/"]


def test_products_programs_folders_pins_and_keys_that_are_missing_are_found(tmp_path: Path) -> None:
    files = {
        "src/k64/pins.hpp": "// PTA0 belongs to the debugger.\n{{Port::B, 2, Mux::Alt0}}",
        "tests/CMakeLists.txt": "add_executable(board_tests test.cpp)",
        "client/keyboard.py": 'STOP = b"r"',
        "CMakePresets.json": '{"configurePresets": [{"name": "host"}]}',
        "tools/steps.py": 'LOGS = root / "build" / "logs"',
        "design/products.toml": "parts = {}\nproduct = []\n",
        "docs/page.rst": "PTA0 PTB2 PTB3, ``--level PTC6=0``\n"
        "build/host/tests/board_tests build/host/tests/boards\n"
        "key ``r``, key ``x``\n./wr sim --product none\n"
        "build/logs build/log build/metrics.json\n",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    assert [(one.place.line, one.text) for one in missing_parts(tmp_path)] == [
        (1, "there is no pin PTB3 in use"),
        (2, "there is no program 'boards'"),
        (3, "there is no key 'x'"),
        (4, "there is no product 'none'"),
        (5, "there is no build/log"),
    ]
