"""The execution contexts, the methods that each context may execute, and the data members that two
contexts share.

An execution context is code that the hardware starts: an interrupt handler, the command of a
thread, or the program after a reset. To find the methods of a context, this module follows all
calls in the syntax tree. A call of a virtual method is followed to the classes of those objects
that the builders passed to the caller."""

from __future__ import annotations

from dataclasses import replace

from traceability.model.design_model import Model
from traceability.reading.ast_facts import BodyFact, FieldFact
from traceability.reading.graphs import Ways
from traceability.reading.source_facts import Facts, Object
from traceability.schema import ExecutionContext, Place, SharedMember, SharedPipe

PIPE = "Pipe"
READS = ("read", "newest")
START = "start"
THREAD = "thread"
INTERRUPT = "interrupt"
DISPATCH = "Command::execute"  # operation that the handler of a thread calls
ENABLE = "K64Thread::enable"  # method with the arguments: interrupt line, priority of this line


# context -> method that the context may execute while the other contexts run -> the caller through
# which the search found this method
Methods = dict[str, Ways[str]]


def with_execution(model: Model, facts: Facts) -> Model:
    lines_of = handler_lines(facts)
    methods: Methods = {}
    priorities = line_priorities(facts)
    contexts: dict[str, ExecutionContext] = {}
    for name, context in facts.declared.contexts.items():
        lines = sorted({n for handler in context.handlers for n in lines_of.get(handler, [])})
        names = {priorities[line] for line in lines if line in priorities}
        numbers = {facts.syntax.constants[name] for name in names}
        narrowed = {DISPATCH: context.body} if context.body else {}
        reached = facts.robot.reached(context.handlers, narrowed, facts.declared.ends)
        methods[context.id] = reached
        if context.kind == START:  # Only the part after the start of the interrupts counts.
            idle = [context.idle] if context.idle else []
            methods[context.id] = facts.robot.reached(idle, {}, facts.declared.ends)
        owned = {m: m.rpartition("::")[0].split("::")[0] for m in reached}
        contexts[name] = replace(
            context,
            lines=lines,
            priority=next(iter(numbers)) if len(numbers) == 1 else None,
            methods=sorted(m for m, owner in owned.items() if owner in model.modules),
            first=first_methods(context, reached, model),
        )
    return replace(
        model,
        contexts=contexts,
        pipes=pipes_of(model, facts, methods),
        shared=shared_members(model, facts, methods),
    )


def first_methods(context: ExecutionContext, reached: Ways[str], model: Model) -> list[str]:
    """Returns the methods at which a context enters the modules. For a thread, this is the
    method of its command. For another context, these are the methods that its handlers call.
    Methods of builders are left out, because a builder only passes on a reference to a module."""
    if context.body:
        return [context.body]
    begin = [m for m, caller in reached.items() if caller in context.handlers]
    modules = {m: model.modules.get(m.partition("::")[0]) for m in begin}
    return [m for m, module in modules.items() if module and module.logic != "construction"]


def handler_lines(facts: Facts) -> dict[str, list[int]]:
    """Returns the numbers of the interrupt lines of each interrupt handler, from the vector table.
    This table consists of lists of handlers. For each list, a constant contains the interrupt line
    of the first handler, and each further handler has the next interrupt line.
    """
    lines: dict[str, list[int]] = {}
    for constant, handlers in _vectors(facts).items():
        for number, handler in enumerate(handlers):
            lines.setdefault(handler, []).append(facts.syntax.constants[constant] + number)
    return lines


def _vectors(facts: Facts) -> dict[str, list[str]]:
    """Returns the lists of handlers in the vector table. The key of a list is the name of the
    constant that contains the interrupt line of its first handler. Each further handler has the
    next interrupt line."""
    table: dict[str, list[str]] = {}
    for flow in facts.syntax.flows:
        if flow.into in facts.syntax.constants and flow.into.endswith("Line"):
            for source in flow.sources:
                word, _, name = source.partition(" ")
                if word == "function":
                    table.setdefault(flow.into, []).append(name)
    return table


def silent_lines(facts: Facts) -> dict[int, str]:
    """Returns a map from the number of an interrupt line to the name of its handler. An interrupt
    line is in the map if it is not enabled by a call in the firmware. Of each list of handlers in
    the vector table, only the first interrupt line is examined."""
    constants, enabled = facts.syntax.constants, _enabling(facts)
    return {
        constants[name]: handlers[0]
        for name, handlers in _vectors(facts).items()
        if constants[name] not in enabled
    }


def line_priorities(facts: Facts) -> dict[int, str]:
    """Returns a map from each interrupt line to the name of the constant with its priority. This
    constant is an argument of the call that enables the interrupt line."""
    priorities = _enabling(facts)
    # A loop in the firmware enables interrupt lines for which there is no constant. Such a line has
    # the same priority as the nearest interrupt line with a lower number and a known priority.
    for lines in handler_lines(facts).values():
        for line in lines:
            below = [first for first in priorities if first <= line]
            if line not in priorities and below:
                priorities[line] = priorities[max(below)]
    return priorities


def _enabling(facts: Facts) -> dict[int, str]:
    """Returns a map from the number of an interrupt line to the name of the constant with its
    priority. The map contains an interrupt line if a constant for its number is passed to
    ``K64Thread::enable``."""
    constants = facts.syntax.constants
    behind: dict[str, list[str]] = {}
    for flow in facts.syntax.flows:
        behind.setdefault(flow.into, []).extend(flow.sources)
    priorities: dict[int, str] = {}
    for body in facts.syntax.bodies:
        for call in body.calls:
            if call.target != ENABLE or len(call.args) != 2:
                continue
            values = [argument for argument in call.args[1] if argument in constants]
            named = [p for argument in call.args[0] for p in (argument, *behind.get(argument, []))]
            for line in [constants[constant] for constant in named if constant in constants]:
                for value in values:
                    priorities[line] = value
    return priorities


# ---- pipes ---------------------------------------------------------------------


def pipes_of(model: Model, facts: Facts, methods: Methods) -> list[SharedPipe]:
    """Returns all pipes of the robot. For each pipe, the result contains the methods that write or
    read the pipe, and the execution contexts that may execute each of these methods."""
    members = {
        member.name
        for places in facts.robot.known.values()
        for member in places
        if member.kind == PIPE
    }
    writers: dict[str, dict[str, list[str]]] = {name: {} for name in members}
    readers: dict[str, dict[str, list[str]]] = {name: {} for name in members}
    for body in facts.syntax.bodies:
        if not facts.robot.contains(body.place.file):
            continue
        for call in body.calls:
            owner, _, operation = call.target.rpartition("::")
            if owner != PIPE or operation not in ("write", *READS):
                continue
            for item in facts.robot.objects(call.on, PIPE):
                users = (writers if operation == "write" else readers)[item.name]
                for user in users_of(body, item, model, facts):
                    users[user] = [name for name, reached in methods.items() if user in reached]
    pipes: list[SharedPipe] = []
    for name in sorted(members):
        declared = facts.declared.pipes.get(name)
        place, kind = place_of(name, facts)
        title, says = (declared.name, declared.says) if declared else (name, "")
        pipes.append(SharedPipe(name, title, says, kind, place, writers[name], readers[name]))
    order = {name: number for number, name in enumerate(facts.declared.pipes)}
    return sorted(pipes, key=lambda pipe: order.get(pipe.id, len(order)))


def users_of(user: BodyFact, pipe: Object, model: Model, facts: Facts) -> list[str]:
    """Returns the methods to which the use of a pipe in the function ``user`` belongs. If ``user``
    is a method of a module, the result is this method. If ``user`` is a function outside classes,
    the result contains the functions in the same file that pass the pipe to ``user``."""
    if user.owner.split("::")[0] in model.modules:
        return [user.id]
    return sorted(
        body.id
        for body in facts.syntax.bodies
        if body.place.file == user.place.file
        for call in body.calls
        if call.target == user.id
        and any(pipe in facts.robot.objects(given, PIPE) for given in call.args)
    )


def place_of(name: str, facts: Facts) -> tuple[Place, str]:
    """Returns the place of the declaration of a variable or data member, and its type."""
    fact = facts.syntax.variables.get(name)
    if fact is None:
        owner, _, member = name.rpartition("::")
        fact = next(each for each in facts.classes[owner].fields if each.name == member)
    return fact.place, fact.type


# ---- members that contexts share --------------------------------------------------


def shared_members(model: Model, facts: Facts, methods: Methods) -> list[SharedMember]:
    """Returns the data members that one context changes and that another context reads or changes.

    A data member of a value type such as Velocity is left out. Instead, the result contains the
    member in which a module stores the value. References are left out, because they are set before
    the interrupts are enabled."""
    fields = {
        f"{fact.name}::{member.name}": member
        for fact in facts.syntax.classes
        for member in fact.fields
    }
    touched: dict[str, dict[str, bool]] = {}
    for name, reached in methods.items():
        for method in reached:
            owner, _, short = method.rpartition("::")
            if short == owner.rpartition("::")[2]:
                continue  # In a constructor, no other context can reach the object yet.
            for body in facts.robot.own_bodies(method):
                for member, changed in body.touches.items():
                    users = touched.setdefault(member, {})
                    users[name] = users.get(name, False) or changed
    members: list[SharedMember] = []
    for member, users in sorted(touched.items()):
        fact = fields.get(member)
        if fact is None or len(users) < 2 or not any(users.values()):
            continue
        if is_value(member, fact, model):
            continue
        members.append(shared_member(member, fact, users, facts))
    return members


def is_value(member: str, fact: FieldFact, model: Model) -> bool:
    owner = member.split("::", maxsplit=1)[0]
    module = model.modules.get(owner)
    return fact.refers or module is None or module.datatype


def shared_member(
    member: str, fact: FieldFact, users: dict[str, bool], facts: Facts
) -> SharedMember:
    owner = member.rpartition("::")[0]
    protections = facts.declared.protections
    declared = protections.get(member) or protections.get(f"{owner}::*")
    if declared is not None:
        protection, why = declared.protection, declared.why
    elif any(kind == PIPE for kind in fact.classes):
        protection = "pipe"
        why = "There is one writer and no lock. All readers run in the same interrupt or thread."
    else:
        protection, why = "", ""
    return SharedMember(
        id=member,
        module=member.split("::", maxsplit=1)[0],
        type=fact.type,
        place=fact.place,
        writers=[name for name, changed in users.items() if changed],
        readers=[name for name, changed in users.items() if not changed],
        protection=protection,
        why=why,
    )
