"""Names as HTML in the style of the paper: LOGIC in small capitals, *abstract*, **concrete**."""

from __future__ import annotations

import functools
import re
from collections import Counter
from collections.abc import Callable, Iterable
from functools import partial
from html import unescape

from markupsafe import Markup, escape

from portal.links import ID_OR_CODE, Links
from traceability.model.design_model import Model
from traceability.model.report import words_of
from traceability.schema import Method, Module, Place, Test

VIEWS = [
    ("F", "diagram", "Diagram"),
    ("I", "interface", "Interface"),
    ("G", "guide", "Guide"),
    ("P", "patterns", "Patterns"),
    ("R", "requirements", "Requirements"),
    ("S", "source", "Source"),
    ("T", "tests", "Tests"),
]
KINDS = {
    "verified": "ok",
    "partly": "warn",
    "suspect": "warn",
    "failed": "bad",
    "stale": "warn",
    "unverified": "none",
}
VERDICTS = {state: (kind, words_of(state)) for state, kind in KINDS.items()}
RESULTS = {
    "passed": ("ok", "passed"),
    "failed": ("bad", "failed"),
    "skipped": ("warn", "skipped"),
    None: ("none", "not run"),
}
CODE = re.compile(r"<code>[^<]*</code>")
OPTION = re.compile(r"(?<![^\s>])-{1,2}[a-z][a-z-]*")

# Methods whose results are cached: the link of a name is computed only once.
KEPT = ("mod", "meth", "logic", "req", "safety", "pat", "change", "test", "check", "keys")


def anchor(address: str | None, text: Markup | str, kind: str = "", **data: str) -> Markup:
    """Returns a link, or plain text in the same style if ``address`` is ``None``."""
    classes = f' class="{escape(kind)}"' if kind else ""
    if address is None:
        return Markup(f"<span{classes}>{escape(text)}</span>")
    extra = "".join(f' data-{key}="{escape(value)}"' for key, value in data.items())
    return Markup(f'<a{classes}{extra} href="{escape(address)}">{escape(text)}</a>')


def breakable(name: str) -> Markup:
    """Returns a name as HTML. A ``<wbr>`` tag marks each position at which the browser may break
    the name."""
    joints = re.sub(r"(::|[._/]|(?<=[a-z0-9])(?=[A-Z]))", "\\1\0", name)
    return Markup("<wbr>").join(escape(part) for part in joints.split("\0"))


def views_of(module: Module, called: set[str]) -> set[str]:
    """Returns the letters of the non-empty views of a module."""
    letters = {"I", "G", "S"}
    if module.name in called or any(m.calls for m in module.methods):
        letters.add("F")
    if module.roles:
        letters.add("P")
    if module.requirements:
        letters.add("R")
    if module.tests:
        letters.add("T")
    return letters


class Names:
    """Converts names of elements to links. The templates call its methods."""

    def __init__(self, model: Model, links: Links) -> None:
        self.model = model
        self.links = links
        self.req = partial(self._id, links.requirement)
        self.safety = partial(self._id, links.safety)
        self.pat = partial(self._id, links.pattern)
        self.change = partial(self._id, links.change)
        self.logic_names = Counter(module.name for module in model.logic_modules.values())
        self.called = {
            target.partition("::")[0]
            for method in model.methods
            for call in method.calls
            for target in [call.target, *call.targets]
        }
        for kind in KEPT:
            setattr(self, kind, functools.cache(getattr(self, kind)))

    def _id(self, address: Callable[[str], str | None], identifier: str) -> Markup:
        return anchor(address(identifier), identifier, "id")

    def mod(self, name: str) -> Markup:
        module = self.model.modules.get(name)
        if module is None:  # the name of a member, such as Wheel::brake, links to its module
            return anchor(self.links.module(name.partition("::")[0]), name, "mod none")
        kind = "mod d" if module.datatype else f"mod {'a' if module.abstract else 'c'}"
        return anchor(self.links.module(name), name, kind, m=name)

    def meth(self, identifier: str) -> Markup:
        name, _, method = identifier.partition("::")
        if not method:
            return self.function(name)
        link = anchor(self.links.method(identifier), breakable(method), "meth")
        return Markup('<span class="mm">{}<span class="dc">::</span><wbr>{}</span>').format(
            self.mod(name), link
        )

    def event(self, event: str, operation: str) -> Markup:
        """Returns the name of an event. It is a link to the operation that the event calls."""
        return anchor(self.links.method(operation), event)

    def types(self, code: str, own: str = "") -> Markup:
        """Returns a type or a signature as HTML. The names of modules and value types are links."""
        modules = self.model.modules
        parts = re.split(r"(\w+)", code.replace("< ", "<").replace(" >", ">"))
        return Markup("").join(
            anchor(self.links.module(part), part, "type")
            if part in modules and part != own
            else part
            for part in parts
        )

    def signature(self, method: Method) -> Markup:
        """Returns a signature for readers: the name of the method, then the parameters, and the
        result at the end."""
        before, name, after = method.signature.partition(f"{method.name}(")
        if not name:
            return self.types(method.signature, method.module)
        words = re.sub(r"\b(virtual|explicit)\b", "", before).split()
        static = "static" in words
        result = " ".join(word for word in words if word != "static")
        parameters = re.sub(r"( override| final| = 0)+$", "", f"({after}")
        return Markup("{}<b>{}</b>{}{}").format(
            "static " if static else "",
            method.name,
            self.types(parameters, method.module),
            Markup(" → {}").format(self.types(result, method.module))
            if result not in ("", "void")
            else "",
        )

    def function(self, name: str) -> Markup:
        """Returns the name of a function outside classes. A function of the project is linked to
        its source; a function of a library has no link."""
        function = self.model.functions.get(name)
        return anchor(
            self.links.source(function.place) if function else None, breakable(name), "meth"
        )

    def logic(self, identifier: str) -> Markup:
        """Returns the link to a logic module. If another logic module has the same name, the link
        also shows the name of the parent."""
        module = self.model.logic_modules.get(identifier)
        text = Markup(module.name if module else identifier)
        parent = self.model.logic_modules.get(module.parent or "") if module else None
        if module and parent and self.logic_names[module.name] > 1:
            text = Markup("{}<wbr>/{}").format(parent.name, module.name)
        return anchor(self.links.logic(identifier), text, "logic")

    def test(self, identifier: str) -> Markup:
        text = Markup("<code>{}</code>").format(breakable(identifier))
        return anchor(self.links.test(identifier), text)

    def check(self, identifier: str) -> Markup:
        text = Markup("<code>{}</code>").format(identifier)
        return anchor(self.links.check(identifier), text, "id")

    def src(self, place: Place, full: bool = False, label: str = "") -> Markup:
        file = place.file if full else file_name(place.file)
        where = label or (f"{file}:{place.line}" if place.line else file)
        return anchor(
            self.links.source(place), Markup("<code>{}</code>").format(breakable(where)), "src"
        )

    def keys(self, name: str) -> Markup:
        """Returns the seven view keys of a module. The key of an empty view is blank."""
        module = self.model.modules.get(name)
        if module is None or module.datatype:
            return Markup("")
        present = views_of(module, self.called)
        parts = [self._key(name, view, view[0] in present) for view in VIEWS]
        gap = Markup('<span class="gap"></span>')
        inner = Markup("").join([*parts[:3], gap, *parts[3:5], gap, *parts[5:]])
        return Markup(
            '<span class="vk" role="group" aria-label="Views of {}" data-vk="{}">{}</span>'
        ).format(name, name, inner)

    def _key(self, name: str, view: tuple[str, str, str], present: bool) -> Markup:
        letter, section, word = view
        if not present:
            return Markup('<span class="off"></span>')
        return Markup('<a href="@/modules/{}.html#{}" aria-label="{}, {} of {}">{}</a>').format(
            name, section, letter, word.lower(), name, letter
        )

    def verdict(self, state: str) -> Markup:
        return glyph(*VERDICTS[state])

    def result(self, test: Test, binding: str) -> Markup:
        """Returns the result of a test on a target. Returns a dash if the test is not built for
        this target."""
        result = test.results.get(binding)
        if result is None:
            return Markup('<span class="mut" title="not built for this target">\N{EN DASH}</span>')
        if result.stale and result.result:
            return glyph("warn", str(result.words))
        return glyph(*RESULTS.get(result.result, ("none", str(result.result))))

    def results(self, test: Test) -> Markup:
        """Returns the result of a test on each target for which the test is built."""
        parts = [
            Markup("{} {}").format(binding, self.result(test, binding)) for binding in test.results
        ]
        return Markup(", ").join(parts)

    def text(self, words: str) -> Markup:
        """Returns a text of the model as HTML. The names and identifiers in the text are links."""

        def name(match: re.Match[str]) -> str:
            code, whole = match.group(1), match.group(0)
            word = unescape(code) if code is not None else whole
            method = word.strip("()")
            if word in self.model.requirements:
                return self.req(word)
            if word in self.model.modules:
                return self.mod(word)
            if word in self.links.checks:
                return self.check(word)
            if code is not None and word in self.model.tests:
                return self.test(word)
            if code is not None and "::" in word and self.links.find_method(method):
                return self.meth(method)
            return self.safety(word) if self.links.safety(word) else whole

        return Markup(ID_OR_CODE.sub(name, marked(words)))


def marked(words: str) -> str:
    """Converts the markup of a text to HTML. The markup has only `names` in backticks, paragraphs
    and lists."""
    text = re.sub(r"`([^`]*)`", r"<code>\1</code>", str(escape(words)))
    paragraphs = [_paragraph(part) for part in text.split("\n\n") if part]
    if len(paragraphs) < 2:
        return "".join(paragraphs)
    return "".join(f"<p>{paragraph}</p>" for paragraph in paragraphs)


def _paragraph(text: str) -> str:
    first, *items = re.split(r"(?:^|\n)- ", text)
    return first + ("<ul><li>" + "</li><li>".join(items) + "</li></ul>" if items else "")


def unbroken_options(html: str) -> str:
    """Marks the options of commands in code. The style sheet then prevents a line break after a
    hyphen of an option. On hand-written pages, Sphinx has marked each word of code with ``pre``."""

    def mark(code: re.Match[str]) -> str:
        return OPTION.sub(r'<span class="option">\g<0></span>', code[0])

    return CODE.sub(mark, html.replace('<span class="pre">-', '<span class="pre option">-'))


def gist(brief: str) -> str:
    """Returns the text after the first colon of a brief, because the text before it is only a name.
    Returns "" if the brief has no colon."""
    return brief.partition(": ")[2]


def changed_words(text: str) -> Markup:
    """Returns a text as HTML. Words in ``[-...-]`` are marked as removed, and words in ``{+...+}``
    are marked as added."""
    marked = re.sub(r"\[-(.+?)-\]", r"<del>\1</del>", str(escape(text)))
    return Markup(re.sub(r"\{\+(.+?)\+\}", r"<ins>\1</ins>", marked))


def file_name(path: str) -> str:
    return path.rpartition("/")[2]


def counted_states(states: Iterable[str]) -> dict[str, str]:
    """Returns a text for each state of a requirement: the name of the state, and the number of
    requirements that have this state. The number can be 0."""
    counts = Counter(states)
    return {state: f"{word}: {counts[state]}" for state, (_, word) in VERDICTS.items()}


@functools.cache
def glyph(kind: str, word: str) -> Markup:
    """Returns a verdict as a coloured word. The style sheet puts a mark before the word, because
    some readers cannot distinguish the colours."""
    return Markup('<span class="v {}">{}</span>').format(kind, word)
