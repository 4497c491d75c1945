"""Reads what the annotated sources say, from Doxygen's XML.

Doxygen gives the texts. What the code is (bases, methods, calls) is read from the syntax tree.
"""

from __future__ import annotations

import html
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

from traceability.model.schema import Param, Place
from traceability.sources import DESIGN, files_below, hash_of

INPUTS = (*DESIGN, "tests", "requirements")
DOXYFILE = Path("traceability/doxygen/Doxyfile")

SCOPES = ("class", "struct", "union", "namespace", "file")
# Doxygen 1.18 reports the list of requirements that it makes itself as badly nested.
FALSE_WARNING = re.compile(
    r"found </div> at different nesting level|end of comment block while expecting command </div>"
)


@dataclass
class Complaint:
    place: Place
    text: str


@dataclass
class Text:
    """One documentation comment, taken apart."""

    brief: str = ""
    details: str = ""
    sections: list[tuple[str, str]] = field(default_factory=list)  # title of a paragraph, text
    params: dict[str, str] = field(default_factory=dict)
    returns: str = ""
    pre: list[str] = field(default_factory=list)
    post: list[str] = field(default_factory=list)
    roles: list[tuple[str, str]] = field(default_factory=list)
    datatype: bool = False

    def all(self, title: str) -> list[str]:
        return [text for name, text in self.sections if name == title]

    def one(self, title: str) -> str:
        return next(iter(self.all(title)), "")


@dataclass
class MemberText:
    name: str
    place: Place
    text: Text
    params: list[Param]
    satisfies: list[str]
    verifies: list[str]


@dataclass
class PartText:
    """A member of a class, or a value of an enumeration."""

    name: str
    type: str
    text: str


@dataclass
class ClassText:
    qualified: str
    place: Place
    text: Text
    members: list[MemberText] = field(default_factory=list)
    parts: list[PartText] = field(default_factory=list)


@dataclass
class FolderText:
    path: str
    place: Place
    text: Text


@dataclass
class RequirementText:
    id: str
    title: str
    place: Place
    text: Text


@dataclass
class Silent:
    """Something of a header that others can use, and no comment says what it is."""

    name: str
    kind: str  # as Doxygen calls it: function, friend, variable, typedef, enum, enumvalue, tparam
    place: Place


@dataclass
class Annotations:
    classes: dict[str, ClassText] = field(default_factory=dict)
    folders: dict[str, FolderText] = field(default_factory=dict)
    requirements: dict[str, RequirementText] = field(default_factory=dict)
    tests: list[MemberText] = field(default_factory=list)
    pages: dict[str, str] = field(default_factory=dict)  # file -> title of the page in it
    warnings: list[Complaint] = field(default_factory=list)
    silent: list[Silent] = field(default_factory=list)


def doxygen_executable() -> str:
    """Doxygen beside the running Python, else the one on the path."""
    beside = Path(sys.executable).parent / "doxygen"
    return str(beside) if beside.exists() else (shutil.which("doxygen") or "doxygen")


@dataclass
class DoxygenRun:
    """Doxygen at work beside what else reads the sources; no process where nothing changed."""

    xml: Path
    warnings: Path  # what it was made from, and what Doxygen said
    state: str
    process: subprocess.Popen[bytes] | None = None

    def finish(self) -> None:
        """Waits for it, and keeps what it said beside the XML."""
        if self.process is None:
            return
        said = self.process.communicate()[1].decode()
        if self.process.returncode != 0 or not self.xml.is_dir():
            code = self.process.returncode
            raise RuntimeError(f"Doxygen failed with exit code {code}:\n{said[-2000:]}")
        record = {"state": self.state, "output": said.splitlines()}
        self.warnings.write_text(json.dumps(record), encoding="utf-8")

    def stop(self) -> None:
        """Ends it when nobody waits for it any more."""
        if self.process is not None and self.process.poll() is None:
            self.process.kill()
            self.process.wait()


@contextmanager
def doxygen_beside(root: Path, build: Path) -> Iterator[DoxygenRun]:
    """Doxygen runs while the caller does something else, and is stopped where that fails."""
    run = start_doxygen(root, build)
    try:
        yield run
    finally:
        run.stop()


def start_doxygen(root: Path, build: Path) -> DoxygenRun:
    """Has the XML written when an input changed."""
    xml, warnings = build / "xml", build / "doxygen.json"
    doxyfile = root / DOXYFILE
    if not doxyfile.exists():
        doxyfile = Path(__file__).parents[2] / DOXYFILE
    settings = doxyfile.read_text(encoding="utf-8")
    inputs = [
        path
        for path in files_below(root, INPUTS, (".hpp", ".cpp", ".dox"))
        if root / "tests" / "python" not in path.parents
    ]
    run = DoxygenRun(xml, warnings, hash_of(root, inputs) + settings)
    known = json.loads(warnings.read_text(encoding="utf-8")) if warnings.exists() else {}
    if xml.is_dir() and known.get("state") == run.state:
        return run
    shutil.rmtree(xml, ignore_errors=True)
    build.mkdir(parents=True, exist_ok=True)
    folders = " ".join(name for name in INPUTS if (root / name).exists())
    whole = build / "Doxyfile"
    whole.write_text(
        f'{settings}\nINPUT = {folders}\nEXCLUDE = tests/python\nOUTPUT_DIRECTORY = "{build}"\n',
        encoding="utf-8",
    )
    run.process = subprocess.Popen(
        [doxygen_executable(), str(whole)],
        cwd=root,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        env={**os.environ, "LC_ALL": "C.UTF-8"},
    )
    return run


def read_annotations(root: Path, doxygen: DoxygenRun) -> Annotations:
    """What Doxygen wrote, after it has ended."""
    doxygen.finish()
    result = Annotations()
    for path in sorted(doxygen.xml.glob("*.xml")):
        if path.name in ("index.xml", "Doxyfile.xml", "requirements.xml"):
            continue
        for compound in ElementTree.parse(path).getroot().iter("compounddef"):
            _read_compound(compound, result)
    for requirement in result.requirements.values():
        requirement.title = _sentence(root, requirement)
    record = json.loads(doxygen.warnings.read_text(encoding="utf-8"))
    result.warnings = _warnings(root, record["output"])
    return result


def _read_compound(compound: ElementTree.Element, result: Annotations) -> None:
    kind = compound.get("kind")
    name = compound.findtext("compoundname", "")
    place = _place(compound)
    if kind in SCOPES and compound.get("prot", "public") == "public":
        result.silent += _silent(compound, name)
    if kind in ("class", "struct", "union"):
        members = [_member(item) for item in compound.iter("memberdef") if _is_function(item)]
        result.classes[name] = ClassText(name, place, _text(compound), members, _parts(compound))
        result.silent += _silent_parameters(compound, name)
    elif kind == "dir":
        text = _text(compound)
        dox = Place(name.rstrip("/") + "/module.dox", 1)
        result.folders[name] = FolderText(name, dox, text)
    elif kind == "requirement":
        title = html.escape(_plain(compound.find("title")), quote=False)
        result.requirements[name] = RequirementText(name, title, place, _text(compound))
    elif kind == "page":
        result.pages[place.file] = compound.findtext("title", "")
    elif kind in ("file", "namespace"):
        for item in compound.iter("memberdef"):
            kind_of = item.get("kind")
            if _place(item).file.startswith("tests/") and kind_of == "function":
                result.tests.append(_member(item))
            elif kind == "namespace" and kind_of in ("enum", "typedef"):
                qualified = f"{name}::{item.findtext('name', '')}"
                result.classes[qualified] = ClassText(
                    qualified, _place(item), _text(item), parts=_parts(item)
                )


def _silent(scope: ElementTree.Element, name: str) -> Iterator[Silent]:
    """What a header lets others use without a word on it."""
    for item in scope.iter("memberdef"):
        place = _place(item)
        if not place.file.endswith(".hpp") or not place.file.startswith(DESIGN):
            continue
        if item.get("prot") != "public" or _needs_none(item):
            continue
        own = f"{name}::{item.findtext('name', '')}".removeprefix("wr::")
        if not _is_described(item):
            yield Silent(own, item.get("kind", ""), place)
        values = item.findall("enumvalue")
        if any(_is_described(value) for value in values):  # or their names say enough
            for value in values:
                if not _is_described(value):
                    yield Silent(f"{own}::{value.findtext('name', '')}", "enumvalue", place)


def _needs_none(item: ElementTree.Element) -> bool:
    """Whether nothing is to be said: a destructor, what is deleted, inherited or a friend class."""
    deleted = item.findtext("argsstring", "").endswith(("=delete", "= delete"))
    inherited = item.find("reimplements") is not None
    named = item.get("kind") == "friend" and not item.findtext("argsstring", "")
    destructor = item.findtext("name", "").startswith("~")
    return deleted or inherited or named or destructor


def _is_described(item: ElementTree.Element) -> bool:
    texts = (item.find("briefdescription"), item.find("detaileddescription"))
    return any("".join(text.itertext()).strip() for text in texts if text is not None)


def _silent_parameters(scope: ElementTree.Element, name: str) -> Iterator[Silent]:
    """The parameters of a template that are left out where others are described."""
    described = {
        _plain(one)
        for group in scope.findall("detaileddescription//parameterlist")
        if group.get("kind") == "templateparam"
        for one in group.iter("parametername")
    }
    for param in scope.findall("templateparamlist/param"):
        own = param.findtext("declname", "") or _plain(param.find("type")).split(" ")[-1]
        if described and own not in described:
            yield Silent(f"{name}, {own}".removeprefix("wr::"), "tparam", _place(scope))


def _parts(element: ElementTree.Element) -> list[PartText]:
    """The public members of a class, or the values of an enumeration."""
    members = [
        PartText(
            item.findtext("name", ""),
            _plain(item.find("type")),
            _flow(item.find("briefdescription")),
        )
        for item in element.iter("memberdef")
        if item.get("kind") == "variable" and item.get("prot") == "public"
    ]
    values = [
        PartText(item.findtext("name", ""), "", _flow(item.find("briefdescription")))
        for item in element.iter("enumvalue")
    ]
    return members + values


def _sentence(root: Path, requirement: RequirementText) -> str:
    """The whole sentence of a requirement: Doxygen's title of it ends after some 60 characters."""
    source = (root / requirement.place.file).read_text(encoding="utf-8")
    found = re.search(rf"[@\\]requirement\s+{re.escape(requirement.id)}\s+(.*)", source)
    return html.escape(found[1].strip(), quote=False) if found else requirement.title


def _is_function(item: ElementTree.Element) -> bool:
    return item.get("kind") == "function"


def _member(item: ElementTree.Element) -> MemberText:
    params = [
        Param(
            name=param.findtext("declname", ""),
            type=_plain(param.find("type")),
            text="",
        )
        for param in item.findall("param")
    ]
    return MemberText(
        name=item.findtext("name", ""),
        place=_place(item),
        text=_text(item),
        params=params,
        satisfies=_requirements(item, "satisfies"),
        verifies=_requirements(item, "verifies"),
    )


def _requirements(item: ElementTree.Element, tag: str) -> list[str]:
    ids = [
        entry.get("refid", "").removeprefix("requirement_")
        for entry in item.findall(f"{tag}/requirement")
    ]
    return list(dict.fromkeys(ids))


def _place(element: ElementTree.Element) -> Place:
    location = element.find("location")
    if location is None:
        return Place("", 1)
    return Place(location.get("file", ""), int(location.get("line", "1")))


def _text(element: ElementTree.Element) -> Text:
    # Doxygen puts a full stop after a mark that ends a brief text.
    text = Text(brief=_flow(element.find("briefdescription")).removesuffix(" ."))
    for part in (element.find("briefdescription"), element.find("detaileddescription")):
        for role in part.iter("wr-role") if part is not None else ():
            binding = (role.get("application", "").strip(), role.get("role", "").strip())
            text.roles.append(binding)
        if part is not None and part.find(".//wr-datatype") is not None:
            text.datatype = True
    detailed = element.find("detaileddescription")
    if detailed is None:
        return text
    for section in detailed.iter("simplesect"):
        words = _flow(section)
        kind = section.get("kind")
        if kind == "par":
            title = section.findtext("title", "").strip().rstrip(":")
            text.sections.append((title, words))
        elif kind == "return":
            text.returns = words
        elif kind == "pre":
            text.pre.append(words)
        elif kind == "post":
            text.post.append(words)
    for group in detailed.iter("parameterlist"):
        for entry in group.findall("parameteritem"):
            words = _flow(entry.find("parameterdescription"))
            for name in entry.iter("parametername"):
                text.params[_plain(name)] = words
    text.details = _flow(detailed)
    return text


_APART = {"simplesect", "parameterlist", "title", "wr-role", "wr-datatype", "xrefsect"}


def _flow(element: ElementTree.Element | None) -> str:
    """The paragraphs as HTML: one paragraph as bare text, several each in ``<p>``."""
    if element is None:
        return ""
    paragraphs = [_clean(_inline(para)) for para in _paragraphs(element)]
    paragraphs = [words for words in paragraphs if words]
    if len(paragraphs) < 2:
        return "".join(paragraphs)
    return "".join(f"<p>{words}</p>" for words in paragraphs)


def _paragraphs(element: ElementTree.Element) -> list[ElementTree.Element]:
    found: list[ElementTree.Element] = []
    for child in element:
        if child.tag == "para":
            found.append(child)
            found += [
                para
                for group in child
                if group.tag == "itemizedlist"
                for para in group.iter("para")
            ]
    return found


def _inline(element: ElementTree.Element) -> str:
    words = html.escape(element.text or "", quote=False)
    for child in element:
        if child.tag == "computeroutput":
            words += f"<code>{html.escape(_plain(child), quote=False)}</code>"
        elif child.tag not in _APART and child.tag not in ("itemizedlist", "para"):
            words += _inline(child)
        words += html.escape(child.tail or "", quote=False)
    return words


def _plain(element: ElementTree.Element | None) -> str:
    return "" if element is None else _clean("".join(element.itertext()))


def _clean(words: str) -> str:
    return " ".join(words.replace("\\,", ",").split())


def _warnings(root: Path, lines: list[str]) -> list[Complaint]:
    found: list[Complaint] = []
    for line in lines:
        match = re.match(r"(.+?):(\d+): (?:warning|error): (.*)", line)
        if match is None:
            if found and line.startswith(" "):
                found[-1].text += " " + line.strip()
            continue
        if FALSE_WARNING.search(match[3]):
            continue
        file = match[1].removeprefix(f"{root}/")
        found.append(Complaint(Place(file, int(match[2])), match[3]))
    return found
