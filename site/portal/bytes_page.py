"""The page "Follow a byte". It shows chains of recorded steps, for example from a byte of the PC to
a motor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from portal.portal import Portal
from portal.recorded_calls import (
    COMMAND,
    MethodLinks,
    links_of,
    name_of,
    recordings_of,
    requirements_by_method,
    shown_time,
    windows_of,
)
from traceability.reading.call_record import Recording
from traceability.reading.chains import Chain, Step, declared_chains, first_missing, follow

SHOWN = 4  # number of requirements that a step shows


@dataclass
class Row:
    """A step of a chain as the page shows it."""

    step: Step
    since: int  # time since the first step [ns]
    context: str = "hardware"
    priority: int | None = None
    links: MethodLinks | None = None
    brief: str = ""
    requirements: tuple[str, ...] = ()
    others: int = 0  # number of requirements that are not shown


@dataclass
class Followed:
    """A chain of steps with its rows. If the recording does not contain the whole chain, there are
    no rows, and ``missing`` names the first step that was not found. Without a recording, there are
    no rows either."""

    chain: Chain
    rows: list[Row]
    missing: str = ""


def follow_bytes(portal: Portal) -> dict[str, Any]:
    recordings = recordings_of(portal) or {}
    chains = [
        _followed(portal, chain, recordings.get(chain.recording))
        for chain in declared_chains(portal.root)
    ]
    return {
        "chains": chains,
        "windows": windows_of(portal),
        "command": COMMAND,
        "time": shown_time,
        "wide": True,
    }


def _followed(portal: Portal, chain: Chain, recording: Recording | None) -> Followed:
    if recording is None:
        return Followed(chain, [])
    steps = follow(chain, recording)
    if steps is None:
        return Followed(chain, [], first_missing(chain, recording))
    trees = requirements_by_method(portal)
    rows = [Row(step, step.at - steps[0].at, brief=step.text) for step in steps]
    for row in rows:
        if row.step.span is None:
            continue
        span = recording.spans[row.step.span]
        activation = recording.activations[span.activation]
        method = portal.links.find_method(span.method)
        row.context, row.priority = name_of(portal, activation), activation.priority
        row.links = links_of(portal, span.method, trees)
        row.brief = method.brief if method else ""
    _choose_requirements(rows)
    return Followed(chain, rows)


def _choose_requirements(rows: list[Row]) -> None:
    """Sets the requirements that each row shows. A requirement is shown first if its invocation
    tree contains the method of the row, and also the method of the row above or below."""
    for number, row in enumerate(rows):
        if row.links is None:
            continue
        near = {
            requirement
            for other in (*rows[max(0, number - 1) : number], *rows[number + 1 : number + 2])
            if other.links
            for requirement in other.links.requirements
        }
        identifiers = sorted(row.links.requirements, key=lambda identifier: identifier not in near)
        row.requirements = tuple(identifiers[:SHOWN])
        row.others = len(identifiers) - len(row.requirements)
