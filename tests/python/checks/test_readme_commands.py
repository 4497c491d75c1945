"""In the README and on the pages, each command, option, folder, pin and program must exist. The
checks find the names of commands, options, folders, pins and programs that do not exist."""

from pathlib import Path

from tests.python.project_files import write_files
from traceability.checks.link_checks import missing_parts
from traceability.checks.option_checks import literal_exit_codes, missing_options, wrong_values
from traceability.checks.path_checks import missing_paths

NONE = "belongs to no command or program on this page"


TOOL = """
def add(commands):
    parser = commands.add_parser("sim", description="Runs it; see --bord.")
    parser.add_argument("--board", help="with --gdb")
    add_gdb(parser)

def add_gdb(parser):
    parser.add_argument("--gdb")
"""
CLIENT = """
def add(commands):
    entries = {"drive": (add_options, 1), "stop": (print, 2)}
    for name, entry in entries.items():
        commands.add_parser(name)

def add_options(parser):
    "Adds them, as ``git --stat``."
    parser.add_argument("--csv")
"""
PROGRAM = """#include "sim/programs/Link.hpp"
app.add_option_function<std::vector<int>>(
    "--level", settings.level);
"""


def test_commands_and_options_that_are_missing_are_found(tmp_path: Path) -> None:
    files = {
        "tools/sim.py": TOOL,
        "client/commands.py": CLIENT,
        "sim/programs/wr_board.cpp": PROGRAM,
        "sim/programs/Link.hpp": 'app.add_flag("--link", link);',
        "README.md": "./wr sim --board  # runs, or --gbd\n./wr sim --help\n./wr fly --high\n",
        "CONTRIBUTING.md": "`./wr drive --csv FILE` and `./wr stop --csv`\n",
        "docs/page.rst": "``wr_board`` has ``--level`` and ``--link NAME``, not ``--csv``.\n",
        "docs/any.rst": "``--csv FILE --csw``, ``cmake --preset x``\n",
        "design/answers.toml": "# of ./wr and\n[[a]]\n`--csv`: ./wr sim\n"
        "[[b]]\n`--csv`: ./wr drive",
    }
    write_files(tmp_path, files)
    found = [
        (one.place.file, one.place.line, one.text.replace(NONE, "*"))
        for one in missing_options(tmp_path)
    ]
    assert found == [
        ("tools/sim.py", 3, "no command has the option --bord"),
        ("CONTRIBUTING.md", 1, "./wr stop has no --csv"),
        ("README.md", 1, "the option --gbd *"),
        ("README.md", 3, "./wr has no fly"),
        ("design/answers.toml", 3, "the option --csv *"),
        ("docs/any.rst", 1, "the option --csw *"),
        ("docs/page.rst", 1, "the option --csv *"),
    ]


def test_a_value_that_the_option_does_not_accept_is_found(tmp_path: Path) -> None:
    files = {
        "sim/programs/wr_board.cpp": """app.add_option("--mode", mode, "stop; or warn")
            ->check(CLI::IsMember({"stop", "warn"}));
            app.add_option("--line", line)->check(CLI::Validator(
            [](const std::string& kind) { return kind + " is not pty or tcp:PORT"; }, ""));
            app.add_option("--image", image)->check(CLI::ExistingFile);""",
        "tools/flash.py": 'parser.add_argument("--with", choices=("drive", "pyocd"))',
        "tools/run.py": 'commands.add_parser("run").add_argument("kind", choices=("fast", "slow"))',
        "docs/page.rst": "``--mode warn``, ``--mode=halt``, ``--mode`` or\n"
        "--line tcp:0 --image any --line udp:0\n``--with drive``, ``--with usb``\n"
        "``./wr run fast``, ``./wr run quick``, ``./wr check all``\n",
    }
    write_files(tmp_path, files)
    assert [(one.place.line, one.text) for one in wrong_values(tmp_path)] == [
        (1, "--mode does not accept halt"),
        (2, "--line does not accept udp:0"),
        (3, "--with does not accept usb"),
        (4, "./wr run does not accept quick"),
    ]


def test_an_exit_code_that_is_a_number_is_found(tmp_path: Path) -> None:
    page = "It ends with exit code 5.\nThe exit code is then :exit:`FOUND`, or exit code\n"
    write_files(tmp_path, {"docs/page.rst": page})
    (found,) = literal_exit_codes(tmp_path)
    assert (found.place.line, found.text) == (1, "the exit code 5 is not inserted")


def test_an_exit_code_in_a_table_that_is_a_number_is_found(tmp_path: Path) -> None:
    table = ".. list-table:: Exit codes\n\n   * - :exit:`DONE`\n     - done\n   * - 3\n"
    write_files(tmp_path, {"docs/page.rst": f"{table}\nText\n\n   * - 7\n"})
    assert [one.place.line for one in literal_exit_codes(tmp_path)] == [5]


def test_a_folder_that_is_missing_is_found(tmp_path: Path) -> None:
    (tmp_path / "tools").mkdir()
    (tmp_path / "README.md").write_text("`lost/` |\n")
    assert [finding.text for finding in missing_paths(tmp_path)] == ["there is no lost/"]


def test_products_programs_folders_pins_and_keys_that_are_missing_are_found(tmp_path: Path) -> None:
    files = {
        "src/k64/pins.hpp": "// PTA0 belongs to the debugger.\n{{Port::B, 2, Mux::Alt0}}",
        "tests/CMakeLists.txt": "add_executable(board_tests test.cpp)",
        "ports/a/CMakeLists.txt": "set(name port_a)\nadd_executable(${name} a.cpp)",
        "src/k64/CMakeLists.txt": "add_image(robot main.cpp)",
        "client/keyboard.py": 'STOP = b"r"',
        "CMakePresets.json": '{"configurePresets": [{"name": "host"}]}',
        "tools/steps.py": 'LOGS = root / "build" / "logs"',
        "design/products.toml": "parts = {}\nproduct = []\n",
        "design/questions.toml": 'answer = "PTB5, `--product NAME`, build/host/PRODUCT.elf"',
        "design/frames.toml": 'check = "the wire at PTB4"',
        "docs/page.rst": "PTA0 PTB2 PTB3, ``--level PTC6=0``\n"
        "build/host/tests/board_tests build/host/tests/boards\n"
        "key ``r``, key ``x``\n./wr sim --product none\n"
        "build/logs build/log build/metrics.json\n"
        "build/host/robot.elf, build/host/rover.elf, build/host/robot.map,\n"
        "build/host/ports/a/port_a.elf, build/host/a/port_a.elf, build/logs/A.log\n",
    }
    write_files(tmp_path, files)
    assert [(one.place.line, one.text) for one in missing_parts(tmp_path)] == [
        (1, "there is no pin PTB4 in use"),
        (1, "there is no pin PTB5 in use"),
        (1, "there is no pin PTB3 in use"),
        (2, "there is no program 'tests/boards'"),
        (3, "there is no key 'x'"),
        (4, "there is no product 'none'"),
        (5, "there is no build/log"),
        (6, "there is no program 'rover'"),
        (7, "there is no program 'a/port_a'"),
    ]
