"""Makes the table of pins for a page. The source is the C++ table that is compiled into the
firmware."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from portal.tables import comma_separated

HEADER = Path("src/k64/pins.hpp")
COLUMNS = ("pin", "connected to", "use", "signal", "on the FRDM-K64F", "effect")
BEGIN = re.compile(r"kPinTable = std::to_array<PinRow>\(\{$")
END = "});"
TEXT = r'"([^"\\]+)"'
ENTRY = re.compile(
    rf"\{{\{{Port::([A-E]), (\d+), Mux::(\w+), Role::(\w+)\}}, {TEXT}, {TEXT}, {TEXT}\}},"
)
ROLE = re.compile(r"^ *(\w+),? +///< (.+)$", re.MULTILINE)


class PinMapError(ValueError):
    """An error: the header does not have the form that this module can read."""


def pin_map(root: Path) -> str:
    """Returns the table of pins as comma-separated values. The first line contains the titles of
    the columns."""
    text = (root / HEADER).read_text(encoding="utf-8")
    rows = list(entries(text, roles(text)))
    if not rows:
        raise PinMapError(f"{HEADER}: the table kPinTable has no entry")
    return comma_separated(COLUMNS, rows)


def roles(text: str) -> dict[str, str]:
    """Returns the comment of each enumerator of Role."""
    _, _, enum = text.partition("enum class Role")
    return dict(ROLE.findall(enum.partition("};")[0]))


def entries(text: str, uses: dict[str, str]) -> Iterator[tuple[str, ...]]:
    """Yields the rows of the pin table. Raises an error if a source line in the table is neither an
    entry nor a comment, because otherwise a mistyped entry would be lost."""
    inside = ended = False
    for number, line in enumerate(text.splitlines(), 1):
        content = line.strip()
        if not inside:
            inside = not ended and BEGIN.search(line) is not None
        elif content == END:
            inside, ended = False, True
        elif content and not content.startswith("//"):
            match = ENTRY.fullmatch(content)
            if match is None or match[4] not in uses:
                raise PinMapError(
                    f"{HEADER}:{number}: this is not an entry of the table: {content}"
                )
            port, pin, mux, role, *said = match.groups()
            yield f"PT{port}{pin}", mux.upper(), uses[role], *said
    if not ended:
        raise PinMapError(f"{HEADER}: the table kPinTable is missing or has no end")
