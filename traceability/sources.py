"""Hashes of files. If a hash has changed, an input of a build, a test or a page has changed."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from pathlib import Path

# The folders with the code of the firmware: the basic robot (src), and the extensions that some
# variants of the robot (products) add.
SRC, EXTENSIONS = "src", "extensions"
DESIGN = (SRC, EXTENSIONS)
# The table of the protocol's frames, and the Python module that reads it. The build of the
# simulator generates a header from these two files.
FRAMES = ("design/frames.toml", "client/weeding_robot_client/layout.py")
TESTS_OF_TOOLS = Path("tests/python")
TESTED = (*DESIGN, "sim", "tests", "CMakeLists.txt", "CMakePresets.json")


def files_below(root: Path, names: Iterable[str], suffixes: tuple[str, ...] = ()) -> list[Path]:
    """Returns the named files, and the files below the named folders, sorted. If there are
    ``suffixes``, a file of a folder must have one of them. Files in Python caches are left out."""
    files: list[Path] = []
    for name in names:
        start = root / name
        if start.is_file():
            files.append(start)
        elif start.is_dir():
            files += [
                path
                for path in start.rglob("*")
                if path.is_file()
                and "__pycache__" not in path.parts
                and (not suffixes or path.suffix in suffixes)
            ]
    return sorted(files)


def text_of(path: Path) -> str:
    """Returns the text of a file. Returns an empty text if the file does not exist."""
    return path.read_text(encoding="utf-8") if path.is_file() else ""


def include_options(root: Path) -> list[str]:
    """Returns the compiler options (-I) for the folders with the headers of the design."""
    return [word for name in DESIGN for word in ("-I", str(root / name))]


def file_hash(path: Path) -> str:
    """Returns the SHA-256 of one file, or the empty string if the file does not exist."""
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return ""


def hash_of(root: Path, paths: Iterable[Path]) -> str:
    """Returns one SHA-256 over the names and the contents of files."""
    total = hashlib.sha256()
    for path in paths:
        total.update(f"{path.relative_to(root)}\0{file_hash(path)}\n".encode())
    return total.hexdigest()


def source_hash(root: Path) -> str:
    """Computes the hash of all files that can change the result of a C++ test.

    The files in tests/python and tests/records are not included.
    """
    suffixes = (".cpp", ".hpp", ".h", ".cmake", ".txt", ".json", ".S", ".ld")
    paths = files_below(root, TESTED, suffixes)
    others = {root / "tests" / "python", root / "tests" / "records"}
    tested = [path for path in paths if others.isdisjoint(path.parents)]
    return hash_of(root, [*tested, *files_below(root, FRAMES)])
