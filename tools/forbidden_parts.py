"""Finds parts of C++ and of its library whose time or memory has no bound. No firmware image may
contain these parts."""

from __future__ import annotations

import re
from pathlib import Path

from elftools.elf.elffile import ELFFile
from elftools.elf.sections import SymbolTableSection

FORBIDDEN = {
    "heap": r"_?(malloc|calloc|realloc|free|memalign)(_r)?|_?sbrk(_r)?|_Zn[wa]j.*|_Zd[la]P.*",
    "unwinder": r"_Unwind_.*|__gxx_personality.*|__aeabi_unwind.*|__cxa_(throw|begin_catch).*",
    "RTTI": r"_ZT[IS].*|__dynamic_cast",
    "soft float": r"__aeabi_([fdh]|u?[il]2[fdh]|c[fd]).*"
    r"|__(add|sub|mul|div|neg)[sd]f[23](vfp)?|__(fix|fixuns|float|floatun|trunc|extend)[sdh][if].*",
}
UNWINDING = ("eh_frame", ".ARM.exidx", ".ARM.extab", ".gcc_except_table")


def forbidden(program: Path) -> set[str]:
    """Returns the kinds of FORBIDDEN that a program contains, according to its symbols and
    sections."""
    with program.open("rb") as file:
        sections = list(ELFFile(file).iter_sections())
        lists = [section for section in sections if isinstance(section, SymbolTableSection)]
        names = {symbol.name for section in lists for symbol in section.iter_symbols()}
        tables = {section.name for section in sections if section["sh_size"]}
    kinds = {
        kind
        for kind, pattern in FORBIDDEN.items()
        if any(re.fullmatch(pattern, name) for name in names)
    }
    if any(part in name for name in tables for part in UNWINDING):
        kinds.add("unwinder")
    return kinds
