"""time-*: the longest execution times of the firmware image can be computed, and no measured run
needed more time than computed. The bound of a loop over an array is not lower than the number of
elements."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress

from traceability.model.design_model import Model
from traceability.model.response_times import DECLARED_IN
from traceability.reading.loop_bounds import DECLARED, Bounds
from traceability.reading.published import LOADS
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below
from traceability.schema import Finding, Place, TimeProof
from traceability.sources import DESIGN, text_of

DECLARATION = Place(str(DECLARED_IN), 1)
# A loop over an array, or over the first elements of an array.
LOOP = re.compile(r"\bfor \(.+ : (?:(\w+)|std::span\((\w+)\)\.first\(\w+\))\) \{")


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _low_bounds(model, facts)
    yield from exceeded(model, facts)


def exceeded(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds two kinds of faults: a time that cannot be computed, and a run that took longer than
    the computed time."""
    if model.times is None:
        return
    loads = model.campaigns.get(LOADS)
    outcomes = loads.result["outcomes"] if loads else {}
    cycle_ms, noise_ms = model.times.cycle_ms, model.times.noise_ms
    seen = [
        ("a control cycle", model.times.seen_ms, cycle_ms),
        ("a control cycle of a random drive", outcomes.get("longest_ms"), cycle_ms),
        ("a control cycle of a random drive with noise", outcomes.get("noise_ms"), noise_ms),
        *((f"the path '{path.title}'", path.seen_ms, path.ms) for path in model.times.paths),
    ]
    yield from _loops(model.times)
    for what, seen_ms, bound_ms in seen:
        yield from _seen(model.times, what, seen_ms, bound_ms)
    for context, recording, requests, ms in model.times.too_often:
        text = (
            f"the recording {recording} contains {requests} interrupts of {context} in {ms:.3f} "
            f"ms, but {DECLARED_IN} permits fewer"
        )
        lines = lines_below(facts.root, (str(DECLARED_IN),), ())
        place = [place for place, line in lines if line == f'context = "{context}"'][-1]
        yield Finding(place, "time-seen", text, "correct the number of entries of this context")


def _low_bounds(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds loops over an array with a bound that is lower than the number of elements. A lower
    bound is permitted if two conditions are true: the bound is a formula or a name, and the loop
    reads only the first elements."""
    bounds = Bounds(facts.root, model.integers)
    before = ""
    for place, line in lines_below(facts.root, DESIGN, (".cpp", ".hpp")):
        loop, bound = LOOP.search(line), DECLARED.match(before)
        before = line.strip()
        if loop and bound and (loop[1] or bound[1].isdecimal()):
            size = _size(facts, bounds, place.file, loop[1] or loop[2])
            with suppress(KeyError):  # The bound contains a name of design/times.toml.
                if size and bounds.value(bound[1]) < size:
                    text = f"the bound {bound[1]} is lower than the {size} elements of the array"
                    above = Place(place.file, place.line - 1)
                    yield Finding(above, "time-bound", text, "correct the bound")


def _size(facts: Facts, bounds: Bounds, file: str, name: str) -> int | None:
    """Returns the number of elements of an array that a file or its header declares. Returns None
    if neither file declares the array."""
    path = facts.root / file
    text = text_of(path) + text_of(path.with_suffix(".hpp"))
    array = re.search(rf"std::array<[^;]*, ([^,<>]+)> {name}\b", text)
    for size in (array[1], f"{path.stem}::{array[1]}") if array else ():
        with suppress(KeyError, ValueError, SyntaxError):
            return bounds.value(size)
    return None


def _loops(proof: TimeProof) -> Iterator[Finding]:
    bound = "write the bound above the loop or the copy (// bound: NUMBER)"
    call = "call an object that a builder passes, or declare the call in design/stack.toml"
    for name, place in proof.unbound:
        yield Finding(place, "time-bound", f"a loop or a memory copy in {name} has no bound", bound)
    for name, place in proof.unbound_locks:
        text = f"a lock of the interrupts in {name} contains a loop or a call, and has no bound"
        yield Finding(place, "time-bound", text, "move the loop or the call out of the lock")
    for name, place in proof.unresolved:
        yield Finding(place, "time-bound", f"the target of a call in {name} is unknown", call)


def _seen(proof: TimeProof, what: str, seen_ms: float | None, bound_ms: float) -> Iterator[Finding]:
    if not proof.proven or seen_ms is None or seen_ms <= bound_ms:
        return
    text = f"{what} took {seen_ms:.3f} ms, which is more than the bound of {bound_ms:.3f} ms"
    yield Finding(DECLARATION, "time-seen", text)
