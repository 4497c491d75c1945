"""Facts about the code: classes, methods, calls, names and includes, each with its place."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

from traceability.reading.flow import FlowFact
from traceability.schema import Place

ANY_CLASS = "?"  # used instead of the class if a call depends on the parameters of a template


@dataclass
class MethodFact:
    id: str
    owner: str
    name: str
    signature: str
    access: str
    kind: str
    result: str
    params: list[tuple[str, str]]  # name and type
    place: Place
    end: int
    virtual: bool = False
    pure: bool = False
    final: bool = False
    deleted: bool = False
    defaulted: bool = False
    overrides: str | None = None
    comment: int = 0  # line at which its comment begins; 0 if there is no comment


@dataclass
class FieldFact:
    name: str
    type: str
    classes: list[str]  # classes of the project that the type names
    refers: bool  # a pointer or a reference, and not a value
    static: bool
    place: Place
    access: str = "public"
    constant: bool = False
    comment: int = 0


@dataclass
class SilentFact:
    """A declaration without a comment, in a header that other files can use."""

    name: str
    place: Place  # end of a variable; its comment may follow the value


@dataclass
class ClassFact:
    """A class, struct, enum or alias of the project. ``name`` is without the namespace."""

    name: str
    qualified: str
    kind: str
    place: Place
    end: int
    abstract: bool = False
    local: bool = False  # declared in an anonymous namespace or in a function
    access: str = "invalid"  # access of a nested class
    bases: list[str] = field(default_factory=list)
    base_places: list[Place] = field(default_factory=list)
    methods: list[MethodFact] = field(default_factory=list)
    fields: list[FieldFact] = field(default_factory=list)
    values: list[FieldFact] = field(default_factory=list)  # values of an enumeration
    parameters: list[str] = field(default_factory=list)  # parameters of a template
    comment: int = 0


@dataclass
class CallFact:
    target: str
    virtual: bool
    place: Place
    declared: str = ""  # the file that declares a function outside classes
    on: list[str] = field(default_factory=list)  # objects on which a method is called (see flow)
    args: list[list[str]] = field(default_factory=list)  # places that each argument names
    # The call is below a condition, or after a condition that may return.
    sometimes: bool = False
    repeated: bool = False  # The call is in a loop.
    end: int = 0  # Offset in the file. The end of a call is after the calls in its arguments.
    # operands of the conditions before the call (see conditions)
    asked: list[str] = field(default_factory=list)


@dataclass
class BodyFact:
    """A function with a body. A function outside classes has no owner."""

    id: str
    owner: str
    place: Place
    end: int
    overrides: str | None = None
    local: bool = False  # no other file can call the function
    calls: list[CallFact] = field(default_factory=list)
    assigns: list[tuple[str, int]] = field(default_factory=list)  # pairs of Class::field and line
    touches: dict[str, bool] = field(default_factory=dict)  # Class::field -> whether it is changed
    floats: int = 0  # first line with a floating-point number; 0 if there is none
    branches: bool = False  # whether it has a condition or a loop
    # lines of loops that do not count their iterations
    loops: list[int] = field(default_factory=list)


@dataclass
class NameFact:
    """A use of the name of a class in the code of another class. ``how`` is type, member, construct
    or base.

    A namespace is no class. For a member of a namespace, ``member`` therefore also contains the
    namespace.
    """

    by: str
    target: str
    how: str
    place: Place
    member: str = ""
    file: str = ""  # file that defines the class, if the unit contains it


@dataclass
class BlockFact:
    """A place that opens or uses a namespace of ``file`` inside the namespace of the project."""

    block: str
    file: str
    place: Place
    declares: bool


@dataclass
class IncludeFact:
    target: str
    place: Place


@dataclass
class ConstantFact:
    """A constant, or an operation that returns a constant. It has a name that texts can use."""

    name: str
    number: int
    unit: str
    place: Place


@dataclass
class InitialFact:
    """A call of a method in the initialiser of a constant or of a member."""

    name: str  # Class::member or File::name
    target: str
    place: Place


@dataclass
class EnumNumberFact:
    """A number that the code converts to a value of an enumeration."""

    kind: str  # the enumeration
    number: int
    place: Place


@dataclass
class BranchFact:
    """A branch that depends on the address of an object, or on the number of an enumerator."""

    by: str  # owner of the body
    target: str  # class or enumeration
    place: Place


@dataclass
class OffsetFact:
    """A register that is accessed with an offset from another register. It has the largest number
    in the offset."""

    base: int
    offset: int
    place: Place


@dataclass
class Syntax:
    classes: list[ClassFact] = field(default_factory=list)
    bodies: list[BodyFact] = field(default_factory=list)
    names: list[NameFact] = field(default_factory=list)
    includes: list[IncludeFact] = field(default_factory=list)
    blocks: list[BlockFact] = field(default_factory=list)
    casts: list[Place] = field(default_factory=list)  # places that convert a number to an address
    instructions: list[Place] = field(default_factory=list)  # places with assembler instructions
    volatile: list[Place] = field(default_factory=list)  # places that use volatile memory
    objects: list[FieldFact] = field(default_factory=list)  # variables that no class contains
    flows: list[FlowFact] = field(default_factory=list)
    branches: list[BranchFact] = field(default_factory=list)
    initial: list[InitialFact] = field(default_factory=list)
    # variable -> value, if it is a plain number
    constants: dict[str, int] = field(default_factory=dict)
    values: list[ConstantFact] = field(default_factory=list)
    variables: dict[str, FieldFact] = field(default_factory=dict)  # file:name or function name
    friends: list[NameFact] = field(default_factory=list)  # names of classes that have a friend
    silent: list[SilentFact] = field(default_factory=list)
    enum_numbers: list[EnumNumberFact] = field(default_factory=list)
    offsets: list[OffsetFact] = field(default_factory=list)
    # Name -> place of the second declaration. Only names that no header declares are listed.
    declared_again: dict[str, Place] = field(default_factory=dict)
    errors: list[tuple[Place, str]] = field(default_factory=list)

    def merge(self, other: Syntax) -> None:
        for part in fields(self):
            facts, others = getattr(self, part.name), getattr(other, part.name)
            (facts.update if isinstance(facts, dict) else facts.extend)(others)
