"""Hashes of files. They identify the inputs of a build, a test or a page."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from pathlib import Path

# The design, which consists of the robot and the extensions of the products.
SRC, EXTENSIONS = "src", "extensions"
DESIGN = (SRC, EXTENSIONS)
# The table of frames and its reader. The build of the simulator makes a header from them.
FRAMES = ("design/frames.toml", "client/weeding_robot_client/layout.py")
TESTED = (*DESIGN, "sim", "tests", "CMakeLists.txt", "CMakePresets.json")


def files_below(root: Path, names: Iterable[str], suffixes: tuple[str, ...] = ()) -> list[Path]:
    """Returns the files of the named folders, and the named files. The result is sorted and
    contains no Python caches.
    """
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


def include_options(root: Path) -> list[str]:
    """Returns the folders in which a compiler finds the headers of the design."""
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
    """Computes the hash of the files on which test results depend.

    Tests of the Python tools and records of campaigns are not included.
    """
    suffixes = (".cpp", ".hpp", ".h", ".cmake", ".txt", ".json", ".S", ".ld")
    paths = files_below(root, TESTED, suffixes)
    others = {root / "tests" / "python", root / "tests" / "records"}
    tested = [path for path in paths if others.isdisjoint(path.parents)]
    return hash_of(root, [*tested, *files_below(root, FRAMES)])
