"""./wr lint: style, types and warnings."""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from pathlib import Path
from typing import TextIO

from tools.cmake_build import build
from tools.prose import lint_prose
from tools.steps import FailureError, Steps, run
from traceability.model.build import logic_of
from traceability.reading.prose_record import write_prose
from traceability.reading.translation_units import clang_arguments, is_board
from traceability.sources import DESIGN, include_options
from traceability.whole_file import write_whole

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
# Which module may include which; CMake writes it.
MAP = "build/host/logic_modules.modulemap"
CODE = (*DESIGN, "changes", "ports", "sim", "tests")
CHECKED = (*DESIGN, "ports", "sim")
WEB = "sim/web/module"  # needs the library of WebAssembly, which clang-tidy does not find
WARNINGS = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wsign-conversion",
    "-Wold-style-cast",
    "-Wnon-virtual-dtor",
    "-Woverloaded-virtual",
    "-Wshadow",
    "-Wno-unused-command-line-argument",
    "-Werror",
]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "lint",
        description="Checks the format of all sources, compiles everything with clang without "
        "warnings or forbidden includes and each header alone, runs clang-tidy on the design and "
        "sim, and checks the Python sources with ruff and mypy, and the directions of their "
        "imports.",
    )
    parser.set_defaults(run=lambda root, _options: lint(root))


def lint(root: Path) -> int:
    steps = Steps(root, 8)
    tools = root / ".venv" / "bin"
    python = ["traceability", "site", "tools", "client", "sim", "tests/python"]
    steps.run("clang-format", lambda log: check_format(root, log))
    steps.run("clang without warnings", lambda log: build_with_clang(root, log))
    steps.run("headers alone", lambda log: check_headers(root, log))
    steps.run("clang-tidy", lambda log: check_tidy(root, log))

    def ruff(log: TextIO) -> None:
        config: list[str | Path] = ["--config", root / "pyproject.toml"]
        paths = [root / name for name in python]
        run(log, [tools / "ruff", "check", *config, *paths])
        run(log, [tools / "ruff", "format", "--check", *config, *paths])

    def mypy(log: TextIO) -> None:
        config: list[str | Path] = ["--config-file", root / "pyproject.toml"]
        names = ("traceability", "site/portal", "tools", "client/weeding_robot_client")
        packages = [root / name for name in (*names, "sim/scenario")]
        run(log, [tools / "mypy", "--strict", *config, *packages])

    steps.run("ruff", ruff)
    steps.run("mypy", mypy)
    steps.run("imports", lambda log: check_imports(root, log))
    steps.run("prose", lambda log: check_prose(root, log))
    return 1 if steps.failed else 0


def sources(root: Path, folders: Iterable[str], suffix: str) -> list[Path]:
    skipped = root / "tests" / "python"
    return sorted(
        path
        for folder in folders
        for path in (root / folder).rglob(f"*{suffix}")
        if skipped not in path.parents
    )


def on_board(root: Path, path: Path) -> bool:
    """Whether a source is for the K64 only."""
    return is_board(str(path.relative_to(root)))


def check_imports(root: Path, log: TextIO) -> None:
    """Checks the contracts of pyproject.toml: the allowed imports of each package, without
    cycles."""
    env = os.environ | {"PYTHONPATH": os.pathsep.join([str(root), str(root / "site")])}
    linter = Path(sys.executable).with_name("lint-imports")
    run(log, [linter, "--config", "pyproject.toml", "--no-logo"], env, folder=root)


def check_prose(root: Path, log: TextIO) -> str:
    """Finds the words that the glossary replaces."""
    findings = lint_prose(root)
    write_prose(root, len(findings))
    log.writelines(f"{finding}\n" for finding in findings)
    if findings:
        raise FailureError(f"{len(findings)} words that the glossary replaces")
    return "0 findings"


def check_format(root: Path, log: TextIO) -> str:
    paths = sources(root, CODE, ".hpp") + sources(root, CODE, ".cpp")
    if paths:
        run(log, [root / ".venv/bin/clang-format", "--dry-run", "-Werror", *paths])
    return f"{len(paths)} files"


def build_with_clang(root: Path, log: TextIO) -> None:
    for preset in ("host", "sanitize"):
        build(root, preset, log)
    words = [*clang_arguments(board=True), *WARNINGS, *include_options(root)]
    words += [f"-fmodule-map-file={root / MAP}", "-fmodules-decluse", "-Xclang", "-fno-cxx-modules"]
    for source in filter(partial(on_board, root), sources(root, DESIGN, ".cpp")):
        module = logic_of(str(source.relative_to(root))).replace("/", ".")
        run(log, ["clang++", "-fsyntax-only", *words, f"-fmodule-name={module}", str(source)])


def check_headers(root: Path, log: TextIO) -> None:
    """Compiles each header alone: with clang for this machine, or for the K64 if it belongs to a
    driver."""
    for preset in ("host", "k64"):
        build(root, preset, log, "all_verify_interface_header_sets")


def check_tidy(root: Path, log: TextIO) -> str:
    directory = root / "build" / "host"
    if not (directory / "compile_commands.json").exists():
        raise FailureError("the build with clang is missing")

    def command(source: Path) -> list[str]:
        words = [str(root / ".venv" / "bin" / "clang-tidy"), "--quiet", str(source)]
        if on_board(root, source):
            return [*words, "--", *clang_arguments(board=True), *include_options(root)]
        if source.is_relative_to(root / "ports"):
            # The headers of a port are found before those of the design.
            own = [f"-I{folder}" for folder in source.parents if folder.is_relative_to(root)]
            return [*words, "--", *clang_arguments(board=True), *own, *include_options(root)]
        if source.is_relative_to(root / "sim"):
            # CMake compiles several of these sources as one, or with parsed headers.
            rooms = [f"-I{room}" for room in sorted((directory / "rooms").iterdir())]
            return [
                *words,
                "--",
                "-std=c++20",
                *rooms,
                *include_options(root),
                f"-I{directory}/frames",
            ]
        return [*words, "-p", str(directory)]

    checked = [
        source
        for source in sources(root, CHECKED, ".cpp")
        if not source.is_relative_to(root / WEB) and source.parent.name != "tests"
    ]
    return check_changed(root, "tidy", checked, command, log)


def check_changed(
    root: Path,
    name: str,
    paths: list[Path],
    command: Callable[[Path], list[str]],
    log: TextIO,
) -> str:
    """Runs the command on each file whose present content has not passed it yet.

    The content of a file includes the files of the project that it includes, the settings of
    clang-tidy, and the command.
    """
    store = root / "build" / "lint" / f"{name}.json"
    passed = json.loads(store.read_text()) if store.exists() else {}
    keys = {}
    for path in paths:
        total = hashlib.sha256(" ".join(command(path)).encode())
        for part in (*settings(root, path), *sorted(included(root, path))):
            total.update(part.read_bytes())
        keys[str(path.relative_to(root))] = total.hexdigest()
    changed = [file for file, key in keys.items() if passed.get(file) != key]

    def check(file: str) -> tuple[str, bool, str]:
        words = command(root / file)
        ended = subprocess.run(words, capture_output=True, text=True, check=False)
        return file, ended.returncode == 0, ended.stdout + ended.stderr

    failed = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for file, good, output in pool.map(check, changed):
            if not good:
                failed.append(file)
                log.write(f"{file}:\n{output}\n")
    good_keys = {file: key for file, key in keys.items() if file not in failed}
    write_whole(store, json.dumps(good_keys, indent=1))
    if failed:
        raise FailureError(f"{len(failed)} of {len(paths)} files")
    return f"{len(paths)} files, {len(changed)} of them changed"


def settings(root: Path, path: Path) -> list[Path]:
    """The settings of clang-tidy for a file."""
    folders = [parent for parent in path.parents if parent.is_relative_to(root)]
    return [file for folder in folders if (file := folder / ".clang-tidy").exists()]


def included(root: Path, path: Path) -> set[Path]:
    """The file and all files of the project that it includes, directly or not."""
    files: set[Path] = set()
    waiting = [path]
    while waiting:
        file = waiting.pop()
        if file not in files:
            files.add(file)
            waiting += direct(root, file)
    return files


@cache
def direct(root: Path, path: Path) -> tuple[Path, ...]:
    names = INCLUDE.findall(path.read_text(errors="replace"))
    places = (path.parent, *(root / name for name in DESIGN), root)
    return tuple(
        next(place / name for place in places if (place / name).exists())
        for name in names
        if any((place / name).exists() for place in places)
    )
