"""The campaign of injected faults, with its program and the summary of its cases."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from statistics import median
from typing import Any

from traceability.reading.products import DEFAULT, image_of
from traceability.reading.published import OUTCOMES

PROGRAM = Path("build/host/sim/weeding_robot_faults")
IMAGE, ELF = image_of(DEFAULT, ".bin"), image_of(DEFAULT, ".elf")
BY_ADDRESS = ("ram", "code", "flash")  # kinds of faults at an address that belongs to a module
BY_INSTRUCTION = ("register", "stack")  # kinds of faults that hit the running module
LISTED = 40  # The record lists at most this number of faults with a silent or hung outcome.

Case = dict[str, Any]


def summarise(root: Path, cases: Sequence[Case]) -> dict[str, Any]:
    """Counts the cases by outcome, by kind and by module."""
    from tools.campaign.places import Places

    places = Places(root, root / ELF)
    named = [(case, module_of(places, case)) for case in cases]
    kinds = {case["kind"] for case in cases}
    modules = {module for _, module in named if module}
    silent = [
        (case, module) for case, module in named if module and case["outcome"] in ("silent", "hung")
    ]
    return {
        "outcomes": counted(cases),
        "kinds": {kind: counted(c for c in cases if c["kind"] == kind) for kind in sorted(kinds)},
        "modules": {
            name: counted(case for case, module in named if module == name)
            for name in sorted(modules)
        },
        "safe_after": times([c["safe_after"] for c in cases if c["outcome"] == "detected"]),
        "stops": dict(Counter(case["stop"] for case in cases if case["stop"])),
        "silent": [{**case, "module": module} for case, module in silent[:LISTED]],
    }


def counted(cases: Iterable[Case]) -> dict[str, int]:
    """Returns the number of cases with each outcome."""
    counts = dict.fromkeys(OUTCOMES, 0)
    for case in cases:
        counts[case["outcome"]] += 1
    return counts


def times(values: Sequence[int]) -> dict[str, float]:
    """Returns the median, the 95th percentile and the maximum [ms]."""
    ordered = sorted(values)
    if not ordered:
        return {}
    return {
        "median": median(ordered),
        "p95": ordered[int(0.95 * (len(ordered) - 1))],
        "most": ordered[-1],
    }


def module_of(places: Any, case: Case) -> str:
    """Returns the module that was hit by a fault. Returns an empty text if no module was hit."""
    if case["kind"] in BY_ADDRESS:
        return str(places.of(case["place"]))
    return str(places.of(case["pc"])) if case["kind"] in BY_INSTRUCTION else ""
