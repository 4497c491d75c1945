"""The structural clauses of the patterns, decided on the syntax tree.

A clause takes one application and yields the places where it does not hold.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from traceability.model.facts import Facts
from traceability.model.schema import PatternApplication, Place
from traceability.model.syntax import BodyFact, FieldFact, MethodFact

Broken = Iterator[tuple[Place, str]]


@dataclass
class Shape:
    """One application, with the questions that its clauses ask."""

    application: PatternApplication
    facts: Facts

    def playing(self, role: str) -> list[str]:
        return [item.module for item in self.application.roles if item.role == role]

    def place(self, module: str) -> Place:
        return self.facts.classes[module].place

    def derives(self, module: str, base: str) -> bool:
        return module in self.facts.heirs.get(base, [])

    def family(self, base: str) -> set[str]:
        return {base, *self.facts.heirs.get(base, [])}

    def methods(self, module: str) -> list[MethodFact]:
        return [method for method in self.facts.classes[module].methods if not method.deleted]

    def fields(self, module: str) -> list[FieldFact]:
        """The fields of a class and of the classes nested in it."""
        inner = f"{module}::"
        return [
            field
            for name, fact in self.facts.classes.items()
            if name == module or name.startswith(inner)
            for field in fact.fields
        ]

    def bodies(self, module: str) -> list[BodyFact]:
        inner = f"{module}::"
        return [
            body
            for body in self.facts.syntax.bodies
            if body.owner == module or body.owner.startswith(inner)
        ]

    def bases(self, module: str) -> list[str]:
        found = list(self.facts.classes[module].bases)
        return found + [upper for base in found for upper in self.bases(base)]

    def holds(self, module: str, base: str) -> bool:
        return any(field.refers and base in field.classes for field in self.fields(module))

    def is_given(self, module: str, base: str) -> bool:
        """A method of the class, own or inherited, takes or obtains a reference to the base."""
        marks = (f"{base}&", f"{base}*")
        for owner in (module, *self.bases(module)):
            for method in self.methods(owner):
                types = [kind for _, kind in method.params] + [method.result]
                if any(kind.removeprefix("const ") in marks for kind in types):
                    return True
        return False

    def named(self, by: str, targets: list[str]) -> Iterator[tuple[Place, str]]:
        for name in self.facts.syntax.names:
            target = name.target.split("::", maxsplit=1)[0]
            if name.by.split("::", maxsplit=1)[0] == by and target in targets and target != by:
                yield name.place, target

    def calls(self, module: str) -> Iterator[tuple[str, Place]]:
        """The methods that the bodies of a class call, as declared."""
        for body in self.bodies(module):
            for call in body.calls:
                yield call.target, call.place


def owner_of(method: str) -> str:
    return method.split("::", maxsplit=1)[0]


def abstract(role: str) -> Callable[[Shape], Broken]:
    def clause(shape: Shape) -> Broken:
        for module in shape.playing(role):
            if not shape.facts.classes[module].abstract:
                yield shape.place(module), f"{module} is not abstract"

    return clause


def derived(role: str, base_role: str) -> Callable[[Shape], Broken]:
    def clause(shape: Shape) -> Broken:
        for module in shape.playing(role):
            for base in shape.playing(base_role):
                if module != base and not shape.derives(module, base):
                    yield shape.place(module), f"{module} does not derive from {base}"

    return clause


def held(role: str) -> Callable[[Shape], Broken]:
    def clause(shape: Shape) -> Broken:
        for context in shape.playing("Context"):
            for base in shape.playing(role):
                if not shape.holds(context, base) and not shape.is_given(context, base):
                    yield shape.place(context), f"{context} neither holds {base} nor is given it"

    return clause


def unnamed(role: str, concrete: str) -> Callable[[Shape], Broken]:
    def clause(shape: Shape) -> Broken:
        for module in shape.playing(role):
            for place, target in shape.named(module, shape.playing(concrete)):
                yield place, f"{module} names {target}"

    return clause


def state_called(shape: Shape) -> Broken:
    concrete = shape.playing("Concrete State")
    for base in shape.playing("State"):
        callers = 0
        for context in shape.playing("Context"):
            for target, place in shape.calls(context):
                if owner_of(target) in concrete and owner_of(target) != context:
                    yield place, f"{context} calls {target}, which is not the abstraction"
                callers += owner_of(target) == base
            callers += sum(
                owner_of(target) == base
                for upper in shape.bases(context)
                for target, _ in shape.calls(upper)
            )
        if not callers and shape.playing("Context"):
            context = shape.playing("Context")[0]
            yield shape.place(context), f"no Context calls {base}"


def state_change(shape: Shape) -> Broken:
    """The field of the Context that refers to the State is assigned by one operation."""
    for base in shape.playing("State"):
        states = shape.family(base)
        for context in shape.playing("Context"):
            fields = {
                f"{context}::{field.name}"
                for field in shape.fields(context)
                if field.refers and not field.static and field.classes == [base]
            }
            changers: dict[str, Place] = {}
            for body in shape.facts.syntax.bodies:
                for name, line in body.assigns:
                    constructor = body.id == f"{body.owner}::{body.owner}"
                    if name in fields and not constructor:
                        changers.setdefault(body.id, Place(body.place.file, line))
            if fields and not changers and context not in states:
                yield shape.place(context), f"no operation of {context} changes the {base}"
            for method, place in list(changers.items())[1:]:
                yield place, f"{method} also changes the {base}"
            allowed = {context, *states}
            for body in shape.facts.syntax.bodies:
                for call in body.calls:
                    if call.target in changers and owner_of(body.id) not in allowed:
                        yield call.place, f"{body.id} changes the {base} from outside"


def decorator_holds(shape: Shape) -> Broken:
    for decorator in shape.playing("Decorator"):
        for component in shape.playing("Component"):
            if not shape.holds(decorator, component):
                yield shape.place(decorator), f"{decorator} holds no {component}"


def decorator_forwards(shape: Shape) -> Broken:
    components = set(shape.playing("Component"))
    decorators = set(shape.playing("Decorator"))
    for module in [*decorators, *shape.playing("Concrete Decorator")]:
        wrapped = components | (decorators - {module})
        overriding = [body for body in shape.bodies(module) if body.overrides]
        silent = [
            body
            for body in overriding
            if not any(
                owner_of(call.target) in wrapped
                and call.target.rsplit("::", 1)[-1] == body.id.rsplit("::", 1)[-1]
                for call in body.calls
            )
        ]
        if module in decorators:
            for body in silent:
                yield body.place, f"{body.id} does not forward to the component"
        elif len(silent) == len(overriding):
            yield shape.place(module), f"no operation of {module} forwards to the component"


def template_methods(shape: Shape, module: str) -> dict[str, set[str]]:
    """Non-virtual method -> the virtual methods of the same class that it calls."""
    virtual = {method.id for method in shape.methods(module) if method.virtual}
    plain = {method.id for method in shape.methods(module) if not method.virtual}
    found: dict[str, set[str]] = {}
    for body in shape.bodies(module):
        primitives = {call.target for call in body.calls if call.target in virtual}
        if body.id in plain and primitives:
            found.setdefault(body.id, set()).update(primitives)
    return found


def template_nonvirtual(shape: Shape) -> Broken:
    for module in shape.playing("Abstract Class"):
        if not template_methods(shape, module):
            yield (
                shape.place(module),
                f"{module} has no non-virtual method that calls its primitives",
            )


def template_primitives(shape: Shape) -> Broken:
    for module in shape.playing("Abstract Class"):
        pure = {method.id for method in shape.methods(module) if method.pure}
        called = set().union(*template_methods(shape, module).values()) & pure
        for heir in shape.playing("Concrete Class"):
            owners = {heir, *shape.bases(heir)} - {module}
            for primitive in sorted(called):
                overriders = shape.facts.overriders.get(primitive, [])
                if shape.derives(heir, module) and not owners & {owner_of(m) for m in overriders}:
                    yield shape.place(heir), f"{heir} does not override {primitive}"


def template_overrides(shape: Shape) -> Broken:
    for module in shape.playing("Abstract Class"):
        names = {method.rsplit("::", 1)[-1] for method in template_methods(shape, module)}
        for heir in shape.playing("Concrete Class"):
            for method in shape.methods(heir):
                if method.name in names:
                    yield method.place, f"{method.id} hides the template method of {module}"


def command_single(shape: Shape) -> Broken:
    for module in shape.playing("Command"):
        operations = [
            method
            for method in shape.methods(module)
            if method.access == "public"
            and method.kind != "constructor"
            and not method.name.startswith(("~", "operator"))
        ]
        if len(operations) != 1 or not operations[0].pure:
            yield shape.place(module), f"{module} does not have one operation, which is pure"


def command_invoker(shape: Shape) -> Broken:
    hidden = shape.playing("Concrete Command") + shape.playing("Receiver")
    for invoker in shape.playing("Invoker"):
        for place, target in shape.named(invoker, hidden):
            yield place, f"{invoker} names {target}"
        commands = shape.playing("Command")
        if commands and not any(owner_of(target) in commands for target, _ in shape.calls(invoker)):
            yield shape.place(invoker), f"{invoker} does not call {', '.join(commands)}"


def command_receiver(shape: Shape) -> Broken:
    receivers = shape.playing("Receiver")
    for command in shape.playing("Concrete Command"):
        if receivers and not any(owner_of(name) in receivers for name, _ in shape.calls(command)):
            yield shape.place(command), f"{command} calls no {' or '.join(receivers)}"


def makes(shape: Shape, module: str, product: str) -> bool:
    return any(
        product in field.classes and not field.refers for field in shape.fields(module)
    ) or any(
        name.how == "construct" and name.target == product and owner_of(name.by) == module
        for name in shape.facts.syntax.names
    )


def command_client(shape: Shape) -> Broken:
    for client in shape.playing("Client"):
        made = [name for name in shape.playing("Concrete Command") if makes(shape, client, name)]
        if not made:
            yield shape.place(client), f"{client} makes no Concrete Command"


def builder_constructs(shape: Shape) -> Broken:
    builders = shape.playing("Concrete Builder")
    for product in shape.playing("Product"):
        for builder in builders:
            if not makes(shape, builder, product):
                yield shape.place(builder), f"{builder} does not construct {product}"
        for fact in shape.facts.syntax.names:
            maker = owner_of(fact.by)
            outside = maker not in builders and maker not in shape.family(product)
            if fact.how == "construct" and fact.target == product and outside:
                yield fact.place, f"{maker or 'a function'} constructs {product}"
        for name, other in shape.facts.classes.items():
            if owner_of(name) in builders or owner_of(name) == product:
                continue
            for field in other.fields:
                if product in field.classes and not field.refers:
                    yield field.place, f"{owner_of(name)} holds a {product} of its own"


def builder_director(shape: Shape) -> Broken:
    builders = shape.playing("Builder")
    products = shape.playing("Product")
    for director in shape.playing("Director"):
        if not any(owner_of(target) in builders for target, _ in shape.calls(director)):
            yield shape.place(director), f"{director} does not call {', '.join(builders)}"
        for target, place in shape.calls(director):
            if owner_of(target) in products:
                yield place, f"{director} calls {target}"


def singleton_one(shape: Shape) -> Broken:
    for module in shape.playing("Singleton"):
        instances = [
            field
            for field in shape.facts.classes[module].fields
            if field.static and module in field.type
        ]
        gives = [
            method
            for method in shape.methods(module)
            if method.kind == "static" and method.result.removeprefix("const ") == f"{module}&"
        ]
        if not gives or len(instances) > 1:
            yield shape.place(module), f"{module} does not give its one instance"


def singleton_constructor(shape: Shape) -> Broken:
    for module in shape.playing("Singleton"):
        constructors = [item for item in shape.methods(module) if item.kind == "constructor"]
        if not constructors:
            yield shape.place(module), f"{module} has the public constructor of the compiler"
        for method in constructors:
            if method.access == "public":
                yield method.place, f"a constructor of {module} is public"


def singleton_copy(shape: Shape) -> Broken:
    for module in shape.playing("Singleton"):
        deleted = [item for item in shape.facts.classes[module].methods if item.deleted]
        copies = [kind == f"const {module}&" for m in deleted for _, kind in m.params]
        if sum(copies) < 2:
            yield shape.place(module), f"{module} can be copied"


def together(*clauses: Callable[[Shape], Broken]) -> Callable[[Shape], Broken]:
    def clause(shape: Shape) -> Broken:
        for one in clauses:
            yield from one(shape)

    return clause


CLAUSES: dict[str, Callable[[Shape], Broken]] = {
    "pattern-state-abstract": abstract("State"),
    "pattern-state-derives": derived("Concrete State", "State"),
    "pattern-state-held": held("State"),
    "pattern-state-called": state_called,
    "pattern-state-successor": unnamed("Concrete State", "Concrete State"),
    "pattern-state-change": state_change,
    "pattern-strategy-abstract": abstract("Strategy"),
    "pattern-strategy-derives": derived("Concrete Strategy", "Strategy"),
    "pattern-strategy-held": held("Strategy"),
    "pattern-strategy-unnamed": unnamed("Context", "Concrete Strategy"),
    "pattern-decorator-component": together(
        abstract("Component"),
        derived("Decorator", "Component"),
        derived("Concrete Component", "Component"),
        derived("Concrete Decorator", "Decorator"),
    ),
    "pattern-decorator-holds": decorator_holds,
    "pattern-decorator-forwards": decorator_forwards,
    "pattern-template-nonvirtual": template_nonvirtual,
    "pattern-template-derives": derived("Concrete Class", "Abstract Class"),
    "pattern-template-primitives": template_primitives,
    "pattern-template-overrides": template_overrides,
    "pattern-command-single": together(abstract("Command"), command_single),
    "pattern-command-derives": derived("Concrete Command", "Command"),
    "pattern-command-invoker": command_invoker,
    "pattern-command-receiver": command_receiver,
    "pattern-command-client": command_client,
    "pattern-builder-derives": derived("Concrete Builder", "Builder"),
    "pattern-builder-constructs": builder_constructs,
    "pattern-builder-director": builder_director,
    "pattern-singleton-one": singleton_one,
    "pattern-singleton-constructor": singleton_constructor,
    "pattern-singleton-copy": singleton_copy,
    "pattern-serializer-abstractions": together(
        unnamed("Concrete Element", "Concrete Reader"),
        unnamed("Concrete Element", "Concrete Writer"),
    ),
    "pattern-serializer-derives": together(
        abstract("Serializable"),
        abstract("Reader"),
        abstract("Writer"),
        derived("Concrete Reader", "Reader"),
        derived("Concrete Writer", "Writer"),
        derived("Concrete Element", "Serializable"),
    ),
}
