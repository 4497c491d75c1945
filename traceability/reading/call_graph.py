"""Reads the functions of a firmware image, with their stack frames and calls, from the reports of
the compiler.

The compiler writes a call graph for each translation unit (``-fcallgraph-info=su``). For the units
that it optimises together, it writes one call graph next to the firmware image. A call graph
contains the stack frames, the direct calls, and the places of indirect calls. The functions of the
toolchain's libraries are in no call graph. Their frames and calls are read from their instructions.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from pathlib import Path

from traceability.grouping import grouped
from traceability.reading.machine_code import register_words
from traceability.reading.programs import disassembly, output_of
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
# Matches the name of a method without the parameter list.
SHORT = re.compile(r"(?:wr::)(?P<name>[\w:~]+(?:<[^()]*>[\w:~]*)*)\(")


@dataclass
class Function:
    """A function of the firmware image. ``frame`` is the size of its stack frame in bytes. If
    ``dynamic`` is true, the real size is known only at run time, and has no known bound."""

    symbol: str
    name: str
    frame: int
    dynamic: bool = False
    # true if the frame and the calls were read from the instructions, because the compiler reported
    # nothing
    measured: bool = False
    blind: bool = False  # true if the function has an indirect call whose target is unknown
    calls: list[str] = field(default_factory=list)  # symbols of the called functions
    indirect: list[Place] = field(default_factory=list)


def read_graph(root: Path, elf: Path) -> dict[str, Function]:
    """Returns all functions of the firmware image by their symbols. ``root`` is the folder with the
    sources of this image."""
    reported: dict[str, Function] = {}
    own = [*elf.parent.glob(f"{elf.stem}.*.ci"), *elf.parent.glob("*/**/*.ci")]
    for file in sorted(own):
        _read_unit(root, elf.parent, file.read_text(encoding="utf-8"), reported)
    listed = _read_listing(disassembly(elf))
    for same in names_of_addresses(elf):
        known = [listed[name] for name in same if name in listed]
        listed |= {name: known[0] for name in same if known and name not in listed}
    functions = {
        symbol: replace(reported.get(symbol) or reported.get(_alias(symbol, reported), function))
        for symbol, function in listed.items()
    }
    names = output_of("arm-none-eabi-c++filt", given="\n".join(functions)).splitlines()
    for function, name in zip(functions.values(), names, strict=True):
        function.name = name
        function.calls = [_alias(symbol, functions) for symbol in function.calls]
    return functions


def short_name(name: str) -> str:
    """Returns the name of a function as ``Class::method``. The name of a function outside the
    project is returned unchanged."""
    match = SHORT.search(name)
    return match["name"] if match else name


def uses_floats(elf: Path) -> bool:
    """Returns whether the firmware image contains instructions of the floating-point unit."""
    return re.search(r"^\s*[0-9a-f]+:\tv[a-z]+", disassembly(elf), re.MULTILINE) is not None


def symbol_value(elf: Path, name: str) -> int:
    """Returns the value of a symbol of the firmware image. Returns 0 if the symbol does not
    exist."""
    match = re.search(rf"^([0-9a-f]+) . {name}$", output_of("arm-none-eabi-nm", elf), re.MULTILINE)
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
    """Returns the symbol of a function from its title in the call graph. For a function that is
    local to a file, the title contains the file before the symbol."""
    return title.rpartition(":")[2]


def _note_frame(reported: dict[str, Function], symbol: str, frame: re.Match[str]) -> None:
    """Records the stack frame of a function. If several translation units contain functions with
    the same symbol, these functions are regarded as one function with the largest frame."""
    function = reported.setdefault(symbol, Function(symbol, "", 0))
    function.frame = max(function.frame, int(frame["bytes"]))
    function.dynamic |= "dynamic" in frame["kind"] and "bounded" not in frame["kind"]


def _place(root: Path, folder: Path, label: str) -> Place:
    """Returns the place of an indirect call. The path in the label can be absolute, relative to the
    build folder (from the compiler) or relative to the root (from the linker)."""
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
    """Returns the groups of symbols that have the same address. The compiler can merge functions
    with equal code."""
    rows = re.findall(r"^(\w+) [tTW] (\S+)", output_of("arm-none-eabi-nm", elf), re.MULTILINE)
    groups = grouped(rows, lambda row: str(row[0])).values()
    return [[name for _, name in group] for group in groups if len(group) > 1]


def table_bytes(elf: Path) -> dict[str, int]:
    """Returns a map from each class to the size of its virtual method table in bytes."""
    listed = output_of("arm-none-eabi-nm", "--print-size", "--demangle", elf)
    return {name: int(size, 16) for size, name in TABLE.findall(listed)}


def _pushed(line: str) -> int:
    """Returns the number of bytes that an instruction reserves on the stack. The size of the stack
    frame of a function is the sum of these numbers over all instructions."""
    if push := PUSH.search(line):
        return 4 * register_words(push["names"])
    below = BELOW.search(line) or STORE.search(line)
    return int(below["bytes"]) if below else 0


def _alias(symbol: str, functions: dict[str, Function]) -> str:
    """Returns the symbol under which ``functions`` contains a function. A constructor or destructor
    can have several symbols, but ``functions`` may contain only one of them."""
    if symbol in functions:
        return symbol
    for kind, other in (("C1E", "C2E"), ("C2E", "C1E"), ("D1E", "D2E"), ("D2E", "D1E")):
        if (named := symbol.replace(kind, other)) in functions:
            return named
    return symbol
