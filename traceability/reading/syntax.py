"""Reads facts about the code from the syntax tree of libclang, which reads C++ in the same way as
the Clang compiler.

The facts of each translation unit are in a cache. They are valid while the unit's own files and the
code of all included files are unchanged. A change of a comment in an included file does not matter.
"""

from __future__ import annotations

import functools
import hashlib
import multiprocessing
import pickle
import re
from inspect import signature
from pathlib import Path

from clang import cindex

from traceability.reading.ast_facts import IncludeFact, Syntax
from traceability.reading.ast_reader import Reader
from traceability.reading.comments import code_of
from traceability.reading.translation_units import (
    clang_arguments,
    is_board,
    prepare_standard,
    standard,
    translation_units,
)
from traceability.schema import Place
from traceability.sources import DESIGN, file_hash, include_options
from traceability.whole_file import write_whole

READERS = (
    *("syntax", "translation_units", "ast_reader", "ast_facts", "clang_names", "constants"),
    *("flow", "conditions"),
)


def read_syntax(root: Path, cache: Path) -> Syntax:
    """Returns the facts about all files of the design. Only translation units with changed files
    are parsed. The other facts are read from the cache."""
    cache.mkdir(parents=True, exist_ok=True)
    hashes: dict[str, str] = {}
    units = translation_units(root)
    stale: list[tuple[Path, Path, list[str], str]] = []
    for board in sorted({is_board(unit) for unit in units}):
        prepare_standard(root, cache, board)
    for unit, files in units.items():
        if not _is_stored(root, cache, unit, hashes):
            stale.append((root, cache, files, unit))
    _drop_old(cache, units)
    if len(stale) > 2:
        with multiprocessing.get_context("fork").Pool(2) as pool:
            pool.starmap(_parse_and_store, stale, chunksize=2)
    else:
        for work in stale:
            _parse_and_store(*work)
    result = Syntax()
    for unit in units:
        entry = pickle.loads(_entry(cache, unit).read_bytes())
        result.merge(pickle.loads(entry["facts"]))
    return result


def _entry(cache: Path, unit: str) -> Path:
    return cache / (unit.replace("/", "__") + ".facts")


def _drop_old(cache: Path, units: dict[str, list[str]]) -> None:
    names = {_entry(cache, unit).name for unit in units}
    for path in cache.glob("*.facts"):
        if path.name not in names:
            path.unlink()


def _is_stored(root: Path, cache: Path, unit: str, hashes: dict[str, str]) -> bool:
    try:
        entry = pickle.loads(_entry(cache, unit).read_bytes())
    except (OSError, EOFError, pickle.UnpicklingError):
        return False
    if entry["reader"] != _reader_hash(is_board(unit)):
        return False
    for file, digest in entry["files"].items():
        key = file if file in own_files(unit) else f"code of {file}"
        if key not in hashes:
            hashes[key] = _hash(root, unit, file)
        if hashes[key] != digest:
            return False
    return True


def _hash(root: Path, unit: str, file: str) -> str:
    """Returns the hash of a file of a translation unit. For an included file, only its code
    matters."""
    return (file_hash if file in own_files(unit) else code_hash)(root / file)


def own_files(unit: str) -> tuple[str, str]:
    """Returns the own files of a translation unit: the source file and the header of the same
    name."""
    return unit, unit.removesuffix(".cpp") + ".hpp"


def code_hash(path: Path) -> str:
    """Returns the SHA-256 of the code of a file. Returns the empty string if the file does not
    exist."""
    try:
        return hashlib.sha256(code_of(path.read_text(encoding="utf-8")).encode()).hexdigest()
    except OSError:
        return ""


@functools.cache
def _reader_hash(board: bool) -> str:
    here = Path(__file__).parent
    own = b"".join((here / f"{name}.py").read_bytes() for name in READERS)
    # Most facts contain a Place. The class Place is in no module of READERS. Therefore the hash
    # must contain the fields of Place.
    shape = repr(signature(Place))
    return hashlib.sha256(own + f"{Place} {shape} {clang_arguments(board)}".encode()).hexdigest()


def _parse_and_store(root: Path, cache: Path, files: list[str], unit: str) -> None:
    facts, included = parse(root, unit, files, standard(cache, is_board(unit)))
    entry = {
        "reader": "the unit has errors" if facts.errors else _reader_hash(is_board(unit)),
        "files": {file: _hash(root, unit, file) for file in sorted(included)},
        # The facts are pickled separately, because only the same version of the reader can unpickle
        # them.
        "facts": pickle.dumps(facts),
    }
    write_whole(_entry(cache, unit), pickle.dumps(entry))


def parse(root: Path, unit: str, files: list[str], header: Path) -> tuple[Syntax, set[str]]:
    """Parses a translation unit. Returns the facts about its files, and all project files that the
    unit includes."""
    arguments = [*clang_arguments(is_board(unit)), *include_options(root)]
    if header.exists():
        arguments += ["-include-pch", str(header)]
    tree = cindex.Index.create().parse(str(root / unit), args=arguments)
    reader = Reader(root, set(files))
    reader.walk(tree.cursor, None, "")
    included = {unit}
    for entry in tree.get_includes():
        target = reader.relative(entry.include.name)
        if target is not None:
            included.add(target)
    for name in files:
        reader.facts.includes += includes_of(root, name)
    for problem in tree.diagnostics:
        # If libclang uses precompiled headers, it reports errors that have no file. These errors
        # are ignored, because they are no errors of the code.
        if problem.severity >= cindex.Diagnostic.Error and problem.location.file:
            file = reader.relative(problem.location.file.name)
            place = Place(file or unit, problem.location.line if file else 1)
            reader.facts.errors.append((place, problem.spelling))
    return reader.facts, included


# Matches an include in all forms that the preprocessor permits. For example, a comment may come
# first, and %: may replace #.
INCLUDE = re.compile(
    r'\s*(?:(?:/\*)?.*?\*/\s*)?(?:#|%:|\?\?=)\s*include\s*(?:/\*.*?\*/\s*)?[<"]([^>"]+)[>"]'
)


def includes_of(root: Path, file: str) -> list[IncludeFact]:
    """Returns the project files that a file includes. The source text is searched for the includes.

    The list of the compiler is not used, because it is not complete: if a translation unit has
    already included a header, the list contains no further include of this header."""
    includes: list[IncludeFact] = []
    lines = (root / file).read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        written = INCLUDE.match(line)
        if written is None:
            continue
        for folder in ((root / file).parent, *(root / name for name in DESIGN), root):
            target = (folder / written[1]).resolve()
            if target.is_file() and target.is_relative_to(root):
                name = str(target.relative_to(root))
                includes.append(IncludeFact(name, Place(file, number)))
                break
    return includes
