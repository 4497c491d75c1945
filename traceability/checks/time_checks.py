"""time-*: the greatest time of the image is known, and no run needed more."""

from __future__ import annotations

from traceability.model.design_model import Model
from traceability.model.time_bounds import DECLARED_IN
from traceability.reading.fault_record import LOADS
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place, TimeProof

DECLARATION = Place(str(DECLARED_IN), 1)


def check(model: Model, _facts: Facts) -> list[Finding]:
    if model.times is None:
        return []
    loads = model.campaigns.get(LOADS)
    random = loads.result["outcomes"]["longest_ms"] if loads else None
    return [
        *_loops(model.times),
        *_seen(model.times, "a control cycle", model.times.seen_ms),
        *_seen(model.times, "a control cycle of a random drive", random),
    ]


def _loops(proof: TimeProof) -> list[Finding]:
    bound = "write the bound above the loop or the copy (// bound: NUMBER)"
    call = "call an object that a builder passes, or declare the call in design/stack.toml"
    return [
        *(
            Finding(place, "time-bound", f"nothing bounds a loop or a copy in {name}", bound)
            for name, place in proof.unbound
        ),
        *(
            Finding(place, "time-bound", f"the target of a call in {name} is unknown", call)
            for name, place in proof.unresolved
        ),
    ]


def _seen(proof: TimeProof, what: str, seen_ms: float | None) -> list[Finding]:
    if not proof.proven or seen_ms is None or seen_ms <= proof.cycle_ms:
        return []
    text = f"{what} took {seen_ms} ms, more than the bound of {proof.cycle_ms:.3f} ms"
    fix = f"find the bound of a loop, or the number in {DECLARED_IN}, that is too small"
    return [Finding(DECLARATION, "time-seen", text, fix)]
