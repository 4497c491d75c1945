"""The layers of the firmware. They are computed from the allowed uses between its folders."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter

from traceability.schema import AllowedUse, is_extension

ANY = "*"  # name in design/uses.toml that means every logic module
DRIVERS = "k64"


@dataclass
class Folder:
    """A folder of the firmware, its layer, and the folders that it may use."""

    name: str
    layer: int
    uses: list[str]


def layers(allowed: Iterable[AllowedUse]) -> list[Folder]:
    """Returns the folders from bottom to top. A folder may use only folders of lower layers.

    The folders are the top folders of ``src``, the extensions, and the folders that use the
    drivers. Returns an empty list if the allowed uses form a cycle.
    """
    uses = [use for use in allowed if use.source != ANY]
    everywhere = {use.target for use in allowed if use.source == ANY}
    separate = {use.source for use in uses if use.target == DRIVERS}

    def folder(name: str) -> str:
        depth = 2 if is_extension(name) else 1
        return name if name in separate else "/".join(name.split("/")[:depth])

    pairs = {(folder(use.source), folder(use.target)) for use in uses}
    below = {name: everywhere - {name} for pair in pairs for name in pair}
    for user, used in pairs:
        below[user] |= {used} - {user}
    order = TopologicalSorter(below)
    try:
        order.prepare()
    except CycleError:
        return []
    found: list[Folder] = []
    layer = 0
    while order.is_active():
        layer += 1
        ready = sorted(order.get_ready())
        found += [Folder(name, layer, sorted(below.get(name, ()))) for name in ready]
        order.done(*ready)
    return found
