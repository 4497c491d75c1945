"""The functions of an image with their frames and calls, as the compiler reports them.

The compiler writes a graph for each unit (``-fcallgraph-info=su``). For the units that it optimises
together, it writes one graph next to the image. A graph has the frames, the direct calls, and the
places of indirect calls. A function of the toolchain's libraries has no graph. Its frame and calls
are read from its instructions.
"""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass, field, replace
from pathlib import Path

from traceability.schema import Place

INDIRECT = "__indirect_call"
NODE = re.compile(r'^node: \{ title: "(?P<title>[^"]+)" label: "(?P<label>[^"]*)"')
EDGE = re.compile(
    r'^edge: \{ sourcename: "(?P<source>[^"]+)" targetname: "(?P<target>[^"]+)"'
    r'(?: label: "(?P<label>[^"]*)")?'
)
FRAME = re.compile(r"(?P<bytes>\d+) bytes \((?P<kind>[a-z,]+)\)")
FUNCTION = re.compile(r"^[0-9a-f]+ <(?P<name>[^>]+)>:$")
CALL = re.compile(r"\t(?:bl|b\.w|b\.n|b|cbz|cbnz|b[a-z]{2}\.[nw])\t.*<(?P<name>[^>+]+)>$")
INDIRECT_CALL = re.compile(r"\tb(?:lx\t|x\t(?!lr))")
PUSH = re.compile(r"\t(?:push|stmdb\tsp!,|v?push)\s*\{(?P<names>[^}]+)\}")
BELOW = re.compile(r"\tsub(?:\.w|w)?\tsp, (?:sp, )?#(?P<bytes>\d+)")
STORE = re.compile(r"\t(?:str|strd)(?:\.w)?\t.*\[sp, #-(?P<bytes>\d+)\]!")
TABLE = re.compile(r"^[0-9a-f]+ ([0-9a-f]+) \w vtable for wr::(\w+)$", re.MULTILINE)
# The name of a method. The parameters that distinguish overloads are left out.
SHORT = re.compile(r"(?:wr::)(?P<name>[\w:~]+(?:<[^()]*>[\w:~]*)*)\(")


@dataclass
class Function:
    """A function of the image. ``frame`` is in bytes. If ``dynamic`` is true, the frame has no
    bound.
    """

    symbol: str
    name: str
    frame: int
    dynamic: bool = False
    measured: bool = False  # The facts are from the instructions, and not from the compiler.
    blind: bool = False  # Its instructions call a function that only the compiler's graph contains.
    calls: list[str] = field(default_factory=list)  # symbols
    indirect: list[Place] = field(default_factory=list)


def read_graph(root: Path, elf: Path) -> dict[str, Function]:
    """Returns all functions of the image, by their symbols. ``root`` is the source folder of the
    image.
    """
    reported: dict[str, Function] = {}
    own = [*elf.parent.glob(f"{elf.stem}.*.ci"), *elf.parent.glob("*/**/*.ci")]
    for file in sorted(own):
        _read_unit(root, elf.parent, file.read_text(encoding="utf-8"), reported)
    listing = _run("arm-none-eabi-objdump", "-d", "--no-show-raw-insn", str(elf))
    listed = _read_listing(listing)
    for names in names_of_addresses(elf):
        listed_name = next((name for name in names if name in listed), None)
        listed |= {
            name: listed[listed_name]
            for name in names
            if listed_name is not None and name not in listed
        }
    functions = {
        symbol: replace(reported.get(symbol) or reported.get(_alias(symbol, reported), function))
        for symbol, function in listed.items()
    }
    for function, name in zip(functions.values(), _readable(list(functions)), strict=True):
        function.name = name
        function.calls = [_alias(symbol, functions) for symbol in function.calls]
    return functions


def short_name(name: str) -> str:
    """Returns ``Class::method``. The name of a function outside of the project is unchanged."""
    match = SHORT.search(name)
    return match["name"] if match else name


def uses_floats(elf: Path) -> bool:
    """Returns whether the image has instructions of the floating-point unit."""
    listing = _run("arm-none-eabi-objdump", "-d", "--no-show-raw-insn", str(elf))
    return re.search(r"^\s*[0-9a-f]+:\tv[a-z]+", listing, re.MULTILINE) is not None


def symbol_value(elf: Path, name: str) -> int:
    """Returns the value of a symbol, or 0 if there is no such symbol."""
    match = re.search(rf"^([0-9a-f]+) . {name}$", _run("arm-none-eabi-nm", str(elf)), re.MULTILINE)
    return int(match[1], 16) if match else 0


def _read_unit(root: Path, folder: Path, text: str, reported: dict[str, Function]) -> None:
    for line in text.splitlines():
        if node := NODE.match(line):
            if frame := FRAME.search(node["label"]):
                _note_frame(reported, _symbol(node["title"]), frame)
        elif (edge := EDGE.match(line)) and (source := reported.get(_symbol(edge["source"]))):
            if edge["target"] == INDIRECT:
                source.indirect.append(_place(root, folder, edge["label"] or ""))
            else:
                source.calls.append(_symbol(edge["target"]))


def _symbol(title: str) -> str:
    """Returns the symbol of a function. The title of a function that is local to a file begins with
    the file."""
    return title.rpartition(":")[2]


def _note_frame(reported: dict[str, Function], symbol: str, frame: re.Match[str]) -> None:
    """Records the frame of a function. Functions of several units with the same name count as one
    function with the largest frame.
    """
    function = reported.setdefault(symbol, Function(symbol, "", 0))
    function.frame = max(function.frame, int(frame["bytes"]))
    function.dynamic |= "dynamic" in frame["kind"] and "bounded" not in frame["kind"]


def _place(root: Path, folder: Path, label: str) -> Place:
    """Returns the place of a function. The compiler writes full paths or paths from the build
    folder. The linker writes paths from the root.
    """
    file, line, _column = label.rsplit(":", 2)
    path = root / file if (root / file).exists() else (folder / file).resolve()
    return Place(str(path.relative_to(root)) if path.is_relative_to(root) else file, int(line))


def _read_listing(listing: str) -> dict[str, Function]:
    functions: dict[str, Function] = {}
    function = None
    for line in listing.splitlines():
        if start := FUNCTION.match(line):
            function = Function(start["name"], "", 0, measured=True)
            functions[function.symbol] = function
        elif function is not None:
            if (call := CALL.search(line)) and call["name"] != function.symbol:
                function.calls.append(call["name"])
            function.blind |= INDIRECT_CALL.search(line) is not None
            function.frame += _pushed(line)
    return functions


def names_of_addresses(elf: Path) -> list[list[str]]:
    """Returns the names of each function. The compiler can give the same address to equal
    functions."""
    symbols: dict[str, list[str]] = {}
    for line in _run("arm-none-eabi-nm", str(elf)).splitlines():
        address, kind, name = (*line.split(), "", "")[:3]
        if kind in ("t", "T", "W"):
            symbols.setdefault(address, []).append(name)
    return [names for names in symbols.values() if len(names) > 1]


def table_bytes(elf: Path) -> dict[str, int]:
    """Returns the number of bytes in the table of methods of each class."""
    listed = _run("arm-none-eabi-nm", "--print-size", "--demangle", str(elf))
    return {name: int(size, 16) for size, name in TABLE.findall(listed)}


def _pushed(line: str) -> int:
    """Returns the number of bytes that an instruction subtracts from the stack pointer. The sum
    over the instructions of a function is its frame.
    """
    if push := PUSH.search(line):
        names = [part.strip() for part in push["names"].split(",")]
        return 4 * sum(_width(name) for name in names)
    below = BELOW.search(line) or STORE.search(line)
    return int(below["bytes"]) if below else 0


def _width(names: str) -> int:
    """Returns the number of words of a register or of a range of registers, such as ``r4-r7`` or
    ``d8``."""
    first, _, last = names.partition("-")
    count = int(last[1:]) - int(first[1:]) + 1 if last and last[1:].isdigit() else 1
    return count * (2 if first.startswith("d") else 1)


def _alias(symbol: str, functions: dict[str, Function]) -> str:
    """Returns the symbol under which the functions contain a body. A constructor or destructor has
    several symbols for its body.
    """
    if symbol in functions:
        return symbol
    for kind, other in (("C1E", "C2E"), ("C2E", "C1E"), ("D1E", "D2E"), ("D2E", "D1E")):
        if (named := symbol.replace(kind, other)) in functions:
            return named
    return symbol


def _readable(symbols: list[str]) -> list[str]:
    done = subprocess.run(
        ["arm-none-eabi-c++filt"],
        input="\n".join(symbols),
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.splitlines()


def _run(*command: str) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout
