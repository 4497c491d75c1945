"""Prepares the recorded calls for the pages: the context, method and requirements of each call."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from portal.portal import Portal
from traceability.reading.call_record import (
    RECORD,
    Activation,
    Recording,
    Window,
    declared_recordings,
    read_recordings,
)

PULSE = "cycleTimerInterrupt"  # the handler of the clock pulse
COMMAND = "./wr portal"  # the command that makes the records
NOT_ENTERED = "idle program"


@dataclass(frozen=True)
class MethodLinks:
    """The addresses of a method on the pages, and its requirements."""

    name: str
    page: str | None
    source: str | None
    requirements: list[str]


def recordings_of(portal: Portal) -> dict[str, Recording] | None:
    path = portal.root / RECORD
    return _read(portal.root, path.stat().st_mtime_ns) if path.exists() else None


@functools.cache
def _read(root: Path, _time: int) -> dict[str, Recording] | None:
    return read_recordings(root)


def windows_of(portal: Portal) -> Mapping[str, Window]:
    return {window.name: window for window in declared_recordings(portal.root)}


def name_of(portal: Portal, activation: Activation) -> str:
    """Returns the name of the interrupt or thread that owns the interrupt line of an activation."""
    other = NOT_ENTERED if activation.line < 0 else f"interrupt {activation.line}"
    contexts = portal.model.contexts.values()
    return next((context.name for context in contexts if activation.line in context.lines), other)


def requirements_by_method(portal: Portal) -> dict[str, list[str]]:
    """For each method, returns the requirements whose invocation trees contain this method."""
    requirements: dict[str, list[str]] = {}
    for requirement in portal.model.requirements.values():
        nodes = (node for _, node in portal.nodes(requirement))
        for method in dict.fromkeys(node.resolved or node.label for node in nodes):
            requirements.setdefault(method, []).append(requirement.id)
    return requirements


def links_of(portal: Portal, name: str, trees: Mapping[str, list[str]]) -> MethodLinks:
    """Returns the links of a recorded method. If the class inherits the method, these are the links
    of the method in the base class."""
    method = portal.links.find_method(name)
    if method is None:
        function = portal.model.functions.get(name)
        source = portal.links.source(function.place) if function else None
        page = portal.links.module(name.partition("::")[0]) if "::" in name else None
        return MethodLinks(name, page, source, trees.get(name, []))
    return MethodLinks(
        name,
        portal.links.method(method.id),
        portal.links.source(method.body or method.place),
        trees.get(method.id, []),
    )


def shown_time(nanoseconds: float) -> str:
    """Returns a duration as text. The unit depends on the length of the duration."""
    if abs(nanoseconds) < 1e3:
        return f"{nanoseconds:.0f} ns"
    if abs(nanoseconds) < 1e6:
        return f"{nanoseconds / 1e3:.1f} µs"
    return f"{nanoseconds / 1e6:.3f} ms"
