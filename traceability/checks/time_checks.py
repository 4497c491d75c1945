"""time-*: the greatest time of the image is known, and no run needed more."""

from __future__ import annotations

from traceability.model.design_model import Model
from traceability.model.time_bounds import DECLARED_IN
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place, TimeProof

DECLARATION = Place(str(DECLARED_IN), 1)


def check(model: Model, _facts: Facts) -> list[Finding]:
    return [] if model.times is None else [*_loops(model.times), *_seen(model.times)]


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


def _seen(proof: TimeProof) -> list[Finding]:
    if not proof.proven or proof.seen_ms is None or proof.seen_ms <= proof.cycle_ms:
        return []
    text = (
        f"a control cycle took {proof.seen_ms} ms, more than the bound of {proof.cycle_ms:.3f} ms"
    )
    fix = f"find the bound of a loop, or the number in {DECLARED_IN}, that is too small"
    return [Finding(DECLARATION, "time-seen", text, fix)]
