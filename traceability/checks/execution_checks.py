"""exec-*: the declared contexts (interrupts and threads) agree with the code, and the shared data
of several contexts is protected."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from traceability.model.design_model import Model
from traceability.model.execution import (
    ENABLE,
    INTERRUPT,
    START,
    THREAD,
    handler_lines,
    line_priorities,
    silent_lines,
)
from traceability.reading.comments import comment_blanked
from traceability.reading.graphs import Ways, way_to
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import texts_below
from traceability.schema import ExecutionContext, Finding, Place
from traceability.sources import DESIGN, SRC

MASKED = "interrupts masked"  # name of a protection in design/execution.toml
WRITES_MASKED = "writes with interrupts masked"  # name of another protection
LOCK = "InterruptLock"  # class whose objects mask the interrupts
MASKS = {f"{LOCK}::{LOCK}", "closeInterrupts"}  # functions that mask the interrupts
DECLARED = Place("design/execution.toml", 1)
HEAP = re.compile(
    r"\bnew\s+[A-Za-z(]|\bdelete\s*(?:\[\]\s*)?[A-Za-z_]|\b(?:malloc|calloc|realloc|free)\s*\(\s*\w"
    r"|#include <(?:vector|string|map|set|unordered_map|unordered_set|deque|list|forward_list"
    r"|memory|any|queue|stack|sstream|iostream|regex|thread|future)>"
    r"|\bstd::(?:function|string|vector|map|set|list|deque|any|unique_ptr|shared_ptr)\b"
)
KINDS = (INTERRUPT, THREAD, START)


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _heap(facts)
    if not facts.declared.contexts:
        return
    yield from _contexts(model, facts)
    yield from _handlers(model, facts)
    yield from _pipes(model, facts)
    yield from _priorities(model, facts)
    yield from _ends(facts)
    yield from _interrupts(model, facts)
    yield from _claims(model, facts)
    yield from _floats(model, facts)
    yield from _loops(facts)
    yield from _enabled(facts)
    yield from _shared(model, facts)
    yield from _unprotected(model, facts)


def _contexts(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds contexts with a wrong kind, body or idle program."""
    for context in model.contexts.values():
        if context.kind not in KINDS:
            kinds = ", ".join(KINDS)
            text = f"{context.id} has the kind {context.kind}; the possible kinds are {kinds}"
            yield _declared(context.place, text)
        if (context.kind == THREAD) != bool(context.body):
            body, key = ("a body", "body") if context.body else ("no body", "kind")
            text = f"{context.id} has the kind {context.kind}, but has {body}"
            yield _declared(facts.line_in(context.place, key), text)
        if context.kind == THREAD and context.body not in facts.bodies:
            text = f"the thread {context.id} names the body {context.body}, which does not exist"
            yield _declared(context.place, text)
        if context.kind == START and context.idle not in _reached(context.handlers, facts):
            text = f"{context.id} names the idle program '{context.idle}', but never calls it"
            yield _declared(facts.line_in(context.place, "idle ="), text)


def _handlers(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds handlers that do not exist, and handlers with no context or with several contexts."""
    declared: dict[str, ExecutionContext] = {}  # handler -> its context
    lines = handler_lines(facts)
    for context in model.contexts.values():
        if len(set(context.handlers)) != len(context.handlers):
            text = f"{context.id} names a handler more than once"
            yield _declared(facts.line_in(context.place, "handlers"), text)
        for handler in context.handlers:
            other = declared.setdefault(handler, context)
            if other is not context:
                for first, two in (context, other), (other, context):
                    text = f"{first.id} and {two.id} have the same handler {handler}"
                    yield _declared(first.place, text)
    for handler, context in declared.items():
        if handler not in facts.bodies:
            text = f"{context.id} names the handler {handler}, which does not exist"
            yield _declared(context.place, text)
        elif handler not in lines and context.kind in (INTERRUPT, THREAD):
            yield _declared(context.place, f"the vector table does not contain {handler}")
    for handler in lines.keys() - declared.keys():
        text = f"the handler {handler} of interrupt line {lines[handler][0]} belongs to no context"
        yield _declared(DECLARED, text)


def _reached(functions: Iterable[str], facts: Facts) -> Ways[str]:
    """Returns all functions that the given functions may call, directly or indirectly."""
    return facts.robot.reached(functions, {}, facts.declared.ends)


def _of_interrupts(model: Model, facts: Facts) -> Iterator[tuple[ExecutionContext, Ways[str]]]:
    """Yields each interrupt, with all functions that its handlers may call."""
    for context in model.contexts.values():
        if context.kind == INTERRUPT:
            start = [*context.handlers, *_called_by_products(context.handlers, facts)]
            yield context, _reached(start, facts)


def _pipes(model: Model, facts: Facts) -> Iterator[Finding]:
    for pipe in model.pipes:
        if pipe.id not in facts.declared.pipes:
            yield _declared(pipe.place, f"the pipe {pipe.id} has no name")
        for verb, methods in (("writes", pipe.writers), ("reads", pipe.readers)):
            contexts = sorted({context for names in methods.values() for context in names})
            if not methods:
                text = f"no method {verb} the pipe {pipe.name}"
                fix = "pass the pipe to the objects that use it, or remove the pipe"
                yield Finding(pipe.place, "exec-shared", text, fix)
            if len(contexts) > 1:
                text = f"more than one context {verb} the pipe {pipe.name}: {', '.join(contexts)}"
                fix = "use a separate pipe for each of these contexts"
                yield Finding(pipe.place, "exec-shared", text, fix)
    names = {pipe.id for pipe in model.pipes}
    for name, pipe_text in facts.declared.pipes.items():
        if name not in names:
            yield _declared(pipe_text.place, f"the robot has no pipe {name}")


def _priorities(model: Model, facts: Facts) -> Iterator[Finding]:
    """Yields a finding for each interrupt line whose priority differs from the priority of its
    context."""
    names = line_priorities(facts)
    right = {
        names[line]
        for context in model.contexts.values()
        for line in context.lines
        if line in names and facts.syntax.constants[names[line]] == context.intended
    }
    findings: dict[tuple[str, str], Finding] = {}
    for context in model.contexts.values():
        for name in {names[line] for line in context.lines if line in names}:
            given = facts.syntax.constants[name]
            if given != context.intended:
                text = f"{context.id} has the priority {given} here, but {context.intended} in "
                # If the constant is right for another context, the finding points to the call that
                # enables the interrupt line. Otherwise, it points to the definition of the
                # constant.
                shared = name in right
                place = _enabled_at(name, context, facts) if shared else _place_of(name, facts)
                key = (name, context.id if shared else "")
                findings[key] = _declared(place, f"{text}{context.place.file}")
    yield from findings.values()


def _enabled_at(constant: str, context: ExecutionContext, facts: Facts) -> Place:
    """Calls with this priority constant enable interrupt lines. Returns the place of the last of
    these calls. If some of these calls name an interrupt line of the context, the other calls are
    ignored."""
    constants = facts.syntax.constants
    calls = [
        call
        for body in facts.syntax.bodies
        for call in body.calls
        if call.target == ENABLE and call.args[1:] and constant in call.args[1]
    ]
    own = [call for call in calls if any(constants.get(n) in context.lines for n in call.args[0])]
    found = own or calls
    return found[-1].place if found else _place_of(constant, facts)


def _place_of(constant: str, facts: Facts) -> Place:
    """Returns the first source line in which the name of a constant occurs."""
    file, _, name = constant.removeprefix("var ").partition(":")
    lines = enumerate(facts.lines_of(file), 1)
    return Place(file, next((number for number, line in lines if name in line), 1))


def _ends(facts: Facts) -> Iterator[Finding]:
    called = {call.target for body in facts.syntax.bodies for call in body.calls}
    place = facts.declared.entries.place_of(facts.root / DECLARED.file, "ends")
    for name in facts.declared.ends:
        if name not in called:
            text = f"design/execution.toml lists {name} in 'ends', but no code calls this method"
            yield _declared(place, text)


def _declared(place: Place, text: str) -> Finding:
    return Finding(place, "exec-declared", text)


def _interrupts(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds methods with @isr{no} that the handler of an interrupt calls, directly or
    indirectly."""
    forbidden = {method.id: method for method in model.methods if method.interrupt == "no"}
    for context, reached in _of_interrupts(model, facts):
        for name in sorted(reached.keys() & forbidden.keys()):
            way = " > ".join(way_to(name, reached))
            text = f"{name} is @isr{{no}}, but the interrupt '{context.name}' calls it: {way}"
            yield Finding(forbidden[name].place, "exec-isr", text)


def _claims(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds methods with @isr{yes} that call a method with @isr{no}."""
    claims = {
        method.id: method.interrupt for method in model.methods if method.kind != "constructor"
    }
    for body in facts.syntax.bodies:
        if claims.get(body.id) == "yes":
            for call in body.calls:
                for target in facts.robot.targets(call):
                    if claims.get(target) == "no":
                        text = f"{body.id} is @isr{{yes}}, but calls {target}, which is @isr{{no}}"
                        yield Finding(call.place, "exec-isr", text)


def _floats(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds floating-point numbers in code that an interrupt executes. If an interrupt uses such
    numbers, the processor also saves the floating-point registers, and the interrupt takes
    longer."""
    findings: dict[Place, Finding] = {}
    for context, reached in _of_interrupts(model, facts):
        for body in (body for name in reached for body in facts.bodies.get(name, [])):
            if body.floats:
                place = Place(body.place.file, body.floats)
                text = f"{body.id} uses floating point, and the interrupt '{context.name}' runs it"
                findings[place] = Finding(place, "exec-float", text)
    yield from findings.values()


def _loops(facts: Facts) -> Iterator[Finding]:
    """Finds functions with a loop that does not count its iterations. A function is permitted if
    design/justified.toml has an entry for it. Also finds entries for functions without such a
    loop."""
    entries = [entry for entry in facts.declared.justified if entry.kind == "loop"]
    named = {name for entry in entries for name in entry.names}
    looping = {body.id: body for body in facts.syntax.bodies if body.loops}
    for name, body in looping.items():
        if name not in named:
            text = f"a loop in {name} does not count its iterations in its head"
            yield Finding(Place(body.place.file, body.loops[0]), "exec-loop", text)
    for entry in entries:
        for name in entry.names:
            if name not in looping:
                text = f"{name} has no loop that needs this justification"
                yield Finding(entry.place, "exec-loop", text, "remove the name")


def _heap(facts: Facts) -> Iterator[Finding]:
    """Finds uses of the heap in the source files. The firmware image is not read, because it may be
    older than the source files."""
    for file, code in texts_below(facts.root, DESIGN, (".cpp", ".hpp")):
        for number, line in enumerate(comment_blanked(code).splitlines(), 1):
            if match := HEAP.search(line):
                words = match[0] if match[0].startswith("#") else match[0].split()[0]
                text = f"'{words.partition('(')[0]}' uses the heap"
                yield Finding(Place(file, number), "exec-heap", text)


def _enabled(facts: Facts) -> Iterator[Finding]:
    """Finds interrupt lines that have a handler in the vector table, but are not enabled by any
    call."""
    for line, handler in silent_lines(facts).items():
        place = facts.bodies[handler][0].place if handler in facts.bodies else DECLARED
        said = f"the vector table has {handler} at interrupt line {line}"
        yield _declared(place, f"{said}, but no call enables this line")


def _called_by_products(handlers: Iterable[str], facts: Facts) -> list[str]:
    """Returns the functions that the given handlers call in products with extensions. For these
    products, the extensions contain separate versions of the handlers."""
    return [
        call.target
        for handler in handlers
        for body in facts.bodies.get(handler, [])
        if not body.place.file.startswith(f"{SRC}/")
        for call in body.calls
    ]


def _unprotected(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds members that are declared as atomic although their type is not atomic. Also finds
    functions that use a member without the lock that its declaration demands."""
    contexts = {context.id: context for context in model.contexts.values()}
    for member in model.shared:
        if "atomic" in member.protection and "atomic" not in member.type:
            text = f"{member.id} is declared as atomic, but its type is {member.type}"
            yield Finding(member.place, "exec-shared", text, "make it std::atomic")
        if member.protection not in (MASKED, WRITES_MASKED):
            continue
        using = [contexts[name] for name in (*member.writers, *member.readers) if name in contexts]
        reached = _reached([name for context in using for name in context.handlers], facts)
        for body in facts.syntax.bodies:
            changed = body.touches.get(member.id)
            needs = changed is not None and (changed or member.protection == MASKED)
            locked = any(call.target in MASKS for call in body.calls)
            if needs and body.id in reached and not locked:
                verb = "changes" if changed else "uses"
                text = f"{body.id} {verb} {member.id}, but does not mask the interrupts"
                fix = f"create an {LOCK} first, or declare the actual protection"
                yield Finding(body.place, "exec-shared", text, fix)


def _shared(model: Model, facts: Facts) -> Iterator[Finding]:
    for member in model.shared:
        if not member.protection:
            text = f"several contexts use {member.id}: it is changed by "
            text += " and ".join(member.writers)
            text += f" and read by {' and '.join(member.readers)}" if member.readers else ""
            text += ", and the design declares no protection"
            yield Finding(member.place, "exec-shared", text)
    members = {member.id for member in model.shared}
    owners = {member.rpartition("::")[0] for member in members}
    for name, protection in facts.declared.protections.items():
        owner, _, last = name.rpartition("::")
        if name not in members and not (last == "*" and owner in owners):
            text = f"{name} is declared as shared, but no two contexts use it"
            yield _declared(protection.place, text)
