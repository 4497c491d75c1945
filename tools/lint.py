"""./wr lint: checks style, types and warnings."""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
from collections import defaultdict
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import TextIO

from tools.cmake_build import TESTS, build
from tools.includes import included
from tools.prose import lint_prose
from tools.steps import FailureError, run
from tools.task_graph import Graph, Outcome, Reporter, Task
from traceability.model.build import commit, logic_of
from traceability.reading.lint_record import (
    FAILED,
    FOLDERS,
    NOT_RUN,
    PASSED,
    files_hash,
    read_prose,
    tidied,
    write_lint,
    write_prose,
)
from traceability.reading.translation_units import clang_arguments, is_board
from traceability.sources import DESIGN, include_options
from traceability.whole_file import write_json, write_whole

# This file lists, for each logic module, the logic modules that it may include. CMake writes this
# file.
MAP = "build/host/logic_modules.modulemap"
CODE = (*DESIGN, "changes", "ports", "sim", "tests")
PYTHON = ("traceability", "site", "tools", "client", "sim", "tests/python")
TYPED = ("traceability", "site/portal", "tools", "client/weeding_robot_client", "sim/scenario")
PACKAGES = "setup/python.lock"  # the versions of the linters
# A name that a source defines outside of classes.
DEFINED = re.compile(r"^(?!namespace)[a-z][^\n()={;/]*?(?<![:\w~])(\w+) ?[=({;]", re.MULTILINE)
JOINED = 16  # greatest number of source files that clang-tidy checks together
# The analyzer of clang examines fewer states of a function than the default, which is 225000. The
# few functions with many paths through loops would otherwise take half of the time of clang-tidy.
ANALYZER = ("-Xclang", "-analyzer-config", "-Xclang", "max-nodes=75000")
LINT_RECORD = Path("build/lint.json")
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
        description="Checks the format of all sources. Compiles all sources with clang, which must "
        "report no warnings and no forbidden includes. Compiles each header alone. "
        "Runs clang-tidy on the design, the ports (without their tests) and sim (without the "
        "module for the web). Checks the Python sources with "
        "ruff and mypy, and checks the directions of their imports. Finds words that the "
        "glossary replaces.",
    )
    parser.add_argument(
        "--quick",
        action="store_true",
        help="leave out clang-tidy, the compilation of each header alone, and the compilation of "
        "the tests of the firmware",
    )
    parser.set_defaults(run=lambda root, options: lint(root, quick=options.quick))


def lint(root: Path, *, quick: bool) -> int:
    tasks = lint_tasks(root, quick=quick)
    files = files_hash(root)
    results = Graph(root, tasks, record=LINT_RECORD).run([task.name for task in tasks])
    record_steps(root, results, files)
    return 1 if results.failed else 0


def record_steps(root: Path, results: Reporter, files: str) -> None:
    """Writes the result of each step for the portal. ``files`` is the hash of the files before the
    first step."""
    names = [task.name for task in lint_tasks(root, quick=False)]
    steps = {name: result_of(results.progress.done.get(name)) for name in names}
    write_lint(root, steps, commit(root), files)


def result_of(outcome: Outcome | None) -> str:
    if outcome is None or outcome.note.startswith(NOT_RUN):
        return NOT_RUN
    return FAILED if outcome.failed else PASSED


def lint_tasks(root: Path, *, quick: bool) -> list[Task]:
    """Returns the tasks of this command. A task without inputs runs whenever the command is called:
    it finds the changed files itself. A task with inputs runs only after a change of its inputs."""
    tools = root / ".venv" / "bin"

    def ruff(log: TextIO) -> None:
        config: list[str | Path] = ["--config", root / "pyproject.toml"]
        paths = [root / name for name in PYTHON]
        run(log, [tools / "ruff", "check", *config, *paths])
        run(log, [tools / "ruff", "format", "--check", *config, *paths])

    def mypy(log: TextIO) -> None:
        config: list[str | Path] = ["--config-file", root / "pyproject.toml"]
        run(log, [tools / "mypy", "--strict", *config, *(root / name for name in TYPED)])

    def task(
        name: str,
        action: Callable[[Path, TextIO], str | None],
        inputs: tuple[str, ...] = (),
        after: tuple[str, ...] = (),
    ) -> Task:
        return Task(name, partial(action, root), inputs, after=after, always=not inputs)

    built = "clang without warnings"
    long = [
        task(f"{built} (tests of the firmware)", build_tests_with_clang, after=(built,)),
        task("clang-tidy", check_tidy, after=(built,)),
        task("headers alone", check_headers, after=(built,)),
    ]
    return [
        task(built, build_with_clang),
        task("clang-format", check_format, (*CODE, ".clang-format", PACKAGES)),
        Task("ruff", ruff, (*PYTHON, "pyproject.toml", PACKAGES)),
        Task("mypy", mypy, (*TYPED, "pyproject.toml", PACKAGES)),
        task("imports", check_imports, (*TYPED, "pyproject.toml", PACKAGES)),
        Task(
            "prose",
            partial(check_prose, root),
            (*FOLDERS, PACKAGES),
            always=read_prose(root) is None,
        ),
        *([] if quick else long),
    ]


def sources(root: Path, folders: Iterable[str], suffix: str) -> list[Path]:
    skipped = root / "tests" / "python"
    return sorted(
        path
        for folder in folders
        for path in (root / folder).rglob(f"*{suffix}")
        if skipped not in path.parents
    )


def on_board(root: Path, path: Path) -> bool:
    """Returns whether a source is for the K64 only."""
    return is_board(str(path.relative_to(root)))


def check_imports(root: Path, log: TextIO) -> None:
    """Checks the contracts of pyproject.toml. They forbid cycles, and they state the imports that
    each package may have."""
    folders = (root, root / "site", root / "client")
    env = os.environ | {"PYTHONPATH": os.pathsep.join(map(str, folders))}
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
    """Compiles all sources with clang, except the tests of the firmware."""
    build(root, "host", log)
    words = [*clang_arguments(board=True), *WARNINGS, *include_options(root)]
    words += [f"-fmodule-map-file={root / MAP}", "-fmodules-decluse", "-Xclang", "-fno-cxx-modules"]
    for source in filter(partial(on_board, root), sources(root, DESIGN, ".cpp")):
        module = logic_of(str(source.relative_to(root))).replace("/", ".")
        run(log, ["clang++", "-fsyntax-only", *words, f"-fmodule-name={module}", str(source)])


def build_tests_with_clang(root: Path, log: TextIO) -> None:
    """Compiles the tests of the firmware with clang. The preset host does not contain them."""
    build(root, "sanitize", log, TESTS)


def check_headers(root: Path, log: TextIO) -> None:
    """Compiles each header alone. The headers of the drivers are compiled for the K64. The other
    headers are compiled for this computer."""
    for preset in ("host", "k64"):
        build(root, preset, log, "all_verify_interface_header_sets")


def check_tidy(root: Path, log: TextIO) -> str:
    """Runs clang-tidy on the design, the ports and sim.

    Most of the time is spent on headers that the sources share. Several sources are therefore
    checked as one file."""

    def command(unit: tuple[Path, ...]) -> list[str]:
        source = unit[0] if len(unit) == 1 else joined(root, unit)
        words = [str(root / ".venv" / "bin" / "clang-tidy"), "--quiet", str(source), "--"]
        return [*words, *tidy_options(root, unit[0]), *ANALYZER]

    return check_changed(root, "tidy", units_of(root, tidied(root, (".cpp",))), command, log)


def tidy_options(root: Path, source: Path) -> list[str]:
    """Returns the compiler options that clang-tidy uses for a source file."""
    if on_board(root, source):
        return [*clang_arguments(board=True), *include_options(root)]
    if source.is_relative_to(root / "ports"):
        # The compiler finds the headers of a port before the headers of the design.
        own = [f"-I{folder}" for folder in source.parents if folder.is_relative_to(root)]
        return [*clang_arguments(board=True), *own, *include_options(root)]
    if source.is_relative_to(root / "sim"):
        directory = root / "build" / "host"
        rooms = [f"-I{room}" for room in sorted((directory / "rooms").iterdir())]
        return ["-std=c++20", *rooms, *include_options(root), f"-I{directory}/frames"]
    return ["-std=c++20", "-fno-exceptions", "-fno-rtti", *include_options(root)]


def units_of(root: Path, paths: list[Path]) -> list[tuple[Path, ...]]:
    """Groups the source files. clang-tidy checks each group as one file. The files of a group have
    the same settings and options, and define different names outside of classes."""
    units: dict[tuple[object, ...], list[tuple[list[Path], set[str]]]] = defaultdict(list)
    for path in paths:
        own = set(DEFINED.findall(path.read_text(encoding="utf-8")))
        alike = units[*settings(root, path), *tidy_options(root, path)]
        free = (unit for unit in alike if len(unit[0]) < JOINED and unit[1].isdisjoint(own))
        unit = next(free, None)
        if unit is None:
            alike.append(([path], own))
        else:
            unit[0].append(path)
            unit[1].update(own)
    return [tuple(unit) for alike in units.values() for unit, _ in alike]


def joined(root: Path, unit: tuple[Path, ...]) -> Path:
    """Writes the sources of a unit into one file, and copies the settings of their folder.

    The file contains copies of the sources, because several checks of clang-tidy do not examine
    included files."""
    folder = root / "build" / "lint" / "units"
    file = folder / unit[0].relative_to(root)
    for found in settings(root, unit[0]):
        if found.parent != root:
            write_whole(folder / found.relative_to(root), found.read_text(encoding="utf-8"))
    write_whole(file, "\n".join(path.read_text(encoding="utf-8") for path in unit))
    return file


def check_changed(
    root: Path,
    name: str,
    units: list[tuple[Path, ...]],
    command: Callable[[tuple[Path, ...]], list[str]],
    log: TextIO,
) -> str:
    """Runs the command on each unit, except if the unit passed before with the same content. If a
    unit fails, runs the command on each of its files.

    The content of a unit consists of its files, the project's files that are included in them, the
    settings of clang-tidy, and the command."""
    store = root / "build" / "lint" / f"{name}.json"
    passed = json.loads(store.read_text()) if store.exists() else {}
    keys = {unit: key_of(root, unit, command(unit)) for unit in units}
    changed = [unit for unit, key in keys.items() if passed.get(name_of(root, unit)) != key]

    def failed_files(unit: tuple[Path, ...]) -> dict[Path, str]:
        ended = subprocess.run(command(unit), capture_output=True, text=True, check=False)
        if ended.returncode == 0:
            return {}
        if len(unit) == 1:
            return {unit[0]: ended.stdout + ended.stderr}
        # The compiler may reject the joined sources although it accepts each source alone.
        return {path: text for one in unit for path, text in failed_files((one,)).items()}

    failed: dict[Path, str] = {}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(failed_files, changed):
            failed |= found
    log.writelines(f"{path.relative_to(root)}:\n{text}\n" for path, text in failed.items())
    good = {name_of(root, unit): key for unit, key in keys.items() if not failed.keys() & unit}
    write_json(store, good)
    count = sum(map(len, units))
    if failed:
        raise FailureError(f"clang-tidy rejects {len(failed)} of {count} files")
    return f"{count} files, {sum(map(len, changed))} of them changed"


def name_of(root: Path, unit: tuple[Path, ...]) -> str:
    return str(unit[0].relative_to(root))


def key_of(root: Path, unit: tuple[Path, ...], command: list[str]) -> str:
    """Returns the hash of all inputs that determine the result of a command on a unit."""
    total = hashlib.sha256(" ".join(command).encode())
    for part in (*unit, *settings(root, unit[0]), *sorted(included(root, unit))):
        total.update(part.read_bytes())
    return total.hexdigest()


def settings(root: Path, path: Path) -> list[Path]:
    """Returns the settings of clang-tidy for a file."""
    folders = [parent for parent in path.parents if parent.is_relative_to(root)]
    return [file for folder in folders if (file := folder / ".clang-tidy").exists()]
