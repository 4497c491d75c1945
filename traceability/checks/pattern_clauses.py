"""The functions that check the clauses of the patterns in the syntax tree. A clause is a rule about
the structure of the code.

The function of a clause receives one pattern application. It yields each place at which the code
violates the clause, with a text.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from traceability.reading.ast_facts import ANY_CLASS, BodyFact, CallFact, FieldFact, MethodFact
from traceability.reading.graphs import descendants
from traceability.reading.source_facts import Facts
from traceability.schema import PatternApplication, Place

Broken = Iterator[tuple[Place, str]]


@dataclass
class Shape:
    """A pattern application, with queries about its code for the functions of the clauses."""

    application: PatternApplication
    facts: Facts

    @property
    def replaced(self) -> list[str]:
        """Returns the operations that the decorators implement without a call of the component. In
        each remaining operation, a decorator calls the component and adds something."""
        declared = self.facts.declared.applications.get(self.application.id)
        return declared.replaces if declared else []

    @property
    def declared_at(self) -> Place:
        """Returns the place of the key `replaces` in design/applications.toml."""
        declared = self.facts.declared.applications.get(self.application.id)
        place = declared.place if declared else self.application.place
        return self.facts.line_in(place, "replaces")

    def playing(self, role: str) -> list[str]:
        return [item.module for item in self.application.roles if item.role == role]

    def any_with(self, role: str) -> str:
        """Returns a text that names the modules with a role. If no module has the role, the text
        names the role."""
        return " or ".join(self.playing(role)) or f"module with the role {role}"

    def place(self, module: str) -> Place:
        return self.facts.classes[module].place

    def derives(self, module: str, base: str) -> bool:
        return module in self.facts.subclasses.get(base, [])

    def family(self, base: str) -> set[str]:
        return {base, *self.facts.subclasses.get(base, [])}

    def methods(self, module: str) -> list[MethodFact]:
        return [method for method in self.facts.classes[module].methods if not method.deleted]

    def fields(self, module: str) -> list[FieldFact]:
        """Returns the data members of a class and of its nested classes."""
        inner = f"{module}::"
        return [
            field
            for name, fact in self.facts.classes.items()
            if name == module or name.startswith(inner)
            for field in fact.fields
        ]

    def bodies(self, module: str) -> list[BodyFact]:
        """Returns the bodies of all functions in the files of a class: its methods, the methods of
        its nested classes, and free functions."""
        return self.facts.bodies_of.get(module, [])

    def user(self, body: BodyFact) -> str:
        return self.facts.user(body.owner, body.place)

    def bases(self, module: str) -> list[str]:
        above = list(self.facts.classes[module].bases)
        return above + [upper for base in above for upper in self.bases(base)]

    def holds(self, module: str, base: str) -> bool:
        return any(
            field.refers and not field.static and base in field.classes
            for field in self.fields(module)
        )

    def is_given(self, module: str, base: str) -> bool:
        """Returns whether a method of the class, or an inherited method, has a parameter or a
        result that is a reference or a pointer to the base class."""
        marks = (f"{base}&", f"{base}*")
        for owner in (module, *self.bases(module)):
            for method in self.methods(owner):
                types = [kind for _, kind in method.params] + [method.result]
                if any(kind.removeprefix("const ") in marks for kind in types):
                    return True
        return False

    def named(self, by: str, targets: list[str]) -> Iterator[tuple[Place, str]]:
        """Yields each place at which the code of a class contains the name of a target class or
        includes the header of a target class. Yields the target class with each place."""
        for place, target in self.facts.named_by(by):
            if target in targets and target != by:
                yield place, target

    def marks(self, module: str) -> set[tuple[str, str]]:
        """Returns the enumerators in the code of a class. Each result is a pair of enumeration and
        enumerator."""
        return {
            (name.target, name.member)
            for name in self.facts.names_of.get(module, [])
            if name.member and self.facts.kind_of(name.target) == "enum"
        }

    def calls(self, module: str) -> Iterator[tuple[str, Place]]:
        """Yields the calls in the code of a class. Each call has the name of the called method as
        declared, and the place of the call."""
        for body in self.bodies(module):
            for call in body.calls:
                yield call.target, call.place

    def calls_from(self, method: str, module: str) -> set[str]:
        """Returns all methods that a method calls, directly or through other functions of the same
        class."""
        own = {body.id: {call.target for call in body.calls} for body in self.bodies(module)}
        return descendants(method, own)


def owner_of(method: str) -> str:
    return method.split("::", maxsplit=1)[0]


def last_of(method: str) -> str:
    return method.rsplit("::", 1)[-1]


def abstract(role: str) -> Callable[[Shape], Broken]:
    def clause(shape: Shape) -> Broken:
        for module in shape.playing(role):
            if not shape.facts.classes[module].abstract:
                yield shape.place(module), f"{module} is not abstract"

    return clause


def only_base(shape: Shape) -> Broken:
    for module in shape.playing("Serializable"):
        if not shape.facts.classes[module].only_base:
            text = f"{module} is not abstract, and an object of it can be constructed"
            yield shape.place(module), text


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
                    text = f"{context} has no member or parameter of the type {base}"
                    yield shape.place(context), text

    return clause


def unnamed(roles: tuple[str, ...], *concrete: str) -> Callable[[Shape], Broken]:
    """Finds modules that have one of the roles ``roles`` and whose code names a module with one of
    the roles ``concrete``."""

    def clause(shape: Shape) -> Broken:
        hidden = [module for role in concrete for module in shape.playing(role)]
        for role in roles:
            for module in shape.playing(role):
                yield from named(shape, module, hidden)

    return clause


def named(shape: Shape, module: str, hidden: list[str]) -> Broken:
    for place, target in shape.named(module, hidden):
        yield place, f"{module} names {target}"


def state_unmarked(shape: Shape) -> Broken:
    """Finds each Context that could detect a state by an enumerator: the Context uses an enumerator
    that only one of the states uses."""
    states = shape.playing("Concrete State")
    marks = [mark for state in states for mark in shape.marks(state)]
    own = {mark: state for state in states for mark in shape.marks(state) if marks.count(mark) == 1}
    for context in shape.playing("Context"):
        for name in shape.facts.names_of.get(context, []):
            state = own.get((name.target, name.member))
            # True if another class in the same file uses the enumerator.
            beside = owner_of(name.by) not in ("", context)
            if state and context not in states and not beside:
                mark = f"{name.target}::{name.member}"
                yield name.place, f"{context} uses the enumerator of {state}: {mark}"
    yield from state_unasked(shape, {target for target, _ in own})


def state_unasked(shape: Shape, enumerations: set[str]) -> Broken:
    """Finds a Context that tries to detect its present state: the Context compares the address of a
    state, or has a branch on the enumerator of a state."""
    states = {name for base in shape.playing("State") for name in shape.family(base)}
    contexts = set(shape.playing("Context")) - states
    for branch in shape.facts.syntax.branches:
        if branch.by in contexts and branch.target in states:
            yield branch.place, f"{branch.by} compares the address of an object of {branch.target}"
        elif branch.by in contexts and branch.target in enumerations:
            yield branch.place, f"{branch.by} branches on an enumerator of {branch.target}"
    yield from state_addresses(shape, contexts)


def state_addresses(shape: Shape, contexts: set[str]) -> Broken:
    """Finds a Context that takes the address of its present state. The Context could compare this
    address later to detect the state."""
    bases = shape.playing("State")
    for body in shape.facts.syntax.bodies:
        if body.owner not in contexts:
            continue
        members = [
            field.name
            for field in shape.fields(body.owner)
            if field.refers and field.classes == bases
        ]
        lines = shape.facts.lines_of(body.place.file)
        for number in range(body.place.line, body.end + 1):
            if any(re.search(rf"&\s*{name}\.get\(\)", lines[number - 1]) for name in members):
                text = f"{body.owner} takes the address of its present {bases[0]}"
                yield Place(body.place.file, number), text


def called(role: str) -> Callable[[Shape], Broken]:
    """Finds Contexts that never call the abstract class with this role. A call in an inherited
    method of the Context is sufficient."""

    def clause(shape: Shape) -> Broken:
        for base in shape.playing(role):
            for context in shape.playing("Context"):
                targets = (
                    target
                    for upper in (context, *shape.bases(context))
                    for target, _ in shape.calls(upper)
                )
                if not any(owner_of(target) == base for target in targets):
                    yield shape.place(context), f"{context} does not call {base}"

    return clause


def state_change(shape: Shape) -> Broken:
    """Finds a Context in which no operation or several operations change the present state. Exactly
    one operation must assign the member that refers to the State."""
    for base in shape.playing("State"):
        states = shape.family(base)
        for context in shape.playing("Context"):
            fields = {
                f"{context}::{field.name}"
                for field in shape.fields(context)
                if field.refers and not field.static and field.classes == [base]
            }
            changers = {
                body.id: Place(body.place.file, line)
                for body in shape.facts.syntax.bodies
                for name, line in body.assigns
                if name in fields and body.id != f"{body.owner}::{body.owner}"
            }
            if fields and not changers and context not in states:
                yield shape.place(context), f"no operation of {context} changes the {base}"
            operation = change_operation(shape, states, context, changers)
            for method, place in changers.items():
                if method != operation:
                    yield place, f"{method} also changes the {base}"
            yield from changed_outside(shape, {context, *states}, operation, base)


def change_operation(
    shape: Shape, states: set[str], context: str, changers: dict[str, Place]
) -> str:
    """The states call an operation of the Context to change its state. Returns this operation. If
    no state calls such an operation, returns the first operation of the Context that changes the
    state."""
    by_states = {target for state in states for target, _ in shape.calls(state)}
    own = [method for method in changers if owner_of(method) == context]
    return next((m for m in own if m in by_states), next(iter(own), ""))


def changed_outside(shape: Shape, allowed: set[str], operation: str, base: str) -> Broken:
    unresolved = f"{ANY_CLASS}::{last_of(operation)}"
    for body in shape.facts.syntax.bodies:
        for call in body.calls:
            if call.target in (operation, unresolved) and shape.user(body) not in allowed:
                text = (
                    f"{body.id} changes {base}, but belongs neither to the Context nor to a state"
                )
                yield call.place, text


def decorator_holds(shape: Shape) -> Broken:
    for decorator in shape.playing("Decorator"):
        for component in shape.playing("Component"):
            if not shape.holds(decorator, component):
                yield shape.place(decorator), f"{decorator} has no member of type {component}"


def on_wrapped(call: CallFact, decorators: set[str]) -> bool:
    """Returns whether a decorator makes this call on the component that it decorates. No other
    member of the decorator has the type of the component."""
    return all(
        place.startswith("this ") or owner_of(place.split()[1]) in decorators for place in call.on
    )


def forwards(body: BodyFact, wrapped: set[str], decorators: set[str]) -> bool:
    return any(
        owner_of(call.target) in wrapped
        and last_of(call.target) == last_of(body.id)
        and on_wrapped(call, decorators)
        for call in body.calls
    )


def operations_of(shape: Shape, components: set[str]) -> set[str]:
    return {
        method.name
        for component in components
        for method in shape.methods(component)
        if method.virtual and "~" not in method.name
    }


def decorator_forwards(shape: Shape) -> Broken:
    components = set(shape.playing("Component"))
    decorators = set(shape.playing("Decorator"))
    replaced: set[str] = set()
    for module in [*decorators, *shape.playing("Concrete Decorator")]:
        wrapped = components | (decorators - {module})
        overriding = [body for body in shape.bodies(module) if body.overrides]
        if module in decorators:
            own = {last_of(body.id) for body in overriding}
            for operation in sorted(operations_of(shape, components) - own - set(shape.replaced)):
                yield shape.place(module), f"{module} does not forward {operation}"
        for body in overriding:
            if forwards(body, wrapped, decorators):
                continue
            if last_of(body.id) in shape.replaced:
                replaced.add(last_of(body.id))
            else:
                yield body.place, f"{body.id} does not forward to the component"
        extending = [body for body in overriding if last_of(body.id) not in shape.replaced]
        if not extending and module not in decorators:
            yield shape.place(module), f"{module} extends no operation"
    for name in sorted(set(shape.replaced) - replaced):
        text = f"no decorator replaces {name}, but the design lists it as replaced"
        yield shape.declared_at, text


def primitives_called(shape: Shape, module: str) -> dict[str, set[str]]:
    """For each method, returns the called virtual methods of the same class."""
    virtual = {method.id for method in shape.methods(module) if method.virtual}
    return {
        body.id: primitives
        for body in shape.bodies(module)
        if (primitives := {call.target for call in body.calls if call.target in virtual})
    }


def template_methods(shape: Shape, module: str) -> dict[str, set[str]]:
    """Returns the template methods of a class: the methods that are not virtual and that call
    virtual methods of the same class."""
    plain = {method.id for method in shape.methods(module) if not method.virtual}
    return {m: called for m, called in primitives_called(shape, module).items() if m in plain}


def template_nonvirtual(shape: Shape) -> Broken:
    for module in shape.playing("Abstract Class"):
        plain = template_methods(shape, module)
        if not plain:
            text = f"{module} needs a template method: a non-virtual method that calls primitives"
            yield shape.place(module), text
        for method in shape.methods(module):
            if method.virtual and method.id in primitives_called(shape, module):
                yield method.place, f"{method.id} calls primitives, but is virtual"
        called = set().union(*plain.values())
        for method in shape.methods(module):
            if plain and method.virtual and method.access != "public" and method.id not in called:
                yield method.place, f"no template method calls the primitive {method.id}"


def template_primitives(shape: Shape) -> Broken:
    for module in shape.playing("Abstract Class"):
        pure = {method.id for method in shape.methods(module) if method.pure}
        called = set().union(*template_methods(shape, module).values()) & pure
        for subclass in shape.playing("Concrete Class"):
            owners = {subclass, *shape.bases(subclass)} - {module}
            for primitive in sorted(called):
                overriders = {owner_of(m) for m in shape.facts.overriders.get(primitive, [])}
                if shape.derives(subclass, module) and not owners & overriders:
                    yield shape.place(subclass), f"{subclass} does not override {primitive}"


def template_overrides(shape: Shape) -> Broken:
    for module in shape.playing("Abstract Class"):
        names = {last_of(method) for method in template_methods(shape, module)}
        for subclass in shape.playing("Concrete Class"):
            for method in shape.methods(subclass):
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
            yield shape.place(module), f"{module} does not have exactly one pure virtual operation"


def command_invoker(shape: Shape) -> Broken:
    hidden = shape.playing("Concrete Command") + shape.playing("Receiver")
    commands = shape.playing("Command")
    for module in dict.fromkeys([*commands, *shape.playing("Invoker")]):
        yield from named(shape, module, hidden)
    for invoker in shape.playing("Invoker"):
        calls = [
            call
            for body in shape.bodies(invoker)
            for call in body.calls
            if owner_of(call.target) in commands
        ]
        if commands and not calls:
            yield shape.place(invoker), f"{invoker} does not call {', '.join(commands)}"
        elif calls and not executed(shape, calls):
            concrete = shape.any_with("Concrete Command")
            yield shape.place(invoker), f"{invoker} receives no {concrete} that it can execute"


def executed(shape: Shape, calls: list[CallFact]) -> bool:
    """Returns whether one of the calls executes a Concrete Command of this pattern application. A
    call of an abstract Command counts if a builder passed a Concrete Command to the caller."""
    targets = {owner_of(name) for call in calls for name in shape.facts.references.targets(call)}
    return not targets.isdisjoint(shape.playing("Concrete Command"))


def command_receiver(shape: Shape) -> Broken:
    """Finds Concrete Commands that call no Receiver. Also finds Receivers that no Concrete Command
    calls."""
    receivers = shape.playing("Receiver")
    reached: set[str] = set()
    for command in shape.playing("Concrete Command"):
        operations = [body.id for body in shape.bodies(command) if body.overrides]
        targets = {
            owner_of(target)
            for operation in operations
            for target in shape.calls_from(operation, command)
        }
        reached |= targets
        if receivers and not targets.intersection(receivers):
            text = f"the operation of {command} calls no {' or '.join(receivers)}"
            yield shape.place(command), text
    for receiver in receivers:
        if reached and receiver not in reached:
            yield shape.place(receiver), f"no Concrete Command calls {receiver}"


def makes(shape: Shape, module: str, product: str) -> bool:
    fields = (field for field in shape.fields(module) if not field.refers)
    names = (n for n in shape.facts.names_of.get(module, []) if n.how == "construct")
    return any(product in f.classes for f in fields) or any(n.target == product for n in names)


def command_client(shape: Shape) -> Broken:
    clients = shape.playing("Client")
    for command in shape.playing("Concrete Command"):
        if clients and not any(makes(shape, client, command) for client in clients):
            yield shape.place(clients[0]), f"{' and '.join(clients)} construct no {command}"


def makers(shape: Shape, product: str) -> Iterator[tuple[Place, str]]:
    """Yields each place that constructs an object of a class, and the class that contains this
    place. The name of this class is "" if the place is in a composition."""
    for fact in shape.facts.syntax.names:
        if fact.how == "construct" and fact.target == product:
            yield fact.place, shape.facts.user(fact.by, fact.place)
    for name, other in shape.facts.classes.items():
        for field in other.fields:
            if product in field.classes and not field.refers:
                yield field.place, owner_of(name)


def builder_constructs(shape: Shape) -> Broken:
    builders = shape.playing("Concrete Builder")
    for product in shape.playing("Product"):
        for builder in builders:
            if not makes(shape, builder, product) and not passes_steps_on(shape, builder):
                yield shape.place(builder), f"{builder} does not construct {product}"
        for place, maker in makers(shape, product):
            if maker not in builders and maker not in shape.family(product):
                yield place, f"{maker or 'a function'} constructs a {product}"


def passes_steps_on(shape: Shape, builder: str) -> bool:
    """Returns whether a Concrete Builder calls a build step of the abstract Builder. The builder
    then need not construct the objects itself, because other builders implement the build step."""
    abstract = shape.playing("Builder")
    return builder not in abstract and any(
        owner_of(target) in abstract for target, _ in shape.calls(builder)
    )


def builder_parts(shape: Shape) -> Broken:
    """Finds objects that only a builder may construct, but that another module constructs."""
    builders = shape.playing("Concrete Builder")
    for part in sorted(parts_of(shape, builders)):
        for place, maker in makers(shape, part):
            if maker in shape.facts.modules - shape.facts.builders:
                yield place, f"{maker} constructs a {part}, but only {builders[0]} may construct it"


def parts_of(shape: Shape, builders: list[str]) -> set[str]:
    """Returns the modules that the builders contain as members by value and that have a role in a
    pattern. The Products are left out."""
    parts = {
        name
        for builder in builders
        for field in shape.fields(builder)
        if not field.refers
        for name in field.classes
    }
    return parts & shape.facts.with_role - set(shape.playing("Product"))


def builder_director(shape: Shape) -> Broken:
    """Finds Directors that do not call the Builder, that name a class which they must not use, or
    that call a method of an object that the builders construct. Also finds Builders that name a
    Concrete Builder."""
    builders = shape.playing("Builder")
    products = shape.playing("Product")
    concrete = shape.playing("Concrete Builder")
    built = {*products, *parts_of(shape, concrete)}
    for builder in builders:
        yield from named(shape, builder, concrete)
    for director in shape.playing("Director"):
        yield from named(shape, director, unknown_to(shape, director))
        if not any(owner_of(target) in builders for target, _ in shape.calls(director)):
            yield shape.place(director), f"{director} calls no {shape.any_with('Builder')}"
        for target, place in shape.calls(director):
            owner = owner_of(target)
            if owner in built and last_of(target) != owner:
                yield place, f"{director} calls {target}"


def unknown_to(shape: Shape, director: str) -> list[str]:
    """Returns the classes that a Director must not name: the Products and the Concrete Builders.
    Abstract Builders are permitted. If the Director is itself a Concrete Builder of an application,
    the classes of this application are permitted too."""
    applications = shape.facts.declared.applications.values()
    bound = [item.roles for item in applications if item.pattern == shape.application.pattern]
    bound.append({role: shape.playing(role) for role in ("Builder", "Concrete Builder", "Product")})
    builders = {name for roles in bound for name in roles.get("Builder", [])}
    made = {
        name
        for roles in bound
        for name in [*roles.get("Product", []), *roles.get("Concrete Builder", [])]
        if director not in roles.get("Concrete Builder", [])
    }
    return sorted(made - builders)


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
            yield shape.place(module), f"{module} does not return its only instance"
        for subclass in shape.facts.subclasses.get(module, []):
            yield shape.place(subclass), f"each object of {subclass} is a second object of {module}"
        for body in shape.facts.syntax.bodies:
            made = [call.place for call in body.calls if call.target == f"{module}::{module}"]
            if body.id not in {method.id for method in gives[:1]}:
                for place in made:
                    yield place, f"{body.id} constructs a second object of {module}"


def singleton_constructor(shape: Shape) -> Broken:
    for module in shape.playing("Singleton"):
        constructors = [item for item in shape.methods(module) if item.kind == "constructor"]
        if not constructors:
            text = "has no declared constructor, so the compiler adds a public constructor"
            yield shape.place(module), f"{module} {text}"
        for method in constructors:
            if method.access != "private":
                yield method.place, f"a constructor of {module} is {method.access}"
        for friend in shape.facts.syntax.friends:
            if friend.by == module:
                yield friend.place, f"{friend.target} can construct {module}"


def singleton_copy(shape: Shape) -> Broken:
    for module in shape.playing("Singleton"):
        deleted = [item for item in shape.facts.classes[module].methods if item.deleted]
        copies = [kind == f"const {module}&" for m in deleted for _, kind in m.params]
        if sum(copies) < 2:
            yield shape.place(module), f"{module} can be copied"
        for method in shape.methods(module):
            if any(kind == f"{module}&&" for _, kind in method.params):
                yield method.place, f"{module} can be moved"


def serializer_used(shape: Shape) -> Broken:
    """Finds operations of a Concrete Element that call neither a Reader nor a Writer."""
    abstractions = shape.playing("Reader") + shape.playing("Writer")
    for element in shape.playing("Concrete Element"):
        operations = [body for body in shape.bodies(element) if body.overrides]
        if not operations:
            yield shape.place(element), f"{element} declares no operation"
        for body in operations:
            owners = {owner_of(target) for target in shape.calls_from(body.id, element)}
            if not owners.intersection(abstractions):
                called = " or ".join(abstractions) or "module with the role Reader or Writer"
                yield body.place, f"{body.id} calls no {called}"


def together(*clauses: Callable[[Shape], Broken]) -> Callable[[Shape], Broken]:
    def clause(shape: Shape) -> Broken:
        for clause in clauses:
            yield from clause(shape)

    return clause


CLAUSES: dict[str, Callable[[Shape], Broken]] = {
    "pattern-state-abstract": abstract("State"),
    "pattern-state-derives": derived("Concrete State", "State"),
    "pattern-state-held": held("State"),
    "pattern-state-called": called("State"),
    "pattern-state-unnamed": together(unnamed(("Context",), "Concrete State"), state_unmarked),
    "pattern-state-successor": unnamed(("State", "Concrete State"), "Concrete State"),
    "pattern-state-change": state_change,
    "pattern-strategy-abstract": abstract("Strategy"),
    "pattern-strategy-derives": derived("Concrete Strategy", "Strategy"),
    "pattern-strategy-held": held("Strategy"),
    "pattern-strategy-called": called("Strategy"),
    "pattern-strategy-unnamed": unnamed(("Context", "Strategy"), "Concrete Strategy"),
    "pattern-decorator-component": together(
        abstract("Component"),
        derived("Decorator", "Component"),
        derived("Concrete Component", "Component"),
        derived("Concrete Decorator", "Decorator"),
    ),
    "pattern-decorator-holds": decorator_holds,
    "pattern-decorator-unnamed": unnamed(
        ("Component", "Decorator", "Concrete Component", "Concrete Decorator"),
        *("Concrete Component", "Concrete Decorator"),
    ),
    "pattern-decorator-forwards": decorator_forwards,
    "pattern-template-nonvirtual": template_nonvirtual,
    "pattern-template-derives": derived("Concrete Class", "Abstract Class"),
    "pattern-template-unnamed": unnamed(("Abstract Class", "Concrete Class"), "Concrete Class"),
    "pattern-template-primitives": template_primitives,
    "pattern-template-overrides": template_overrides,
    "pattern-command-single": together(abstract("Command"), command_single),
    "pattern-command-derives": derived("Concrete Command", "Command"),
    "pattern-command-invoker": command_invoker,
    "pattern-command-receiver": command_receiver,
    "pattern-command-client": command_client,
    "pattern-builder-derives": derived("Concrete Builder", "Builder"),
    "pattern-builder-constructs": builder_constructs,
    "pattern-builder-parts": builder_parts,
    "pattern-builder-director": builder_director,
    "pattern-singleton-one": singleton_one,
    "pattern-singleton-constructor": singleton_constructor,
    "pattern-singleton-copy": singleton_copy,
    "pattern-serializer-abstractions": unnamed(
        ("Concrete Element", "Serializable", "Reader", "Writer"),
        *("Concrete Reader", "Concrete Writer"),
    ),
    "pattern-serializer-used": serializer_used,
    "pattern-serializer-derives": together(
        only_base,
        abstract("Reader"),
        abstract("Writer"),
        derived("Concrete Reader", "Reader"),
        derived("Concrete Writer", "Writer"),
        derived("Concrete Element", "Serializable"),
    ),
}
