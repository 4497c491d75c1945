"""Data classes for facts about the code: classes, methods, calls, names and includes. Each fact has
the place in the code."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

from traceability.reading.flow import FlowFact
from traceability.schema import Place

# If the class of a called method depends on the parameters of a template, this text is used instead
# of the name of the class.
ANY_CLASS = "?"


@dataclass
class MethodFact:
    id: str
    owner: str
    name: str
    signature: str
    access: str
    kind: str
    result: str
    params: list[tuple[str, str]]  # name and type of each parameter
    place: Place
    end: int
    virtual: bool = False
    pure: bool = False
    deleted: bool = False
    defaulted: bool = False
    overrides: str | None = None
    comment: int = 0  # source line at which the comment of the method begins; 0 without a comment


@dataclass
class FieldFact:
    name: str
    type: str
    classes: list[str]  # classes of the project that the type of the member contains
    refers: bool  # true if the member is a pointer or a reference
    static: bool
    place: Place
    access: str = "public"
    constant: bool = False
    comment: int = 0


@dataclass
class SilentFact:
    """A declaration without a comment. It needs a comment, because other files can use it."""

    name: str
    # For a variable, this place includes its last source line, because a comment may be at the end
    # of this line.
    place: Place


@dataclass
class ClassFact:
    """A class, struct, enum or alias of the project. ``name`` does not contain the namespace."""

    name: str
    qualified: str
    kind: str
    place: Place
    end: int
    abstract: bool = False
    local: bool = False  # true if the type is declared in an anonymous namespace or in a function
    access: str = "invalid"  # "public", "protected" or "private" for a nested class
    bases: list[str] = field(default_factory=list)
    methods: list[MethodFact] = field(default_factory=list)
    fields: list[FieldFact] = field(default_factory=list)
    values: list[FieldFact] = field(default_factory=list)  # values of an enumeration
    parameters: list[str] = field(default_factory=list)  # parameters of a template
    comment: int = 0

    @property
    def only_base(self) -> bool:
        """True if only objects of subclasses can be constructed: the class is abstract, or it has
        constructors and all of them are protected."""
        constructors = [m for m in self.methods if m.kind == "constructor" and not m.deleted]
        protected = all(method.access == "protected" for method in constructors)
        return self.abstract or (bool(constructors) and protected)


@dataclass
class CallFact:
    target: str
    virtual: bool
    place: Place
    declared: str = ""  # for a function outside classes: the file that declares the called function
    # the places (see flow.py) that refer to the object whose method is called
    on: list[str] = field(default_factory=list)
    # for each argument, the places (see flow.py) that the argument names
    args: list[list[str]] = field(default_factory=list)
    # True if the call is in a branch of a condition, or if a condition before the call may end the
    # function.
    sometimes: bool = False
    repeated: bool = False  # True if the call is in a loop.
    # Offset of the end of the call in the file. If calls are sorted by this offset, the calls in
    # the arguments of a call are before the call itself.
    end: int = 0
    # operands of the conditions that the code evaluates before the call (see conditions.py)
    asked: list[str] = field(default_factory=list)


@dataclass
class BodyFact:
    """A function with a body. For a function outside classes, the owner is empty."""

    id: str
    owner: str
    place: Place
    end: int
    overrides: str | None = None
    local: bool = False  # true if no other file can call the function
    calls: list[CallFact] = field(default_factory=list)
    assigns: list[tuple[str, int]] = field(default_factory=list)  # pairs of Class::field and line
    # Class::field -> true if the function changes the field, false if it only reads the field
    touches: dict[str, bool] = field(default_factory=dict)
    floats: int = 0  # first source line with a floating-point number; 0 without such a line
    branches: bool = False  # true if the function has a condition or a loop
    # source lines of loops that do not count their iterations
    loops: list[int] = field(default_factory=list)


@dataclass
class NameFact:
    """A place in the code that names a class. ``by`` is the class that contains this place. ``how``
    is type, member, construct or base.

    For a member of a namespace, ``member`` contains the namespace and the name, because a namespace
    is not a class."""

    by: str
    target: str
    how: str
    place: Place
    member: str = ""
    # file that defines the class; empty if the translation unit does not contain the definition
    file: str = ""


@dataclass
class BlockFact:
    """A place that opens or uses a namespace inside the namespace of the project. Such a namespace
    contains a block of registers. ``file`` is the file that defines the namespace."""

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
    """A constant, or an operation that returns a constant. A text can refer to the constant by
    ``name``. The number is an int if the type of the constant is an integer type."""

    name: str
    number: float
    unit: str
    place: Place


@dataclass
class InitialFact:
    """A call of a method in the initialiser of a constant or of a data member."""

    name: str  # Class::member or File::name
    target: str
    place: Place


@dataclass
class EnumNumberFact:
    """A place at which the code converts a number to an enumeration."""

    kind: str  # name of the enumeration
    number: int
    place: Place


@dataclass
class BranchFact:
    """A branch whose condition compares the address of an object, or uses the number of an
    enumerator."""

    by: str  # class whose function contains the branch
    target: str  # class of the object, or the enumeration
    place: Place


@dataclass
class OffsetFact:
    """An access to a register by means of the address of another register and an offset. ``offset``
    is the largest number in the expression of the offset."""

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
    # places at which a number is converted to an address
    casts: list[Place] = field(default_factory=list)
    # places that contain assembler instructions
    instructions: list[Place] = field(default_factory=list)
    # declarations that are volatile, or that refer to a volatile object
    volatile: list[Place] = field(default_factory=list)
    # variables whose lifetime is the whole program; constants are left out
    objects: list[FieldFact] = field(default_factory=list)
    flows: list[FlowFact] = field(default_factory=list)
    branches: list[BranchFact] = field(default_factory=list)
    initial: list[InitialFact] = field(default_factory=list)
    # variable -> value; only variables whose value is a plain number
    constants: dict[str, int] = field(default_factory=dict)
    values: list[ConstantFact] = field(default_factory=list)
    # key: file:name, or the function and the name for a local variable
    variables: dict[str, FieldFact] = field(default_factory=dict)
    # friend declarations; `by` is the class that declares the friend
    friends: list[NameFact] = field(default_factory=list)
    silent: list[SilentFact] = field(default_factory=list)
    enum_numbers: list[EnumNumberFact] = field(default_factory=list)
    offsets: list[OffsetFact] = field(default_factory=list)
    # Name -> place of a declaration in a source file that does not include the header of this name.
    declared_again: dict[str, Place] = field(default_factory=dict)
    errors: list[tuple[Place, str]] = field(default_factory=list)

    def merge(self, other: Syntax) -> None:
        for part in fields(self):
            facts, others = getattr(self, part.name), getattr(other, part.name)
            (facts.update if isinstance(facts, dict) else facts.extend)(others)
