"""Lists the translation units of the design, and the compiler options for the host and for the K64.

A header and the source file of the same name are one translation unit. A header without a source
file is a separate unit. Files below ``src/k64`` and in the folder ``k64`` of an extension are
parsed for the K64, with the standard library of the K64 compiler."""

from __future__ import annotations

import functools
import re
import shutil
import subprocess
from pathlib import Path

from clang import cindex

from traceability.reading.programs import output_of
from traceability.sources import DESIGN, files_below

BOARD = re.compile(r"(src|extensions/\w+)/k64/")
BOARD_COMPILER = "arm-none-eabi-g++"
BOARD_FLAGS = ["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"]


def translation_units(root: Path) -> dict[str, list[str]]:
    """Returns a map from each translation unit to the files about which its syntax tree gives
    facts."""
    paths = [p for name in DESIGN for p in files_below(root, (name,), (".cpp", ".hpp"))]
    files = [str(path.relative_to(root)) for path in paths]
    units: dict[str, list[str]] = {}
    for file in files:
        source = file.removesuffix(".hpp") + ".cpp"
        unit = source if file.endswith(".hpp") and source in files else file
        units.setdefault(unit, []).append(file)
    return units


def is_board(file: str) -> bool:
    return BOARD.match(file) is not None


@functools.cache
def clang_arguments(board: bool) -> list[str]:
    common = ["-std=c++20", "-x", "c++", "-fno-exceptions"]
    if board:
        folders = [word for path in _board_folders() for word in ("-isystem", path)]
        target = ["--target=thumbv7em-none-eabihf", *BOARD_FLAGS, "-nostdinc", "-nostdinc++"]
        return [*common, *target, *folders]
    compiler = shutil.which("g++") or "g++"
    return [*common, "-isystem", output_of(compiler, "-print-file-name=include").strip()]


def _board_folders() -> list[str]:
    """Returns the folders in which the K64 compiler searches for system headers. The
    compiler itself prints the list of these folders."""
    answer = subprocess.run(
        [BOARD_COMPILER, *BOARD_FLAGS, "-E", "-x", "c++", "-v", "/dev/null"],
        capture_output=True,
        text=True,
        check=True,
    )
    listed = answer.stderr.partition("#include <...> search starts here:")[2]
    return [str(Path(line.strip()).resolve()) for line in listed.splitlines() if line[:1] == " "]


def standard(cache: Path, board: bool = False) -> Path:
    return cache / ("standard_k64.pch" if board else "standard.pch")


def prepare_standard(root: Path, cache: Path, board: bool) -> None:
    """Precompiles the headers of the standard library that the design includes. All translation
    units use the result."""
    names: set[str] = set()
    for path in files_below(root, DESIGN, (".cpp", ".hpp")):
        if board or not is_board(str(path.relative_to(root))):
            names.update(re.findall(r"^#include (<[^>]+>)", path.read_text("utf-8"), re.MULTILINE))
    parsed = standard(cache, board)
    header = parsed.with_suffix(".hpp")
    arguments = [
        "c++-header" if argument == "c++" else argument for argument in clang_arguments(board)
    ]
    # This option saves time: the templates of the headers are instantiated only once.
    arguments.append("-fpch-instantiate-templates")
    text = "".join(f"#include {name}\n" for name in sorted(names)) + f"// {arguments}\n"
    if header.exists() and header.read_text(encoding="utf-8") == text:
        return
    parsed.unlink(missing_ok=True)
    header.write_text(text, encoding="utf-8")
    options = cindex.TranslationUnit.PARSE_INCOMPLETE
    tree = cindex.Index.create().parse(str(header), args=arguments, options=options)
    if not any(problem.severity >= cindex.Diagnostic.Error for problem in tree.diagnostics):
        tree.save(str(parsed))
