"""Class and state diagrams. Writes the PlantUML text from the model, and adapts the SVG to a page.

PlantUML does not support CSS variables. The PlantUML text therefore uses a marker colour for each
CSS variable of the theme. Afterwards this module replaces each marker colour in the SVG by its
variable. A single run of Java draws all diagrams whose text changed."""

from __future__ import annotations

import hashlib
import os
import re
import subprocess
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from portal.fonts import FAMILY, write_fonts
from portal.label_places import Box, best_move, box_of, move
from portal.links import Links
from traceability.grouping import grouped
from traceability.model.design_model import Model
from traceability.schema import Module, PatternApplication, StateMachine, Transition

DIAGRAMS = "diagrams"  # folder of the sources of the diagrams in the site
SVG = "{http://www.w3.org/2000/svg}"
XLINK = "{http://www.w3.org/1999/xlink}"
# Part of the cache key. Increase this number when you change the processing of the SVG.
FORMAT = "11"

FAMILIES = {
    "Decorator": "decorator",
    "Concrete Decorator": "decorator",
    "Context": "context",
    "Invoker": "context",
    "Client": "context",
    "Director": "context",
    "Receiver": "target",
    "Product": "target",
    "Singleton": "target",
}
STATE_HUES = {
    "Working": "working",
    "Connected": "working",
    "Waiting": "waiting",
    "WaitingN": "waiting",
    "Handshaking": "waiting",
    "Reconnecting": "reconnecting",
    "Disconnected": "reconnecting",
    "PC": "pc",
    "RC": "rc",
}
HUES = [
    *(f"role-{name}" for name in ("abstraction", "concrete", "context", "decorator", "target")),
    *(f"fsm-{name}" for name in ("working", "waiting", "reconnecting", "pc", "rc")),
]
VARIABLES = {
    "line": "--ink-2",
    "text": "--ink",
    "soft": "--ink-3",
    "plain": "--paper",
    "edge": "--rule",
    **{hue: f"--{hue}" for hue in HUES},
    **{f"{hue}-fill": f"--{hue}-fill" for hue in HUES},
}
MARKERS = {name: f"#FA{number:02X}5C" for number, name in enumerate(VARIABLES)}
COLOURS = {MARKERS[name]: variable for name, variable in VARIABLES.items()}
COLOURS["#FFFFFF"] = "--paper"  # colour inside diamonds

# Elements of the architecture, in the colours of the first page.
COLOUR_OF = {
    "controller": "role-concrete",
    "process": "role-abstraction",
    "sensor": "role-target",
}

UNSET = "#A80036"  # default colour of edges in PlantUML

LOCATED = re.compile(r'class="(edge|says)" data-for="([^"]*)"')

EDGE = 4  # space below the lowest label

# If each text line of the labels has at most this number of characters, the states are drawn from
# left to right.
SHORT_LABEL = 40
LONG_LABEL = 12  # if the event has more characters, the action is below it

# (role of the first class, role of the second class, kind of arrow). An arrow is drawn from the
# first class to the second class only if the first class uses the second class.
RELATIONS = [
    ("Context", "State", "o-->"),
    ("Context", "Strategy", "o-->"),
    ("Decorator", "Component", "o-->"),
    ("Invoker", "Command", "o-->"),
    ("Concrete Command", "Receiver", "..>"),
    ("Client", "Concrete Command", "..>"),
    ("Director", "Builder", "-->"),
    ("Director", "Concrete Builder", "-->"),
    ("Concrete Builder", "Product", "..>"),
    ("Concrete Element", "Reader", "..>"),
    ("Concrete Element", "Writer", "..>"),
]


def role_family(role: str) -> str:
    """Returns the family of a role. Each role of a pattern belongs to one of five families, and
    each family has a colour."""
    if role in FAMILIES:
        return FAMILIES[role]
    return "concrete" if role.startswith("Concrete") else "abstraction"


@dataclass
class Diagram:
    """A drawing in the language of PlantUML. ``label`` describes the drawing for a screen reader.
    If a drawing has a title, it is listed on the page "Exports". ``page`` is the address of the
    page that shows the drawing."""

    id: str
    label: str
    text: str
    title: str = ""
    page: str = ""
    edges: dict[tuple[str, str], list[Transition]] = field(default_factory=dict)


def preamble() -> list[str]:
    return [
        "@startuml",
        "set namespaceSeparator none",
        "hide circle",
        "hide empty members",
        "hide empty description",
        "skinparam backgroundColor transparent",
        "skinparam shadowing false",
        "skinparam roundCorner 4",
        "skinparam svgLinkTarget _self",
        f"skinparam defaultFontName {FAMILY}",
        "skinparam defaultFontSize 13",
        f"skinparam defaultFontColor {MARKERS['text']}",
        f"skinparam arrowColor {MARKERS['line']}",
        f"skinparam arrowFontColor {MARKERS['text']}",
        "skinparam arrowFontSize 12",
        f"skinparam classBorderColor {MARKERS['edge']}",
        f"skinparam classBackgroundColor {MARKERS['plain']}",
        f"skinparam classFontColor {MARKERS['text']}",
        "skinparam classFontStyle bold",
        "skinparam classAttributeFontSize 12",
        f"skinparam classAttributeFontColor {MARKERS['text']}",
        f"skinparam classStereotypeFontColor {MARKERS['soft']}",
        "skinparam classStereotypeFontSize 12",
        "skinparam classStereotypeFontStyle plain",
        "skinparam padding 3",
        f"skinparam stateFontColor {MARKERS['text']}",
        f"skinparam stateStartColor {MARKERS['line']}",
        "skinparam nodesep 34",
        "skinparam ranksep 44",
    ]


# ---- pattern applications ----------------------------------------------------


def between(links: Links, bound: set[str]) -> set[str]:
    """Returns the modules that have no role, but have both a base class and a subclass with a
    role."""
    above = {base for name in bound for base in links.ancestors(name)} - bound
    return {name for name in above if bound & set(links.ancestors(name))}


def shown_members(module: Module, role: str) -> list[str]:
    if role_family(role) == "context":
        return []
    kinds = ("pure", "virtual", "plain") if module.abstract else ("override",)
    names = [
        m
        for m in module.methods
        # A protected or private method is shown only if it is virtual. A subclass overrides such a
        # method to complete an algorithm.
        if (m.access == "public" or m.kind != "plain")
        and m.kind in kinds
        and not m.name.startswith(("operator", "~"))
    ]
    seen: dict[str, str] = {}
    for method in names:
        style = f"//{method.name}()//" if method.kind == "pure" else f"{method.name}()"
        seen.setdefault(method.name, style)
    members = list(seen.values())
    return members if len(members) <= 7 else [*members[:6], f"{{method}} {len(members) - 6} more"]


def class_lines(module: Module, roles: list[str], links: Links) -> list[str]:
    keyword = "abstract class" if module.abstract else "class"
    if roles:
        family = role_family(roles[0])
        fill, line = MARKERS[f"role-{family}-fill"], MARKERS[f"role-{family}"]
        style = f"<<{', '.join(roles)}>> [[{links.module(module.name)}]] {fill} ##{line[1:]}"
    else:
        style = (
            f"[[{links.module(module.name)}]] {MARKERS['plain']} ##[dashed]{MARKERS['edge'][1:]}"
        )
    members = shown_members(module, roles[0]) if roles else []
    return [f"{keyword} {module.name} {style} {{", *(f"  {m}" for m in members), "}"]


def pattern_diagram(model: Model, application: PatternApplication, links: Links) -> Diagram:
    roles: dict[str, list[str]] = {}
    for binding in application.roles:
        if binding.module in model.modules:
            roles.setdefault(binding.module, []).append(binding.role)
    extra = between(links, set(roles))
    shown = [*roles, *sorted(extra)]
    lines = preamble()
    for name in shown:
        lines += class_lines(model.modules[name], roles.get(name, []), links)
    for name in shown:
        lines += [f"{b} <|-- {name}" for b in model.modules[name].bases if b in shown]
    lines += relation_lines(model, application)
    lines.append("@enduml")
    words = "; ".join(f"{name} is {' and '.join(r)}" for name, r in roles.items())
    label = f"Class diagram of {application.title}: {words}"
    page = links.pattern(application.id) or ""
    return Diagram(f"pattern-{application.id}", label, "\n".join(lines), application.title, page)


def relation_lines(model: Model, application: PatternApplication) -> list[str]:
    lines: list[str] = []
    for role, other, arrow in RELATIONS:
        for a in (r.module for r in application.roles if r.role == role):
            for b in (r.module for r in application.roles if r.role == other):
                module = model.modules.get(a)
                derives = module is not None and b in module.bases and role != "Decorator"
                used = module is not None and b in (*module.uses, *module.bases)
                if used and b in model.modules and a != b and not derives:
                    lines.append(f"{a} {arrow} {b}")
    return lines


# ---- state machines ----------------------------------------------------------


def machine_diagram(machine: StateMachine, links: Links, stale: bool) -> Diagram:
    """Returns the diagram of a state machine. An arrow is dashed if one of its transitions occurred
    in no test. If the test results are stale, no arrow is dashed."""
    lines = preamble()
    for name, module in machine.states.items():
        hue = STATE_HUES.get(name, "pc")
        link = links.module(module)
        target = f"[[{link}]] " if link else ""
        fill, line = MARKERS[f"fsm-{hue}-fill"], MARKERS[f"fsm-{hue}"]
        lines.append(f"state {name} {target}{fill} ##{line[1:]}")
    if is_narrow(machine):
        lines.append("left to right direction")
    lines.append(f"[*] --> {machine.initial}")
    # All transitions from a state to another state share a single edge.
    edges = grouped(machine.transitions, lambda step: (step.source, step.target))
    for (source, target), steps in edges.items():
        text = "\\n".join(line for step in steps for line in label_lines(step))
        unseen = not stale and not all(step.tests for step in steps)
        arrow = "-[dashed]->" if unseen else "-->"
        lines.append(f"{source} {arrow} {target} : {text}")
    lines.append("@enduml")
    label = (
        f"State diagram: {machine.title}. The table next to the diagram lists the same transitions."
    )
    text, page = "\n".join(lines), links.machine(machine.id) or ""
    return Diagram(f"machine-{machine.id}", label, text, machine.title, page, edges)


def is_narrow(machine: StateMachine) -> bool:
    """Returns true if all labels are short. Then the states fit next to each other on a page."""
    return all(
        len(line) <= SHORT_LABEL for step in machine.transitions for line in label_lines(step)
    )


def label_lines(step: Transition) -> list[str]:
    """Returns the label of a transition: its event, guard, action and requirements."""
    label = f"{step.event} [{step.guard}]" if step.guard else step.event
    requirements = [", ".join(step.requirements)] if step.requirements else []
    if not step.action:
        return [label, *requirements]
    action = f"/ {step.action}"
    event = [label, action] if len(label) > LONG_LABEL else [f"{label} {action}"]
    return [*event, *requirements]


def located(svg: str, requirement: str) -> str:
    """Returns the diagram of a state machine. The edges and labels of the given requirement are
    highlighted."""

    def mark(match: re.Match[str]) -> str:
        lit = " lit" if requirement in match[2].split() else ""
        return f'class="{match[1]}{lit}" data-for="{match[2]}"'

    return LOCATED.sub(mark, svg).replace('class="plant"', 'class="plant located"', 1)


# ---- high-level diagram --------------------------------------------------------

LINES = {
    "call": "-->",
    "interrupt": "-[dotted]->",
    "command": "-[dashed]->",
    "pipe": "-[bold]->",
    "physical": "-[dashed]-",
}


def high_level_diagram(model: Model, links: Links) -> Diagram:
    lines = preamble()
    lines.append(f"skinparam rectangleFontColor {MARKERS['text']}")
    grouped = {name for group in model.groups for name in group.modules}
    for number, group in enumerate(model.groups):
        fill = f"{MARKERS['plain']};line:{MARKERS['edge'][1:]};line.dashed"
        lines.append(f'rectangle "{group.name}" as group{number} {fill} {{')
        lines += [f"  {part(model, name, links)}" for name in group.modules]
        lines.append("}")
    ends = [
        name for connection in model.connections for name in (connection.source, connection.target)
    ]
    lines += [part(model, name, links) for name in dict.fromkeys(ends) if name not in grouped]
    for link in model.connections:
        label = f" : {link.connector}" if link.connector not in ("", "Pipe") else ""
        lines.append(f"{node(link.source)} {LINES[link.kind]} {node(link.target)}{label}")
    lines.append("@enduml")
    label = "High-level diagram. The table below lists the same connections."
    page = "@/architecture.html#high-level"
    return Diagram("high-level", label, "\n".join(lines), "High-level diagram", page)


def node(name: str) -> str:
    """Returns the name of an element inside the text of a diagram."""
    return re.sub(r"\W", "_", name)


def part(model: Model, name: str, links: Links) -> str:
    """Returns the box of a module, or of a part outside the software."""
    module = model.modules.get(name) if name != "PC" else None
    if module is None:
        style = f"{MARKERS['plain']};line:{MARKERS['line'][1:]};line.dotted"
        return f'rectangle "{name}" as {node(name)} {style}'
    words = f"//{name}//" if module.abstract else f"**{name}**"
    kinds = (element.kind for element in model.architecture if name in element.modules)
    colour = next((COLOUR_OF[kind] for kind in kinds if kind in COLOUR_OF), None)
    fill, line = (f"{colour}-fill", colour) if colour else ("plain", "line")
    style = f"{MARKERS[fill]};line:{MARKERS[line][1:]}"
    return f'rectangle "{words}" as {node(name)} [[{links.module(name)}]] {style}'


# ---- drawing -----------------------------------------------------------------


class DiagramError(Exception):
    """PlantUML cannot draw a diagram."""


def draw(diagrams: Iterable[Diagram], cache: Path) -> dict[str, str]:
    """Returns the finished SVG of each diagram, by its id."""
    cache.mkdir(parents=True, exist_ok=True)
    targets = {d.id: (d, cache / f"{digest(d)}.svg") for d in diagrams}
    stale = [(d, path) for d, path in targets.values() if not path.exists()]
    if stale:
        run_plantuml(stale, cache)
    return {name: path.read_text(encoding="utf-8") for name, (_, path) in targets.items()}


def digest(diagram: Diagram) -> str:
    requirement_lists = [step.requirements for steps in diagram.edges.values() for step in steps]
    content = f"{FORMAT}\0{diagram.id}\0{diagram.label}\0{diagram.text}\0{requirement_lists}"
    return hashlib.sha256(content.encode()).hexdigest()[:20]


def run_plantuml(stale: list[tuple[Diagram, Path]], cache: Path) -> None:
    work = cache / "work"
    work.mkdir(exist_ok=True)
    write_fonts(work)
    fonts = {"JDK_JAVA_OPTIONS": f'"-Dsun.java2d.fontpath=append:{work.resolve()}"'}
    inputs = []
    for diagram, path in stale:
        source = work / f"{path.stem}.puml"
        source.write_text(diagram.text + "\n", encoding="utf-8")
        inputs.append(source)
    command = ["plantuml", "-tsvg", "-nometadata", "-charset", "UTF-8", *map(str, inputs)]
    result = subprocess.run(
        command,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        env=os.environ | fonts,
    )
    if result.returncode:
        raise DiagramError(f"PlantUML: {result.stdout.strip()} {result.stderr.strip()}".strip())
    for (diagram, path), source in zip(stale, inputs, strict=True):
        drawn = source.with_suffix(".svg")
        path.write_text(finish(drawn.read_text(encoding="utf-8"), diagram), encoding="utf-8")
        source.unlink()
        drawn.unlink()


def finish(svg: str, diagram: Diagram) -> str:
    """Returns the SVG for a page. The colours are CSS variables, the ids are unique on the page,
    the links are ordinary HTML links, and the text has the font of the page."""
    root = ET.fromstring(svg)
    clean(root)
    width, height = root.get("width", "0").strip("px"), root.get("height", "0").strip("px")
    root.attrib.clear()
    root.set("viewBox", f"0 0 {width} {height}")
    root.set("width", width)
    root.set("height", height)
    root.set("style", f"--width: {width}px")
    root.set("class", "plant")
    root.set("role", "group")
    root.set("aria-label", diagram.label)
    for element in root.iter():
        if identifier := element.get("id"):
            element.set("id", f"{diagram.id}-{re.sub(r'[^A-Za-z0-9_-]', '_', identifier)}")
    labels = {
        identifier: group_edge(root, identifier, steps)
        for (source, target), steps in diagram.edges.items()
        for identifier in [f"{diagram.id}-{source}-_{target}"]
    }
    place_labels(root, labels)
    return ET.tostring(root, encoding="unicode")


def place_labels(root: ET.Element, labels: dict[str, dict[ET.Element, Box]]) -> None:
    """Moves each label away from the lines of the other edges. If a label is then below the bottom
    of the drawing, increases the height of the drawing."""
    paths = {line.get("id", ""): line.get("d", "") for line in root.iter("path")}
    states = [
        Box(x, y, x + float(state.get("width", "0")), y + float(state.get("height", "0")))
        for state in root.iter("rect")
        for x, y in [(float(state.get("x", "0")), float(state.get("y", "0")))]
    ]
    height = float(root.get("height", "0"))
    for identifier, lines in labels.items():
        others = [box for name, own in labels.items() if name != identifier for box in own.values()]
        crossing = [path for name, path in paths.items() if name != identifier]
        down = best_move(list(lines.values()), crossing, [*others, *states])
        for text, box in lines.items():
            move(text, down)
            lines[text] = box.moved(down)
            height = max(height, lines[text].bottom + EDGE)
    root.set("height", f"{height:g}")
    root.set("viewBox", f"0 0 {root.get('width')} {height:g}")


def group_edge(root: ET.Element, identifier: str, steps: list[Transition]) -> dict[ET.Element, Box]:
    """Groups the SVG elements of an edge: its line and its tip in a group, and each label in
    another group. The attribute ``data-for`` of a group lists the requirements. Returns the text
    lines of the labels with their positions.

    The labels are after all edges in the SVG. Therefore no edge is drawn over a label."""
    line = f"path[@id='{identifier}']"
    drawing = next(parent for parent in root.iter() if parent.find(line) is not None)
    parts = list(drawing)
    start = next(at for at, part in enumerate(parts) if part.get("id") == identifier)
    every = dict.fromkeys(name for step in steps for name in step.requirements)
    edge = ET.Element("g", {"class": "edge", "data-for": " ".join(every)})
    rest = iter(parts[start:])
    edge.extend([next(rest), next(rest)])
    labels = []
    places = {}
    for step in steps:
        says = ET.Element("g", {"class": "says", "data-for": " ".join(step.requirements)})
        says.extend(next(rest) for _ in label_lines(step))
        for text in says:
            places[text] = box_of(text)
            del text.attrib["textLength"], text.attrib["lengthAdjust"]
        labels.append(says)
    for part in (*edge, *(text for says in labels for text in says)):
        drawing.remove(part)
    drawing.insert(start, edge)
    drawing.extend(labels)
    return places


def clean(element: ET.Element) -> None:
    for child in list(element):
        if not isinstance(child.tag, str) or child.tag in (f"{SVG}defs", f"{SVG}script"):
            element.remove(child)
        else:
            clean(child)
    element.tag = element.tag.removeprefix(SVG)
    if target := element.get(f"{XLINK}href"):
        element.attrib.clear()
        element.set("href", target)
        return
    restyle(element)


def restyle(element: ET.Element) -> None:
    style = dict(part.split(":", 1) for part in element.get("style", "").split(";") if ":" in part)
    style = {key.strip(): value.strip() for key, value in style.items()}
    for name in ("fill", "stroke"):
        if value := element.attrib.pop(name, None):
            style[name] = value
    for name, value in style.items():
        style[name] = f"var({COLOURS[value.upper()]})" if value.upper() in COLOURS else value
    # PlantUML cannot set the colour of some outlines. The fill has a colour family, and this family
    # has a colour for outlines. The outline gets this colour.
    if style.get("stroke", "").upper() == UNSET:
        style["stroke"] = style.get("fill", "").replace("-fill)", ")")
    if element.tag == "ellipse":  # initial state
        element.set("rx", "5")
        element.set("ry", "5")
    for name in ("font-family", "filter"):
        element.attrib.pop(name, None)
    if element.tag == "text" and element.get("font-style") == "italic":
        element.attrib.pop("font-weight", None)
    if element.tag == "text" and (element.text or "").startswith("«"):
        plain_role(element)
    if style:
        element.set("style", ";".join(f"{key}:{value}" for key, value in style.items()))


def plain_role(element: ET.Element) -> None:
    """Removes the quotation marks « » around the name of a role, and centres the name in the space
    of the former text."""
    element.text = (element.text or "").strip("«»")
    middle = float(element.get("x", "0")) + float(element.attrib.pop("textLength", "0")) / 2
    element.attrib.pop("lengthAdjust", None)
    element.set("x", f"{middle:g}")
    element.set("text-anchor", "middle")


def diagram_files(diagrams: list[Diagram]) -> dict[str, str]:
    """Returns the PlantUML text of each diagram. The key is the path of the file in the site. The
    links in a text are relative to the folder of the diagrams."""
    return {
        f"{DIAGRAMS}/{diagram.id}.puml": diagram.text.replace("[[@/", "[[../") + "\n"
        for diagram in diagrams
    }
