"""time-*: the longest execution times of the firmware image can be computed, and no measured run
needed more time than computed."""

from __future__ import annotations

from collections.abc import Iterator

from traceability.model.design_model import Model
from traceability.model.response_times import DECLARED_IN
from traceability.reading.fault_record import LOADS
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below
from traceability.schema import Finding, Place, TimeProof

DECLARATION = Place(str(DECLARED_IN), 1)


def check(model: Model, facts: Facts) -> Iterator[Finding]:
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
            "ms, which is more than declared"
        )
        lines = lines_below(facts.root, (str(DECLARED_IN),), ())
        place = [place for place, line in lines if line == f'context = "{context}"'][-1]
        yield Finding(place, "time-seen", text, "correct the number of entries of this context")


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
