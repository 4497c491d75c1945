"""./wr debug: opens GDB at a test, at a scenario, or at the firmware on the virtual board."""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from tools.cmake_build import BOARD_TESTS, TESTS, board_words, build
from tools.firmware import add_product
from tools.lock import only_one
from tools.steps import FailureError, MissingError, UsageError, log_of, need_file
from tools.tasks import RECORDED_IMAGES, VIRTUAL_BOARD, graph
from traceability.reading.gtest_cases import read_tests
from traceability.reading.products import PAPER, recorded_image_of
from traceability.reading.results import BOARD_ONLY, HOST_ONLY
from traceability.sources import files_below

GDB_FOR_ARM = ("gdb-multiarch", "arm-none-eabi-gdb")
ON_HOST = "debug"  # preset of the programs that are debugged on this computer
# Folders with tests of the emulators. The emulators are programs for the host, and these tests do
# not run on the virtual board.
OF_EMULATOR = ("tests/sim/", "tests/torture/")
SCENARIO = ".scenario"
SCENARIO_ADVICE = "name the file of a scenario, such as a file of sim/scenario/examples"
TEST_ADVICE = "the page 'Tests' of the portal lists the names of the tests"
WAIT = 20  # longest time until the virtual board opens its port [s]


@dataclass(frozen=True)
class Target:
    """The command that starts the debugger, and the command that starts the virtual board to which
    the debugger connects. A program for the host needs no board."""

    gdb: list[str]
    server: list[str] = field(default_factory=list)
    port: int = 0  # port of the server
    variables: dict[str, str] = field(default_factory=dict)
    images: bool = False  # true: the firmware images and the virtual board are built first
    program: tuple[str, str] | None = None  # preset and name of a program that is built first


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "debug",
        description="Builds a test with full debug information, and opens it in GDB. If the test "
        "runs only on the virtual board, it is debugged there. If you name a scenario or "
        "nothing, GDB debugs the firmware image on the virtual board. There, GDB can execute "
        "the image forwards and backwards.",
    )
    parser.add_argument(
        "name",
        nargs="?",
        metavar="TEST",
        help="a test of the firmware (RcBufferTest.FR53_MiddleSetsZero), a test of the tools "
        "(tests/python/FILE.py::TEST), or the file of a scenario (default: the robot in real "
        "time, with its PC link)",
    )
    parser.add_argument(
        "--board",
        action="store_true",
        help="if a test runs on both targets, debug it on the virtual board",
    )
    add_product(parser, "the product whose firmware image runs on the virtual board")
    parser.add_argument(
        "--print", action="store_true", dest="shows", help="print the commands, and run nothing"
    )
    parser.set_defaults(run=debug)


def debug(root: Path, options: argparse.Namespace) -> int:
    target = target_of(root, options)
    if not options.shows and (target.images or target.program):
        build_for(root, target)
    return start(root, target, options.shows)


def target_of(root: Path, options: argparse.Namespace) -> Target:
    name: str | None = options.name
    if name and "::" in name:
        need_file(root / name.partition("::")[0], TEST_ADVICE)
        pytest = [str(root / ".venv/bin/python"), "-m", "pytest", "-p", "no:xdist", "--pdb"]
        return Target([*pytest, name])
    if name and name.endswith(SCENARIO):
        need_file(Path(name), SCENARIO_ADVICE)
    if name is None or name.endswith(SCENARIO):
        return board_target(root, options.product, name)
    file = file_of(root, name)
    if runs_on_board(file, chosen=options.board):
        return board_test(root, name)
    return host_test(root, name, file)


def file_of(root: Path, name: str) -> str:
    """Returns the file of a test. The name has the form Suite.Name, as on the page 'Tests'."""
    for file, found in tests_below(root):
        if found == name:
            return file
    raise UsageError(f"there is no test {name}; the page 'Tests' of the portal lists the names")


def filter_of(name: str) -> str:
    """Returns the option of GoogleTest that selects a test. If the test has parameters or types,
    the option selects all its instances."""
    suite, _, case = name.partition(".")
    return f"--gtest_filter={name}:*/{suite}.{case}/*:{suite}/*.{case}"


def tests_below(root: Path) -> Iterator[tuple[str, str]]:
    for path in files_below(root, ("tests",)):
        if path.suffix == ".cpp":
            for case in read_tests(path.read_text(encoding="utf-8")):
                yield str(path.relative_to(root)), case.id


def runs_on_board(file: str, *, chosen: bool) -> bool:
    """Returns whether the firmware of the test is debugged on the virtual board."""
    if file.startswith(OF_EMULATOR):
        return False
    if chosen and not file.startswith((*BOARD_ONLY, "tests/system/")):
        raise UsageError(f"{file} does not run on the virtual board; leave out --board")
    return file.startswith(BOARD_ONLY) or (chosen and not file.startswith(HOST_ONLY))


# ---- targets -----------------------------------------------------------------


def gdb_for_arm() -> str:
    for name in GDB_FOR_ARM:
        if shutil.which(name):
            return name
    raise MissingError("GDB for Arm is missing; install the package gdb-multiarch")


def gdb_of_board(elf: Path, port: int) -> list[str]:
    """Returns the command that starts GDB with the symbols of a firmware image. GDB then connects
    to the board that waits at the port."""
    commands = (f"directory {elf.parent}", f"target remote :{port}")
    words = [gdb_for_arm(), "-q", str(elf)]
    return [*words, *(word for command in commands for word in ("-ex", command))]


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as found:
        return int(found.getsockname()[1])


def board_target(root: Path, product: str, scenario: str | None) -> Target:
    port = free_port()
    image = recorded_image_of(product, ".bin")
    world = ["--scenario", scenario] if scenario else ["--link", str(root / "build" / "pc-link")]
    words = [*board_words(root, image), "--robot", *world, "--gdb", str(port)]
    return Target(gdb_of_board(root / image.with_suffix(".elf"), port), words, port, images=True)


def board_test(root: Path, name: str) -> Target:
    port = free_port()
    words = [str(root / "build" / "host" / "tests" / BOARD_TESTS), filter_of(name)]
    elf = root / recorded_image_of(PAPER, ".elf")
    variables = {"WR_GDB": str(port), "WR_IMAGE": str(elf.with_suffix(".bin"))}
    gdb, program = gdb_of_board(elf, port), ("host", BOARD_TESTS)
    return Target(gdb, words, port, variables, images=True, program=program)


def host_test(root: Path, name: str, file: str) -> Target:
    on_board = file.startswith(BOARD_ONLY)
    preset, target = ("host", BOARD_TESTS) if on_board else (ON_HOST, TESTS)
    gdb = ["gdb", "-q", "--args", str(root / "build" / preset / "tests" / target), filter_of(name)]
    return Target(gdb, images=on_board, program=(preset, target))


def wait_for_port(server: subprocess.Popen[bytes], port: int) -> None:
    """Waits until the system lists the port as open. This function does not connect to the port,
    because the board would treat this connection as the connection of GDB."""
    wanted = f":{port:04X} 00000000:0000 0A"
    end = time.monotonic() + WAIT
    while time.monotonic() < end and server.poll() is None:
        if wanted in Path("/proc/net/tcp").read_text(encoding="ascii"):
            return
        time.sleep(0.05)
    raise FailureError("the board did not open its port for GDB; see its messages above")


# ---- running -----------------------------------------------------------------


def build_for(root: Path, target: Target) -> None:
    """Builds the programs that a target needs."""
    with only_one(root, "debug"):
        if target.images and graph(root).run((RECORDED_IMAGES, VIRTUAL_BOARD)).failed:
            raise FailureError("the build failed; see its messages above")
        if target.program:
            preset, program = target.program
            print(f"builds {program} of the preset {preset}", flush=True)
            with log_of(root, "debug").open("w") as log:
                build(root, preset, log, program)


def start(root: Path, target: Target, shows: bool) -> int:
    """Starts the server, and then starts GDB in this terminal."""
    for words in (target.server, target.gdb):
        if words:
            variables = [f"{key}={value}" for key, value in target.variables.items()]
            prefix = variables if words is target.server else []
            print(shlex.join([*prefix, *words]), flush=True)
    if shows:
        return 0
    if not shutil.which(target.gdb[0]):
        raise MissingError(f"{target.gdb[0]} is not installed; install it, and try again")
    if not target.server:
        return subprocess.run(target.gdb, check=False, cwd=root).returncode
    environment = {**os.environ, **target.variables}
    # GDB must get Ctrl-C. The server is therefore in a separate session.
    with subprocess.Popen(
        target.server, env=environment, cwd=root, start_new_session=True
    ) as server:
        try:
            wait_for_port(server, target.port)
            return subprocess.run(target.gdb, check=False, cwd=root).returncode
        finally:
            server.terminate()
            sys.stdout.flush()
