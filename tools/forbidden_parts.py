"""Finds parts of the language and of the library that have no bound in time or memory. No firmware
image may contain these parts."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

FORBIDDEN = {
    "heap": r"_?(malloc|calloc|realloc|free|memalign)(_r)?|_?sbrk(_r)?|_Zn[wa]j.*|_Zd[la]P.*",
    "unwinder": r"_Unwind_.*|__gxx_personality.*|__aeabi_unwind.*|__cxa_(throw|begin_catch).*",
    "RTTI": r"_ZT[IS].*|__dynamic_cast",
    "soft float": r"__aeabi_([fdh]|u?[il]2[fdh]|c[fd]).*"
    r"|__(add|sub|mul|div|neg)[sd]f[23](vfp)?|__(fix|fixuns|float|floatun|trunc|extend)[sdh][if].*",
}
UNWINDING = ("eh_frame", ".ARM.exidx", ".ARM.extab", ".gcc_except_table")
SECTION = re.compile(r"^ *\[ *\d+\] (\S+) +\S+ +[0-9a-f]{8} [0-9a-f]+ ([0-9a-f]+) ", re.MULTILINE)


def forbidden(program: Path) -> set[str]:
    """Returns the kinds of FORBIDDEN that a program contains, according to its symbols and
    sections."""
    listed = _output("arm-none-eabi-nm", "--format=posix", program).splitlines()
    names = [line.split(maxsplit=1)[0] for line in listed]
    kinds = {
        kind
        for kind, pattern in FORBIDDEN.items()
        if any(re.fullmatch(pattern, name) for name in names)
    }
    text = _output("arm-none-eabi-readelf", "--sections", "--wide", program)
    tables = [name for name, size in SECTION.findall(text) if int(size, 16)]
    if any(part in name for name in tables for part in UNWINDING):
        kinds.add("unwinder")
    return kinds


def _output(*words: str | Path) -> str:
    done = subprocess.run(words, check=True, capture_output=True, text=True, timeout=60)
    return done.stdout
