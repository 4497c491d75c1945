"""link-site: the built site has no dead link. link-doc: the products, programs and pins in
hand-written pages exist."""

from __future__ import annotations

import functools
import html
import json
import pickle
import posixpath
import re
from collections.abc import Iterator
from contextlib import nullcontext, suppress
from dataclasses import dataclass
from itertools import chain
from multiprocessing import get_context
from pathlib import Path
from urllib.parse import unquote

from traceability.model.design_model import Model
from traceability.reading.change_kits import PATCH
from traceability.reading.products import LIST, listed
from traceability.reading.source_lines import lines_below, texts_below
from traceability.schema import Finding, Place
from traceability.sources import file_hash, text_of
from traceability.whole_file import write_whole

PAGES = ("README.md", "CONTRIBUTING.md", "changes", "design", "docs", "ports")
URL = re.compile(r"""\burl\(\s*["']?([^"')]+)["']?\s*\)""")  # matches a link in a style sheet
PRODUCT = re.compile(r"--product[ =]([a-z]\w*)")
# A program or a firmware image of the build, without the folder of the preset.
PROGRAM = re.compile(
    r"(?<![\w/])build/\w+/((?:\w+/)+\w+|[a-z]\w*(?=\.elf\b))(?![\w/]|\.(?!elf\b)\w)"
)
ADDED = re.compile(r"\badd_(executable|(?:\w+_)?image)\(\s*(?:\$\{)?(\w+)")
SET = re.compile(r"^set\((\w+) (\w+)\)", re.MULTILINE)
# A folder of the build. A file directly in the folder build is left out.
BUILT = re.compile(r"(?<![\w/.-])build/(\w+)\b(?![.]\w)")
PRESETS = "CMakePresets.json"
BUILDING = ("src", "extensions", "sim", "tests", "changes", "ports")
FUNCTIONS = "sim/emulator/PinFunctions.hpp"
FUNCTION = re.compile(r"\bk(\w+)Pins\{\{(.*?)\}\};", re.DOTALL)
PIN = re.compile(r"\bPT[A-E]\d+\b(?!=)")
KEY = re.compile(r"\bkey ``(\w)``")
PROGRAMS = ("tools", "client", "setup")
QUESTIONS = "design/questions.toml"
CLICK = re.compile(r'"([^"]+)"')
CACHE = "pages-cache/links"  # path of the cache, in the folder that contains the site
# If at most this number of pages changed, one process reads them. Several processes would not be
# faster.
FEW = 100
ATTRIBUTE = re.compile(r"""\s(id|name|href|src|xlink:href|data|poster)=("[^"]*"|'[^']*')""")


@dataclass
class _Page:
    anchors: set[str]
    # Link -> its position in the text. Valid links to anchors of the same page are left out.
    links: dict[str, int]


def _text(file: str) -> str:
    return Path(file).read_text(encoding="utf-8", errors="replace")


def _read(file: str) -> _Page:
    text, page = _text(file), _Page({"", "top"}, {})
    if file.endswith(".css"):
        page.links |= {match[1]: match.start() for match in URL.finditer(text)}
        return page
    for attribute in ATTRIBUTE.finditer(text):
        start = text.rfind("<", 0, attribute.start())
        if start < text.rfind(">", 0, attribute.start()):
            continue  # The match is in the text between tags, and not in a tag. Ignore it.
        name, value = attribute[1], html.unescape(attribute[2][1:-1])
        if name == "id" or (name == "name" and text.startswith("<a ", start)):
            page.anchors.add(value)
        elif name != "name" and value:
            page.links.setdefault(value, start)
    own = [link for link in page.links if link.startswith(("#", "?"))]
    for link in own:
        if unquote(link.partition("#")[2]) in page.anchors:
            del page.links[link]
    return page


def _read_all(names: list[str], cache: Path) -> dict[str, _Page]:
    """Reads each file that is new or has changed since the last run. The contents of the other
    files are in the cache."""
    cached: dict[str, tuple[object, _Page]] = {}
    code = file_hash(Path(__file__))
    with suppress(OSError, EOFError, pickle.UnpicklingError), cache.open("rb") as stream:
        cached = pickle.load(stream) if pickle.load(stream) == code else {}
    stats = {name: Path(name).stat() for name in names}
    states = {name: (stat.st_mtime_ns, stat.st_size) for name, stat in stats.items()}
    changed = [name for name in names if name not in cached or cached[name][0] != states[name]]
    with get_context("fork").Pool() if len(changed) > FEW else nullcontext() as pool:
        read = pool.map(_read, changed) if pool else map(_read, changed)
        cached |= {name: (states[name], page) for name, page in zip(changed, read, strict=True)}
    cached = {name: cached[name] for name in names}
    write_whole(cache, pickle.dumps(code) + pickle.dumps(cached))
    return {name: page for name, (_, page) in cached.items()}


class _Site:
    """The built site: its files, and the links and anchors of its pages."""

    def __init__(self, root: Path) -> None:
        self.root = str(root.resolve())
        self.files = {str(path) for path in Path(self.root).rglob("*") if path.is_file()}
        names = [file for file in sorted(self.files) if file.endswith((".html", ".svg", ".css"))]
        self.pages = _read_all(names, root.parent / CACHE)
        self.away = functools.cache(self._away)

    def reason(self, file: str, folder: str, link: str) -> str:
        """Returns the reason why a link of a page is dead. Returns the empty string if the target
        of the link exists."""
        if link.startswith(("#", "?")):
            return self._without(file, link.partition("#")[2])
        return self.away(folder, link)

    def _away(self, folder: str, link: str) -> str:
        """Returns the reason why a link is dead, or the empty string. If two pages of a folder
        contain the same link, the result is the same. A cache avoids the second computation."""
        path, _, fragment = link.partition("#")
        path = path.partition("?")[0]
        if re.match(r"[a-z][a-z0-9+.-]*:|//", path, re.IGNORECASE):
            return ""
        start = self.root if path.startswith("/") else folder
        target = posixpath.normpath(f"{start}/{unquote(path)}")
        if not f"{target}/".startswith(f"{self.root}/"):
            return "the link points outside of the site"
        if target not in self.files:
            target = f"{target}/index.html"
        if target not in self.files:
            return "the file does not exist"
        return self._without(target, fragment)

    def _without(self, target: str, fragment: str) -> str:
        if target in self.pages and unquote(fragment) not in self.pages[target].anchors:
            return f"the page has no anchor '{unquote(fragment)}'"
        return ""


def dead_links(root: Path) -> list[tuple[Path, int, str, str]]:
    """For each dead link, returns its page, its line, its target, and the reason."""
    site = _Site(root)
    dead: list[tuple[Path, int, str, str]] = []
    for file, page in site.pages.items():
        folder = posixpath.dirname(file)
        for link, start in page.links.items():
            if reason := site.reason(file, folder, link):
                line = _text(file).count("\n", 0, start) + 1
                dead.append((Path(file), line, link, reason))
    return dead


def check(model: Model, site: Path) -> Iterator[Finding]:
    """Finds dead links. If a dead link of one source text is in several pages, there is only one
    finding."""
    places = _sources(model)
    root = site.resolve()
    project = root.parent.parent
    templates = list(lines_below(project, ("site",), (".html",)))
    pages: dict[tuple[str, int, str], list[tuple[str, str]]] = {}
    for path, line, link, reason in dead_links(site):
        page = str(path.relative_to(root))
        target = re.sub(r"^(\.\./)+", "", link)
        place = _written(project, templates, target, page) or _place(path, line, root, places)
        pages.setdefault((place.file, place.line, target), []).append((page, reason))
    for (file, line, target), links in pages.items():
        text = f"dead link '{target}' in {links[0][0]}{_others(links)}: {links[0][1]}"
        yield Finding(Place(file, line), "link-site", text)


def _others(links: list[tuple[str, str]]) -> str:
    count = len({page for page, _ in links}) - 1
    return f" and {count} more" if count else ""


def dead_clicks(site: Path) -> Iterator[Finding]:
    """Finds clicks in design/questions.toml that lead to no page of the site. The clicks are the
    links that lead a reader to the answer of a question."""
    lines = text_of(site.resolve().parent.parent / QUESTIONS).splitlines()
    for number, line in enumerate(lines, 1):
        for click in CLICK.findall(line) if line.startswith("clicks") else ():
            if not has_page(site, click):
                text = f"a question leads to {click}, but the site has no such page"
                fix = "name the page with the answer"
                yield Finding(Place(QUESTIONS, number), "link-site", text, fix)


def has_page(site: Path, name: str) -> bool:
    """Returns whether the site contains the named page. If the name has an anchor after a "#", the
    page must contain this anchor too."""
    page, _, anchor = name.partition("#")
    path = site / page
    if not path.is_file():
        return False
    return not anchor or f'id="{anchor}"' in path.read_text(encoding="utf-8")


def _written(
    root: Path, templates: list[tuple[Place, str]], target: str, page: str
) -> Place | None:
    """Returns the line of a file of docs/ or of a template that contains the complete text of a
    link. Returns None if the link is composed of several parts, because then no source text
    contains the whole link."""
    link = re.compile(rf"""["'<](?:@/|\{{\{{ root \}}\}}|(?:\.\./)*){re.escape(target)}["'>]""")
    own = Path("docs") / Path(page).with_suffix(".rst").name
    lines = chain(lines_below(root, (str(own),), ()), templates)
    return next((place for place, line in lines if link.search(line)), None)


def missing_parts(root: Path) -> Iterator[Finding]:
    """Searches the hand-written pages and the texts of design/ for wrong names: a product, a
    program, a folder of the build, a key or a pin with this name does not exist."""
    products = {product.name for product in listed(root)} if (root / LIST).exists() else set()
    pins = _pins(root)
    parts = (
        ("product '{}'", PRODUCT, products),
        ("program '{}'", PROGRAM, _targets(root)),
        ("build/{}", BUILT, _built(root)),
        ("key '{}'", KEY, _keys(root)),
        ("pin {} in use", PIN, pins),
    )
    for place, line in lines_below(root, PAGES, (".md", ".rst", ".toml")):
        for part, pattern, names in parts:
            for name in [name for name in pattern.findall(line) if name not in names]:
                if names is not pins or name not in _pins_of_port(root, place.file):
                    yield Finding(place, "link-doc", f"there is no {part.format(name)}")


def _pins(root: Path) -> set[str]:
    """Returns the pins of the table in src/k64/pins.hpp, and the unused pins that its comments
    name."""
    text = text_of(root / "src" / "k64" / "pins.hpp")
    return _rows(text).union(PIN.findall(text))


def _rows(text: str) -> set[str]:
    return {f"PT{port}{number}" for port, number in re.findall(r"Port::([A-E]), (\d+)", text)}


def _pins_of_port(root: Path, file: str) -> set[str]:
    """Returns the pins that the README of a port can name: the pins of its patch, and the
    pins that the microcontroller has for the peripherals in the README."""
    patch, functions = (root / file).with_name(PATCH), root / FUNCTIONS
    if not (file.startswith("ports/") and patch.exists() and functions.exists()):
        return set()
    pins = _rows(patch.read_text(encoding="utf-8"))
    readme = (root / file).read_text(encoding="utf-8")
    for name, rows in FUNCTION.findall(functions.read_text(encoding="utf-8")):
        if re.search(rf"\b{name.upper()}\d", readme):
            pins |= {f"PT{port}{number}" for port, number in re.findall(r"'(\w)', (\d+)", rows)}
    return pins


def _keys(root: Path) -> set[str]:
    """Returns the keys of the keyboard to which the client reacts."""
    code = (text for _, text in texts_below(root, ("client",), (".py",)))
    return set(re.findall(r'\bb"(\w)"', "".join(code)))


def _built(root: Path) -> set[str]:
    """Returns the folders of the build: those of the presets of CMake, and those that the tools
    name."""
    presets = root / PRESETS
    listed = json.loads(presets.read_text("utf-8"))["configurePresets"] if presets.exists() else []
    code = (text for _, text in texts_below(root, (*PROGRAMS, "traceability"), (".py",)))
    named = re.findall(r"\bbuild(?:/|\"(?:, | / )\")(\w+)", "".join(code))
    return {preset["name"] for preset in listed}.union(named)


def _targets(root: Path) -> set[str]:
    """Returns the programs and firmware images that CMake builds. The name of a program begins with
    its folder, relative to the folder of the preset. If the name of a CMake function ends with
    "image", the function adds an image without a folder."""
    found = set()
    for file, text in texts_below(root, BUILDING, (".txt",)):
        values = dict(SET.findall(text))
        for kind, name in ADDED.findall(text):
            target = values.get(name, name)
            found.add(str(Path(file).parent / target) if kind == "executable" else target)
    return found


def _sources(model: Model) -> dict[str, Place]:
    """Returns a map from each generated page to the place of the source of this page."""
    places = {f"modules/{module.name}.html": module.place for module in model.modules.values()}
    places |= {f"patterns/{item.id}.html": item.place for item in model.patterns.values()}
    places |= {f"requirements/{item.id}.html": item.place for item in model.requirements.values()}
    places |= {f"safety/{item.id}.html": item.place for item in model.safety.goals.values()}
    places |= {f"source/{file}.html": Place(file, 1) for file in model.files}
    return places


def _place(path: Path, line: int, site: Path, places: dict[str, Place]) -> Place:
    name = str(path.relative_to(site))
    if name in places:
        return places[name]
    page = site.parent.parent / "docs" / Path(name).with_suffix(".rst").name
    if page.is_file():
        return Place(f"docs/{page.name}", 1)
    style = site.parent.parent / "site" / "theme" / "static" / path.name
    if path.suffix == ".css" and style.is_file():
        return Place(f"site/theme/static/{path.name}", line)
    return Place(f"build/site/{name}", line)
