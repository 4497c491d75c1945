"""stack-*: the largest stack use of the firmware image can be computed, and is not larger than the
stack."""

from __future__ import annotations

from collections.abc import Iterator

from traceability.model.design_model import Model
from traceability.reading.graphs import descendants
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place, StackProof

SCRIPT = Place("src/k64/start_up/k64.ld", 1)


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    if model.stack is None:
        yield from _self_calls(facts)
    else:
        yield from _calls(model.stack)
        yield from _cycles(model.stack, facts)
        yield from _bound(model.stack)


def _self_calls(facts: Facts) -> Iterator[Finding]:
    """Finds functions that call themselves, directly or through functions of the same source file.
    This check needs no firmware image. It replaces the other checks of the stack if no firmware
    image was built from the present sources."""
    calls: dict[str, dict[str, set[str]]] = {}
    for body in facts.syntax.bodies:
        own = calls.setdefault(body.place.file, {}).setdefault(body.id, set())
        own.update(call.target for call in body.calls if not call.virtual)
    for body in facts.syntax.bodies:
        if body.id in descendants(body.id, calls[body.place.file]):
            text = f"{body.id} calls itself, directly or through other functions of its file"
            yield Finding(body.place, "stack-recursion", text)


def _calls(proof: StackProof) -> Iterator[Finding]:
    for function, place in proof.unresolved:
        yield Finding(place, "stack-call", f"the target of this call in {function} is unknown")
    if proof.untold:
        count, first = len(proof.untold), min(proof.untold)
        text = f"the compiler reported no stack use for {count} functions, such as {first}"
        fix = "remove build/k64 and build again without a compiler cache"
        yield Finding(SCRIPT, "stack-call", text, fix)


def _cycles(proof: StackProof, facts: Facts) -> Iterator[Finding]:
    for cycle in proof.cycles:
        bodies = [body for name in cycle for body in facts.bodies.get(name, [])]
        place = bodies[0].place if bodies else SCRIPT
        text = f"recursion: {' > '.join([*cycle, cycle[0]])}"
        yield Finding(place, "stack-recursion", text)


def _bound(proof: StackProof) -> Iterator[Finding]:
    for function in proof.dynamic:
        text = f"the frame of {function} has no bound"
        yield Finding(SCRIPT, "stack-bound", text, "choose a fixed size for each array")
    if proof.proven and proof.total > proof.limit:
        calls = [call for level in proof.levels for call in level.chain]
        largest = max(calls, key=lambda call: call.bytes)
        text = (
            f"the stack has {proof.limit} bytes, but the program may need {proof.total} bytes; in "
            f"the chains of calls that need the most stack, {largest.name} has the largest frame, "
            f"{largest.bytes} bytes"
        )
        fix = "make this frame smaller, or raise stackSize in this file"
        yield Finding(SCRIPT, "stack-bound", text, fix)
    if proof.seen is not None and proof.seen > proof.total:
        text = (
            f"a run used {proof.seen} bytes of the stack, more than the computed {proof.total} "
            "bytes"
        )
        fix = "find the call that the computation does not contain"
        yield Finding(SCRIPT, "stack-bound", text, fix)
