"""module-file and module-preprocessor: every file belongs to a part of the design, and uses the
preprocessor only to include files. doc-lock: the lists of packages are complete."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from packaging.requirements import Requirement

from traceability.model.design_model import Model
from traceability.reading.ast_facts import ClassFact
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below
from traceability.schema import Finding, Place
from traceability.sources import DESIGN, files_below, text_of

# Files that are not C++: descriptions of folders, linker scripts, and settings of the K64 build.
# They need no module.
OTHERS = ("module.dox", "CMakeLists.txt")
OTHER_ENDINGS = (".ld", ".cmake")
NAMED = re.compile(r'\s*(<|"[^"]+\.hpp")')  # a header
LOCKED = re.compile(r"^([\w.-]+)==(\S+)", re.MULTILINE)
# A package of CMake, or a library, that a build demands.
DEMANDED = re.compile(r"^\s*find_(?:package\(|library\(\w+ )(\w+)")
SYSTEM_PACKAGES = "setup/debian.txt"
DIRECTIVE = re.compile(r"\s*(?:(?:/\*)?.*?\*/\s*)?(?:#|%:|\?\?=)\s*(\w*)(.*)")


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _files(model, facts)
    yield from _outside(facts)
    yield from _loose(facts)
    yield from _preprocessor(facts.root)
    yield from _idle(facts)
    yield from _locks(facts.root)
    yield from _system_packages(facts.root)


def _finding(place: Place, text: str) -> Finding:
    return Finding(place, "module-file", text)


def _files(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds files that belong to nothing in the design: to no module, no data type and no
    composition. Files that design/modules.toml lists as shared are permitted."""
    described = {fact.place.file for fact in facts.syntax.classes if _is_described(fact, facts)}
    described |= {shared.file for shared in facts.declared.shared}
    for path in files_below(facts.root, DESIGN):
        file = str(path.relative_to(facts.root))
        header = str(Path(file).with_suffix(".hpp"))
        folder = str(Path(file).parent)
        if path.name in OTHERS or path.suffix in OTHER_ENDINGS:
            continue
        if file in described or header in described or _composes(model, folder):
            continue
        if path.suffix in (".cpp", ".hpp"):
            yield _finding(Place(file, 1), f"{file} belongs to no module")
        else:
            yield _finding(Place(file, 1), f"{file} is not checked: rename it to .hpp or .cpp")


def _is_described(fact: ClassFact, facts: Facts) -> bool:
    """Returns whether a class is a module, or a data type that has the tag @datatype."""
    name = fact.qualified.rsplit("::", maxsplit=1)[-1]
    return bool(facts.comment(fact).of("datatype")) or name in facts.with_file


def _composes(model: Model, folder: str) -> bool:
    """Returns whether a folder is the composition of a product. Such a folder has a @function in
    its module.dox, but contains no module."""
    logic = model.logic_modules.get(folder.removeprefix("src/"))
    return logic is not None and bool(logic.function) and not logic.modules


def _outside(facts: Facts) -> Iterator[Finding]:
    """Finds functions and classes in the file of a module, but outside the class of the module, if
    other files can use them."""
    shared = {Path(item.file).stem for item in facts.declared.shared}
    for body in facts.syntax.bodies:
        stem = Path(body.place.file).stem
        module = facts.written_in.get(body.place.file)
        if body.owner or body.local or module not in facts.modules or stem in shared:
            continue
        if not body.id.startswith("operator"):
            text = (
                f"the function {body.id} is in a file of {module} but not in the class, and other "
                "files can call it"
            )
            yield _finding(body.place, text)
    for fact in facts.syntax.classes:
        outer = fact.kind in ("class", "struct") and not fact.local and "::" not in fact.name
        if outer and fact.place.file.endswith(".cpp"):
            yield _finding(fact.place, f"the class {fact.name} has no header")


def _loose(facts: Facts) -> Iterator[Finding]:
    """In the file of a module, finds variables that are not members of a class and exist as long as
    the program runs. All objects of the module would share such a variable."""
    for variable in facts.syntax.objects:
        module = facts.written_in.get(variable.place.file)
        if module in facts.modules:
            said = f"the variable {variable.name} is not a member"
            text = f"{said}, so all objects of {module} share it"
            fix = "make it a member, or a constant"
            yield Finding(variable.place, "module-file", text, fix)


def _idle(facts: Facts) -> Iterator[Finding]:
    for shared in facts.declared.shared:
        if not (facts.root / shared.file).is_file():
            text = f"there is no {shared.file}"
            yield Finding(shared.place, "module-file", text, "remove the entry")


def _preprocessor(root: Path) -> Iterator[Finding]:
    """Finds macros and #if conditions. They are forbidden: with them, the compiler could read
    different code for different products."""
    for place, line in lines_below(root, DESIGN, (".cpp", ".hpp")):
        match = DIRECTIVE.match(line)
        if match is None or (match[1] == "include" and NAMED.match(match[2])):
            continue
        if (match[1], match[2].strip()) == ("pragma", "once"):
            continue
        text = f"#{match[1]} is neither an include of a named file nor #pragma once"
        yield Finding(place, "module-preprocessor", text)


def _locks(root: Path) -> Iterator[Finding]:
    """Compares each file setup/*.in with its lock file. Finds demanded packages that the lock file
    does not contain in a permitted version."""
    for file in sorted((root / "setup").glob("*.in")):
        locked: dict[str, str] = dict(LOCKED.findall(text_of(file.with_suffix(".lock"))))
        for place, line in lines_below(root, [str(file.relative_to(root))], ()):
            if demand := line.partition("#")[0].strip():
                package = Requirement(demand)
                version = locked.get(package.name.lower(), "no version")
                if version not in locked.values() or not package.specifier.contains(version):
                    text = f"the lock file has {version} of {package.name}"
                    yield Finding(place, "doc-lock", text)


def _system_packages(root: Path) -> Iterator[Finding]:
    """Finds packages that CMake demands and that the list of system packages does not contain."""
    listed = [line.split()[0] for line in text_of(root / SYSTEM_PACKAGES).splitlines() if line]
    for place, line in lines_below(root, ("CMakeLists.txt", "sim", "tests"), (".txt",)):
        demanded = DEMANDED.match(line)
        if demanded and not any(demanded[1].lower() in package for package in listed):
            text = f"{SYSTEM_PACKAGES} has no package for {demanded[1]}"
            yield Finding(place, "doc-lock", text, "add the package to this list")
