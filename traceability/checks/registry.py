"""Every check: its rule, its limits, and the fix of a finding."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from traceability.reading.toml_reader import Entries

CLAUSES = Path(__file__).parents[2] / "design" / "clauses.toml"


@dataclass(frozen=True)
class Check:
    id: str
    title: str
    holds: str
    blind: str
    fix: str

    @property
    def why(self) -> str:
        """Returns the purpose of the family of the check."""
        return WHY[self.id.split("-", maxsplit=1)[0]]

    @property
    def text(self) -> str:
        """Returns the whole description, as plain text."""
        return f"{self.holds} Its limits: {self.blind} To fix a finding: {self.fix}"


# The first word of an id names its family.
WHY = {
    "syntax": "All other checks read the syntax tree, and need a tree without errors.",
    "design": "The checks compare design/ with the code; they cannot compare an unreadable file.",
    "doc": "Every document is generated from these texts, and repeats their mistakes.",
    "module": (
        "A developer can find, understand and replace a small module with a known place and a "
        "specification, and need not read the other modules."
    ),
    "secret": (
        "If another module uses hidden names, a change of the secret must also change that module."
    ),
    "pattern": (
        "A pattern makes changes easy only while the code keeps the structure of the pattern. "
        "Each clause states a part of this structure."
    ),
    "change": "A change of a value must show the other values that depend on it.",
    "uses": (
        "The allowed uses of a module show which modules must be reused together with it, and "
        "which changes can break it."
    ),
    "board": "The virtual K64 replaces the hardware: a mistake that it does not detect reaches the "
    "robot.",
    "tree": (
        "A tree shows how the code fulfils a requirement. Its calls must be possible in the "
        "code, and occur in a run."
    ),
    "fsm": "Readers read a state machine instead of the code of its states, so both must be equal.",
    "proof": "A test covers some sequences of events. A proof covers all sequences of the model.",
    "exec": (
        "Contexts of different priorities share data. A wrong call may cause a fault only once "
        "in a thousand cycles."
    ),
    "stack": (
        "The threads and interrupts share one stack: it must be large enough for the deepest "
        "calls, which may occur in no test."
    ),
    "time": (
        "A cycle that is too long disturbs the control. The longest cycle may occur in no test."
    ),
    "req": "A requirement is fulfilled only when code, tests and results show this.",
    "suspect": (
        "A verdict is valid for the judged texts. The baseline shows which of these texts changed."
    ),
    "hazard": (
        "The safety case links each hazard with tests that ran. A missing link makes the "
        "argument invalid, and a reader may not notice it."
    ),
    "paper": (
        "The paper is the reference of the design: the project uses its names, or states the "
        "difference."
    ),
    "arch": "The architecture is the first picture that a newcomer sees: it must match the code.",
    "link": "A reader who follows a link must find the target.",
}

_TEXT_BLIND = "whether the texts are true and useful; only a reader can judge that."

_FIXED = [
    Check(
        "syntax-error",
        "Code without errors",
        "The syntax tree of every file below src and extensions has no error.",
        "an error that only another compiler or another target reports.",
        "correct the code as in the message.",
    ),
    Check(
        "doc-warning",
        "Documentation comments and pages without warnings",
        "Doxygen and Sphinx read every comment and page without a warning: each @param names a "
        "parameter, each tag is defined in this project, and each link has a target.",
        _TEXT_BLIND,
        "correct the comment or the page as in the message.",
    ),
    Check(
        "doc-name",
        "Names in texts exist",
        "Each named class, method, function, constant or value exists in the code or in the paper. "
        "The names are in comments of the code, in literals of the pages of docs/, and in texts of "
        "design/. "
        "`paper-stale` checks the names in design/concordance.toml, and `pattern-change` the "
        "names in design/changes.toml.",
        "names that are also English words, such as the class Wheel; a name that "
        "means something else now.",
        "write its present name.",
    ),
    Check(
        "design-entry",
        "The files of the design can be read",
        "Every file of design/ exists and is valid TOML. Each entry has the keys that it needs and "
        "no others, and no needed text is empty. Each name has one entry. Each baseline and each "
        "review has a date.",
        "whether an entry is true; the other checks compare it with the code. As long as "
        "a file cannot be read, they do not run.",
        "correct the line, or the name of the key.",
    ),
    Check(
        "module-logic",
        "Each design module is in a logic module",
        "Every class with a separate header is in a folder below src or extensions that has a "
        "module.dox.",
        "whether it is the right folder; this is a decision of the design.",
        "move the header into the folder of its logic module, or describe the folder.",
    ),
    Check(
        "module-folder",
        "Each logic module has a function and a secret",
        "The module.dox of every folder states @brief, @function and @secret.",
        _TEXT_BLIND,
        "write the missing paragraph in the module.dox of the folder.",
    ),
    Check(
        "module-function",
        "Each design module has a function",
        "The comment above every design module has @brief and one @function, and no two modules "
        "have the same @function.",
        _TEXT_BLIND,
        "write above the class a purpose that no other module has.",
    ),
    Check(
        "module-secret",
        "Each design module has exactly one secret",
        "The comment above every design module has exactly one @secret, which differs from its "
        "function, and no two modules have the same @secret.",
        "whether the code hides the subject of the secret.",
        "state above the class, with @secret, the one likely change that only this module hides.",
    ),
    Check(
        "module-spec",
        "Each public method has a specification",
        "Every public method of a design module has a brief, a text for each parameter and a text "
        "for its result, and @isr for calls from interrupts. The texts are in its comment, or "
        "inherited from the method that it overrides. The text of a plain number has its unit or "
        "the counted items, the text of a parameter with a unit has the unit, and each unit "
        "equals the unit of the type. Every other public part of a header has a brief: classes, "
        "types, functions, members, constants, friends, and all values of an enumeration when one "
        "value has a brief.",
        _TEXT_BLIND,
        "make the declaration private, or complete the comment above it.",
    ),
    Check(
        "module-name",
        "A header is named after its class",
        "Every design module has the name of its header, and no header contains two modules.",
        "whether the name is good.",
        "rename the file or the class, or mark a value type with @datatype.",
    ),
    Check(
        "module-count",
        "The modules of the design, and no others",
        "Every design module below src is listed for its folder in design/modules.toml, every "
        "listed module exists and is not a data type, and their number equals the number in the "
        "paper. Modules of extensions are not counted.",
        "whether the list is correct.",
        "remove the module, mark a value type with @datatype, or change design/modules.toml.",
    ),
    Check(
        "module-used",
        "Each design module is part of a product",
        "Every design module can be reached from a composition over the names in the code. Every "
        "module that design/products.toml lists exists.",
        "whether the product runs the code of the module; whether CMake builds the composition.",
        "let a builder construct the module, or remove it.",
    ),
    Check(
        "module-data",
        "A data type has no behaviour",
        "No method of a data type has a condition, a switch or a loop.",
        "a computation without condition and loop; a free function that works on the data.",
        "move the behaviour into a module.",
    ),
    Check(
        "pattern-known",
        "Known pattern applications",
        "Every @patternapp has an id and a pattern of design/applications.toml, a title, @why and "
        "@changes, and is declared once, above its abstraction. Every application of the design "
        "is declared. Every clause that a check decides is declared with its pattern and its "
        "roles.",
        _TEXT_BLIND,
        "correct the id or the pattern, or add the missing paragraph.",
    ),
    Check(
        "change-tuned",
        "Tuned constants are declared",
        "A constant whose name or comment mentions control cycles or ticks is computed from "
        "SystemConstants, or design/tuned.toml declares that it depends on it. The page of the "
        "change lists the computed and the declared constants.",
        "a value that depends on another constant, when its name and comment do not show this.",
        "compute the value from the constant, or declare it in design/tuned.toml.",
    ),
    Check(
        "pattern-change",
        "Likely changes name existing parts",
        "Every pattern has a recipe in design/changes.toml, which lists roles of the pattern: the "
        "subclasses that it adds or alters, and their base classes. An entry for an application "
        "names this application, modules with a role in it, and modules of extensions as "
        "examples; all of them exist. Each name in backticks in a step exists.",
        "whether the steps are sufficient; the extensions show this for some steps.",
        "correct the name.",
    ),
    Check(
        "change-kit",
        "Likely changes are made",
        "Each application of a pattern has a folder of its name in changes/, which makes the "
        "likely change. The folder names a class that derives from a base class of the recipe, or "
        "edits a module that the recipe alters. It names tests on the host and on the virtual "
        "K64, and these tests exist. It states why it changes existing lines.",
        "whether the change is likely, and whether its tests find a fault in it.",
        "complete the kit as changes/README.md explains.",
    ),
    Check(
        "pattern-role-unknown",
        "Known roles",
        "Every @role names an application that is declared, and a role of its pattern. The tag is "
        "once above a module that the design binds to that role, or above a module of an "
        "extension.",
        "a class that has a role without a mark; the clauses of the pattern find some of these "
        "classes.",
        "correct the application or the role, or change the design.",
    ),
    Check(
        "pattern-role-missing",
        "All roles bound",
        "Every module that the design binds to a role of a declared application has the @role.",
        "a role that the design does not list; `pattern-role-required` finds it.",
        "write the @role above the class.",
    ),
    Check(
        "pattern-role-required",
        "Every role of the pattern",
        "Every application in design/applications.toml assigns each role of its pattern, and no "
        "other, to modules that exist.",
        "whether the module plays the role; the clauses of the pattern find some wrong modules.",
        "bind the role, or correct the name of the module.",
    ),
    Check(
        "pattern-count",
        "As many applications as in the paper",
        "Each pattern has the number of applications that design/clauses.toml states.",
        "applications of extensions; they add modules to the existing applications.",
        "correct the entries of design/applications.toml.",
    ),
    Check(
        "pattern-heir-unbound",
        "Every subclass has a role",
        "Every class that derives from an abstraction of an application has the role of a "
        "subclass. A subclass of a State, a Strategy or an Abstract Class has this role in each of "
        "its applications, unless the subclass extends a component or is an extended component. A "
        "Command that is nested in a module is the body of a thread, and needs no role.",
        "whether the role is right.",
        "bind the subclass to a role, or derive it from another class.",
    ),
    Check(
        "uses-allowed",
        "Only allowed uses",
        "Every include, call and name of a class from one logic module in another is allowed in "
        "design/uses.toml.",
        "a use only through a number, such as an address.",
        "remove the include or the call, or allow the use with a reason.",
    ),
    Check(
        "uses-extension",
        "Nothing depends on an extension",
        "No file of src includes or calls an extension, and no file of src contains a number that "
        "an extension adds to an enumeration. A product can therefore omit the extension. An "
        "extension uses another extension only where design/uses.toml gives the reason.",
        "the parts that the linker adds to the image of a product; tests of products check them.",
        "remove the include or the call: a composition of the extension binds it to the robot.",
    ),
    Check(
        "uses-board",
        "Drivers and virtual board are independent",
        "No file of sim/ or tests/ includes a file that is only for the K64. No file of "
        "sim/emulator includes a file of the design, because a driver and its model must not "
        "share a mistake. The "
        "programs of "
        "tests/k64/program and tests/usual_design/k64 are compositions of drivers, which run on "
        "the virtual K64 itself. In src, `uses-allowed` shows the users of src/k64.",
        "the same number, written wrongly in both places.",
        "write the facts from the manual of the microcontroller, or test the image.",
    ),
    Check(
        "secret-registers",
        "A block of registers has owners",
        "A namespace of src/k64/registers.hpp is named only by the modules that own it in "
        "design/register_owners.toml; each owner uses it, and no address is in two blocks. No "
        "other place, and no linker script, defines a register, converts a number to an address, "
        "names a volatile object, or passes a register to others. No offset leads from one block "
        "to another. Only the drivers use instructions of the processor.",
        "which channel or pin of a block an owner uses; an offset that is computed elsewhere; "
        "the effect of a register on another block.",
        "call an operation of the owner, or change the design.",
    ),
    Check(
        "board-finding",
        "Each finding of the virtual K64 has a test",
        "Every finding in design/board_findings.toml is named in a test of tests/sim/emulator, and "
        "that file declares every finding that a seeded fault of a driver caused.",
        "whether the test causes the finding; its result shows this.",
        "write a test that causes the finding, or declare the finding.",
    ),
    Check(
        "board-belief",
        "Each belief of the virtual K64 has a source",
        "Every belief in design/board_beliefs.toml names a register of src/k64/registers.hpp, a "
        "file of sim/emulator that contains it, and a declared source. Every register of that "
        "file has a belief.",
        "a value of a register that is not listed, and whether the source confirms the belief.",
        "correct or add the entry, with its source.",
    ),
    Check(
        "uses-cycle",
        "No cycles of uses",
        "The uses between the top folders form no cycle; inside a top folder, all cycles are "
        "declared "
        "in design/uses.toml.",
        "cycles between classes of one folder.",
        "remove one of the uses, or declare the cycle in design/uses.toml with the pattern that "
        "causes it.",
    ),
    Check(
        "uses-unused",
        "No allowance without use",
        "Every use that design/uses.toml allows occurs in the code and is allowed once. Every "
        "declared cycle is a cycle within its folder.",
        "whether the declared reason is good.",
        "remove the entry.",
    ),
    Check(
        "arch-module",
        "The architecture names modules that exist",
        "Every module of an element, a group or a connection of design/architecture.toml exists, "
        "and so does the element of every connector.",
        "whether the element is refined into the right modules.",
        "correct the name.",
    ),
    Check(
        "arch-code",
        "Connections of the high-level diagram are in the code",
        "Calls lead from the first module to the second. They pass through a Command if the "
        "connection is a command. A pipe has its writer in the first module, and its reader in "
        "the second.",
        "physical connections; connections that nobody declared.",
        "correct the connection, or the code.",
    ),
    Check(
        "exec-declared",
        "Contexts, pipes and protections are declared",
        "Every handler in the table of vectors belongs to one context of design/execution.toml, "
        "and a call enables its interrupt line. Each handler, body and shared member that the file "
        "names exists. The lines of a context have its priority, and each pipe of the robot has "
        "a name.",
        "handlers of products that have other interrupts.",
        "correct the entry, or declare the missing part.",
    ),
    Check(
        "exec-isr",
        "No interrupt calls a forbidden method",
        "No method with @isr{no} is reached from the handler of an interrupt, and no method with "
        "@isr{yes} calls a method with @isr{no}. Calls of an abstraction reach the objects that "
        "the "
        "builders passed.",
        "calls through pointers to functions; methods without @isr; whether @isr{yes} is true.",
        "let a thread call the method, or make it safe and write @isr{yes}.",
    ),
    Check(
        "exec-float",
        "No floating point in an interrupt",
        "No function that the handler of an interrupt reaches has a floating-point number.",
        "functions of the toolchain; calls through pointers to functions.",
        "compute with integers.",
    ),
    Check(
        "exec-loop",
        "Each loop is bounded",
        "A loop is a `for` with a condition. design/justified.toml names each function with "
        "another kind of loop, and the reason why this loop ends, or why it is endless.",
        "whether the condition of a `for` becomes false.",
        "count the rounds in the head of the loop, or state in design/justified.toml why it ends.",
    ),
    Check(
        "exec-heap",
        "No heap in the source",
        "No file of src and extensions has new, delete, malloc or free, or includes a header of "
        "the standard library whose types allocate memory.",
        "a library that allocates inside; the symbols of the image show that.",
        "use an array or a std::optional of a fixed size.",
    ),
    Check(
        "exec-shared",
        "Shared data of contexts is protected",
        "A member that one context changes and another context uses is a Pipe, or has its "
        "protection in design/execution.toml. A member that is declared as atomic is atomic. "
        "Each use of a member that is declared as masked is under an InterruptLock. One context "
        "writes a pipe, and one context reads it.",
        "changes through parameters that are references and in the standard library; whether the "
        "protection is sufficient; two threads of one kind.",
        "put a Pipe between the contexts, or declare the protection in design/execution.toml.",
    ),
    Check(
        "stack-call",
        "Each indirect call of the image is known",
        "Each call through a pointer that the compiler lists is a call of a virtual method whose "
        "objects the builders passed, or is declared in design/stack.toml.",
        "images with extensions; an image that was not built from the present sources.",
        "call an object that a builder passes, or declare the call in design/stack.toml.",
    ),
    Check(
        "stack-recursion",
        "No function of the image calls itself",
        "No function calls itself, directly or through functions of its file, and no chain of "
        "calls "
        "from a handler enters a function twice. A chain of decorators "
        "passes at most once through each Concrete Decorator of its application.",
        "a decorator that wraps another object of the same class.",
        "write a loop with a bound.",
    ),
    Check(
        "stack-bound",
        "The stack is large enough for the worst case",
        "The sum of the deepest chains of calls of all priorities fits into the stack. Each frame "
        "has a bound. No run in closed loop used more than this sum.",
        "the words that the hardware stores for a fault in a fault handler.",
        "raise stackSize in the linker script, or shorten the deepest chain.",
    ),
    Check(
        "time-bound",
        "Each loop of the image has a bound",
        "Each loop and each copy of unknown size that a handler of the image reaches has a bound: "
        "the constant in its head, or a declared number next to it. Each indirect call is "
        "known.",
        "whether a declared bound is right; loops that run only before the first interrupt.",
        "write the bound above the loop.",
    ),
    Check(
        "time-seen",
        "No run needs more time than the bound",
        "The bound of the control cycle is at least the longest time to the report in the runs of "
        "the bench, and the longest time to the end of the main thread in the published random "
        "drives. The time of each path in its recording is at most the bound of the path.",
        "interrupts that come more often than in design/times.toml.",
        "correct the bound that is too small: the bound of a loop, or a number in "
        "design/times.toml.",
    ),
    Check(
        "fsm-declared",
        "State machines name existing parts",
        "Every application of the State pattern has a machine in design/fsm. Its states are the "
        "Concrete States of the application. Each event refers to an operation of the State. Each "
        "transition refers to states, an event and at least one requirement that exist. A method "
        "of one of its two states serves the requirement. Each event is used, and guards "
        "distinguish the transitions of a state at the same event. A number with a unit equals "
        "a number of a requirement.",
        "the meaning of guards and actions.",
        "correct the entry, or declare the machine.",
    ),
    Check(
        "fsm-code",
        "Declared transitions agree with the code",
        "The bodies of the states change to each successor as often as the machine declares, in "
        "the same operation. The check follows the calls of the operation that assigns the "
        "Context's state, back to the states. It follows each successor to the object that the "
        "builder passed. The "
        "builder begins with the initial state, and an operation that always changes the state "
        "has no transition that stays. If an operation has a single transition, this transition "
        "has a guard exactly when the code makes it "
        "conditional. Before each change the code evaluates the conditions "
        "that [guards] states for the guard. Before the change, the operations of a state also "
        "call the methods that [actions] states for their actions. They call no other methods of "
        "[actions].",
        "whether the name of a guard or an action fits the code; whether a "
        "condition must be true or false; states that extensions add.",
        "correct the code, or the transition in design/fsm.",
    ),
    Check(
        "fsm-seen",
        "Each transition is made in a test",
        "In the recorded calls of a test that passed on the host, the Context calls the operation "
        "of the state, and the next call of a state fits only the successor. Each requirement "
        "that a transition names has a test that makes the transition. No test makes a change "
        "that is not declared.",
        "which guard kept a state; a change after which the test calls no state. The check "
        "compares nothing while results are stale.",
        "test the transition through its Context, in a test of its requirement, or correct the "
        "machine.",
    ),
    Check(
        "proof-composition",
        "The model of the proofs matches the machines and the code",
        "Every machine of design/fsm has its step, its guards and its events in the composition "
        "design/proofs/robot.pml. Each hand-written step of the composition lists methods that "
        "exist, and each of its numbers equals the constant that it names.",
        "whether a step behaves like its methods.",
        "correct the composition, or the names of the code in it.",
    ),
    Check(
        "proof-property",
        "Properties formalise requirements that exist",
        "Each property of design/proofs/properties.toml names a requirement that exists, and its "
        "formula uses only names that the observer of the composition sets.",
        "whether the formula, its sentence and its requirement mean the same.",
        "correct the property.",
    ),
    Check(
        "proof-proven",
        "Each property is proven",
        "Spin explored every state of the model, and found no sequence of events that violates "
        "the property.",
        "a proof of an older design: the check compares nothing until Spin ran on the present "
        "design.",
        "correct the design, or the formula; the page Proofs shows the counterexample.",
    ),
    Check(
        "uses-apart",
        "Controllers and sensors are independent",
        "Modules that design/uses.toml separates neither name one another nor include each other's "
        "header. No controller names a sensor, and no sensor names a controller.",
        "a third module that gives a controller a sensor, or a sensor a controller.",
        "pass the value through a pipe.",
    ),
    Check(
        "module-file",
        "Every file belongs to a module",
        "Every file below src and extensions belongs to a module, contains data types, belongs to "
        "a composition, or is listed as shared in design/modules.toml. No function or class next "
        "to a module can be used without this module. All variables belong to objects.",
        "the length of a file.",
        "make the code a private part of a module, a separate module, or a @datatype.",
    ),
    Check(
        "module-preprocessor",
        "No macro, no condition",
        "The preprocessor only includes named files, so every product compiles the same text.",
        "the files that the build leaves out of a product; the tests of the products check them.",
        "use a constant, a template, or another module that the build chooses.",
    ),
    Check(
        "secret-open",
        "No access except through the interface",
        "No module has public variables, a friend outside itself, or an operation "
        "that returns a reference through which a caller can change a number of the module. No "
        "source "
        "file declares a name that another file defines.",
        "an operation that returns an object or a record of the module, such as a part of a "
        "builder.",
        "make the data private and add an operation to the module.",
    ),
    Check(
        "secret-hidden",
        "Hidden names stay inside",
        "Only the module uses a header, class, function or constant that its @hides names. If a "
        "logic module hides the name, only files of its folder use it. No other constant has the "
        "value of a hidden constant and a similar name.",
        "a copy of the same fact with a different name.",
        "call an operation of the module instead.",
    ),
    Check(
        "tree-missing",
        "Each requirement has a tree",
        "Every requirement has a tree of invocations in design/trees.",
        "whether the tree shows the intended calls.",
        "write the tree of the requirement in design/trees.",
    ),
    Check(
        "tree-node",
        "Trees name existing methods",
        "Every tree belongs to a requirement, and every node is a method that its class has or "
        "inherits. A requirement has one tree.",
        "overloads: methods of one name are one node.",
        "correct the name in the tree.",
    ),
    Check(
        "tree-static",
        "Each edge of a tree is a possible call",
        "The body of each parent has a call that can reach the child; a call of a virtual method "
        "reaches every method that overrides it.",
        "whether the call is ever executed; calls through pointers to functions.",
        "restore the call in the code, or change the tree.",
    ),
    Check(
        "tree-order",
        "The order and the number of calls match the tree",
        "The body of each parent makes the calls in the order of the tree. One statement without a "
        "condition calls a node without a mark. The mark ? means a call under a condition, or "
        "after a condition that may return. The mark * means a call in a loop or by several "
        "statements.",
        "which condition guards the call; the order of calls in different turns of a loop.",
        "restore the code, or correct the order or the mark in the tree.",
    ),
    Check(
        "tree-dynamic",
        "Each tree was executed",
        "The tree is contained in the recorded calls of a test that passed and that verifies the "
        "requirement: each child within the call of its parent, in order.",
        "operations that the platform implements, such as operations of a port, because they are "
        "not recorded. The check compares nothing while results are stale.",
        "correct the tree, or test the requirement so that the calls are made.",
    ),
    Check(
        "req-text",
        "Requirements are complete",
        "Every requirement has a unique id, a sentence with a shall, @rationale, @source, and "
        "a @priority: high, medium or low.",
        "whether the sentence is clear and can be verified.",
        "write the missing part.",
    ),
    Check(
        "req-attribute",
        "Requirements have level, product and method",
        "Every requirement has one @level: system, software or driver; a @product: all, or names "
        "of products that exist; and one @method of verification: test, analysis, measurement or "
        "inspection. A requirement with the method test is named in the @verifies of a test. A "
        "measurement and an analysis have @evidence, or a test with a measurement.",
        "whether the method suits the requirement; parts that a requirement without @partly "
        "leaves unverified.",
        "write the attribute, or correct its value.",
    ),
    Check(
        "req-number",
        "Numbers of requirements agree with the code",
        "Each number with a unit in a requirement, in digits or as a word, is linked with a "
        "constant in design/requirement_numbers.toml, and the constant has this value. The file "
        "lists the other numbers with the reason why there is no constant.",
        "numbers whose unit is not in the list; whether the linked constant determines the "
        "property of the sentence.",
        "correct the constant or the requirement, or name the constant in the file.",
    ),
    Check(
        "req-source",
        "Sources are references",
        "Every @source has the form 'kind: name'; semicolons separate several sources. The name of "
        "a paper is a place of design/paper.toml. The name of a goal is in "
        "design/safety_case.toml and in a @goal of the requirement. The name of a protocol is a "
        "heading of docs/protocol.rst. The name of a data sheet is in design/safety_case.toml. A "
        "decision has its text.",
        "whether the source supports the requirement; only a reader can judge that.",
        "write the source in this form.",
    ),
    Check(
        "req-satisfied",
        "Each requirement is satisfied",
        "Every requirement is named in the @satisfies of a method.",
        "whether the method fulfils the requirement; the tests show this.",
        "tag the method that does the work with @satisfies.",
    ),
    Check(
        "req-verified",
        "Each requirement is verified",
        "Every requirement is named in the @verifies of a test.",
        "whether the test is strict enough.",
        "write a test for the requirement, or tag the existing test with @verifies.",
    ),
    Check(
        "req-method",
        "Each public method serves a requirement",
        "Every public method of a design module is tagged with @satisfies, or has a node in a "
        "tree, or overrides such a method, or such a method overrides it. A constructor serves "
        "the requirements of its module.  Other methods are justified in design/justified.toml.",
        "whether the method is needed for the requirement.",
        "tag the method with @satisfies, use it in a tree, remove it, or justify it in "
        "design/justified.toml.",
    ),
    Check(
        "req-caller",
        "Each public method has a caller",
        "Code of the firmware calls every public method of a design module, or the method that it "
        "overrides. A builder calls each step and uses each part. Other methods are justified in "
        "design/justified.toml.",
        "whether the caller runs: a call in dead code is accepted.",
        "call the method, remove it, or justify it in design/justified.toml.",
    ),
    Check(
        "req-test",
        "Each test verifies a requirement",
        "Every test in C++ is tagged with @verifies, or justified in design/justified.toml. The "
        "tools recognise its macro. No test is disabled, and no test of a requirement skips "
        "itself.",
        "whether the test tests the requirement; mutants show this.",
        "tag the test with @verifies, remove it, or justify it in design/justified.toml.",
    ),
    Check(
        "req-justified",
        "Justifications are needed",
        "Every name in design/justified.toml is a method, a test or a line that needs a "
        "justification. "
        "Every entry of design/mutants.toml quotes a line of its method; after a mutation test of "
        "all mutants of these sources, no test finds its changes.",
        "whether the reason is good.",
        "remove the entry, or correct its names.",
    ),
    Check(
        "req-evidence",
        "Measured requirements are met",
        "Each @evidence of a requirement names a metric that was measured in this run and meets "
        "its bound. A bound has the form at most, at least or exactly.",
        "whether the metric shows the property that the requirement demands.",
        "run ./wr test to measure it; if the value is beyond its bound, correct the code.",
    ),
    Check(
        "req-passed",
        "Verifying tests ran and passed",
        "Every test that verifies a requirement ran in the last test run and passed, and every "
        "other test ran. The build of the tests names every folder with tests.",
        "results are not compared while they are stale.",
        "correct the code or the test, then run ./wr test.",
    ),
    Check(
        "req-unknown",
        "Tags name requirements that exist",
        "Every @satisfies and @verifies names one requirement of requirements/.",
        "a tag with the wrong existing id.",
        "correct the id.",
    ),
    Check(
        "req-name",
        "A test named after a requirement verifies it",
        "A test whose name begins with an id, such as FR41_, has the @verifies for that id.",
        "tests without an id in the name.",
        "write the @verifies above the test, or rename it.",
    ),
    Check(
        "req-stale",
        "Results belong to the present sources",
        "The last test run used exactly the present sources. The build of the image whose size and "
        "stack are compared also used these sources.",
        "no known case, because it compares contents, not dates.",
        "run ./wr test.",
    ),
    Check(
        "req-line",
        "Each line serves a requirement",
        "Each line of a method of the design is executed by a passing test of a requirement that "
        "the method serves: the tree of the requirement contains the method, the method has its "
        "tag, or a caller of the method serves it. Other lines are justified in "
        "design/justified.toml.",
        "the drivers of the K64, whose lines the page of the virtual K64 lists; whether the test "
        "checks the effect of the line.",
        "test the line for its requirement, remove it, or justify it in design/justified.toml.",
    ),
    Check(
        "hazard-name",
        "The safety case names existing parts",
        "Each hazard has an id HZ-n, each safety goal SG-n, each assumption of use AU-n; the "
        "goals, assumptions and safe states that an entry of design/safety_case.toml names are "
        "declared there.",
        "hazards that nobody found.",
        "correct the name.",
    ),
    Check(
        "hazard-covered",
        "Each hazard is covered",
        "Every hazard has a safety goal or an assumption of use, and its severity, exposure and "
        "avoidance have a level in the risk graph.",
        "whether the estimates are right, and whether the goal is sufficient.",
        "name a goal or an assumption, or complete the estimates.",
    ),
    Check(
        "hazard-goal",
        "Each safety goal is complete",
        "Every safety goal is named by a hazard, lists requirements and names a safe state.",
        "whether the requirements are sufficient to reach the goal.",
        "complete the goal in design/safety_case.toml.",
    ),
    Check(
        "hazard-time",
        "Times of goals are derived",
        "The fault-tolerant time of each goal is the value of its formula, rounded down by at most "
        "10 %, and the reaction of the firmware is not longer.",
        "whether distances and energies in the formula fit the robot; whether the tests measure "
        "this reaction.",
        "correct the time or the formula, or make the firmware react sooner.",
    ),
    Check(
        "hazard-requirement",
        "Goals and requirements name each other",
        "Each goal lists the requirements that name it in @goal. Each listed requirement exists "
        "and has the @goal.",
        "whether the requirement serves the goal. A goal whose requirements are not all verified "
        "is not a finding: its page shows it as open.",
        "add the missing link.",
    ),
    Check(
        "hazard-scenario",
        "Fault scenarios have goals and passed",
        "Every file of sim/scenario/safety names a safety goal that lists it. A test plays it, and "
        "passed on each target for which the test is built. Every scenario that a goal lists "
        "exists. A result that is older than the sources is not counted as passed.",
        "faults without a scenario.",
        "complete the links, play the scenario in a test, or correct the failure.",
    ),
    Check(
        "hazard-assumption",
        "Each assumption of use covers a hazard",
        "A hazard names every assumption of use.",
        "whether people follow it.",
        "name the assumption in a hazard, or remove it.",
    ),
    Check(
        "hazard-priority",
        "Safety has priority",
        "The priority of a requirement is at least the priority that design/safety_case.toml "
        "derives from the level of its safety goals.",
        "requirements without a goal.",
        "raise the priority.",
    ),
    Check(
        "suspect-requirement",
        "A requirement is as in its baseline",
        "These texts of each requirement are unchanged since its baseline: the requirement, its "
        "invocation tree, its transitions of state machines, its safety goals and their hazards.",
        "whether the texts are right, which a review answers; changes of line breaks.",
        "run ./wr review with the id of the requirement, or with --baseline and the id.",
    ),
    Check(
        "suspect-method",
        "Satisfying methods are as in the baseline",
        "These texts are unchanged since the baseline: the specifications of the methods that "
        "satisfy a requirement, the bodies of these methods and of the methods in its tree, and "
        "the constants of their files.",
        "comments in a body, formatting, and names of local variables.",
        "run ./wr review with the id of the requirement, or with --baseline and the id.",
    ),
    Check(
        "suspect-test",
        "Verifying tests are as in the baseline",
        "These texts are unchanged since the baseline: the tests that verify a requirement, their "
        "fixtures, parameters and helpers, and the scenarios that the tests play.",
        "the simulator, and tests in Python; comments and formatting.",
        "run ./wr review with the id of the requirement, or with --baseline and the id.",
    ),
    Check(
        "suspect-design",
        "Reasons and code without a requirement are as in the baseline",
        "These texts are unchanged since the baseline: the sentences in the files of design/ and "
        "of changes/, such as reasons, deviations, steps and answers, and the bodies and "
        "specifications that no requirement names.",
        "whether the texts are right; the pages of docs/.",
        "compare the text with the code, then run ./wr review --baseline design.",
    ),
    Check(
        "req-review",
        "A record of a review is a review",
        "Each record in requirements/reviews.toml names a person with an address. According to "
        "git, this person wrote no line of the texts. The record has a remark, and an answer to "
        "each question.",
        "whether the reviewer was careful. A requirement without a review is not a finding: its "
        "page "
        "shows that.",
        "remove the record, and let another person run ./wr review with the id.",
    ),
    Check(
        "paper-complete",
        "The concordance with the paper is complete",
        "Every picture, table, section and named element of the paper that design/paper.toml lists "
        "has one entry in design/concordance.toml. The entry names its counterpart, or the reason "
        "why it has none. Entries name each arrow of the high-level diagram.",
        "an element that is missing in the list, which was written by hand from the paper.",
        "write the entry in design/concordance.toml, or correct its kind or name.",
    ),
    Check(
        "paper-statement",
        "Each statement of the paper has an answer",
        "Each entry of design/statements.toml names a place of the paper, and its answer exists. "
        "Each requirement whose source is a place of the paper answers a statement of the paper.",
        "whether the list contains every statement of the paper, and whether an answer is good: a "
        "person compares them with the paper.",
        "correct the entry, or add the statement to design/statements.toml.",
    ),
    Check(
        "paper-stale",
        "The concordance names existing parts",
        "The entries of design/concordance.toml and the backticks in their texts name only "
        "existing modules, methods, applications, state machines, requirements, checks and "
        "pages. A count of modules or applications, and the value of a constant, equal the values "
        "in the code.",
        "whether the paper means this part; only a reader can judge that.",
        "name the part that replaced it.",
    ),
    Check(
        "paper-alias",
        "Each name that differs from the paper has a reason",
        "A module, method or state has an alias with a reason if, and only if, its name differs "
        "from the name in the paper. For an application, this is its title.",
        "whether the reason is good.",
        "state why the name differs, or use the name of the paper.",
    ),
    Check(
        "doc-diagram",
        "Every diagram can be drawn",
        "PlantUML draws each diagram of the model without an error.",
        "whether the diagram is easy to read.",
        "correct the source of the diagram.",
    ),
    Check(
        "doc-frame",
        "Numbers of the protocol agree with the code",
        "Each value of an enumeration in design/frames.toml has the number of the enumerator of "
        "the same name in the firmware.",
        "fields, their types and their limits; the tests compare them.",
        "correct the number; never give a new meaning to a number on the line.",
    ),
    Check(
        "doc-example",
        "Worked examples of the protocol are consistent",
        "For each example in docs/protocol_examples.txt, the body determines the check sum and the "
        "bytes on the line.",
        "whether the body has the described content; tests of the firmware and of the client "
        "decode it.",
        "run tests/python/client/examples.py, which writes the examples.",
    ),
    Check(
        "link-doc",
        "Links of hand-written pages",
        "Every reference in docs/ has a target. Every path of a file in a page of docs/, the "
        "README or a text of design/ exists. Each command of ./wr with its options, each "
        "product, each test program, each used pin and each key that a page or the README names "
        "exists.",
        "whether the link has the right target.",
        "correct the target.",
    ),
    Check(
        "link-site",
        "Links of the site",
        "Every link of the site, also in diagrams, has a target page and anchor. Every click of "
        "design/questions.toml has a target page.",
        "links to other sites.",
        "correct the source of the page.",
    ),
]


def _clauses() -> list[Check]:
    # The model reports the error of the file.
    entries = Entries(CLAUSES.parents[1]).tables(
        CLAUSES, "clause", {"id": str, "pattern": str, "says": str, "fix": str}, {"about": list}
    )
    return [
        Check(
            entry["id"],
            f"{entry['pattern']}: {entry['id'].split('-', 2)[2].replace('-', ' ')}",
            f"In every application of {entry['pattern']}: {entry['says']}",
            "the intent: the check compares only the shape of the code.",
            f"{entry['fix']}.",
        )
        for entry, _ in entries
    ]


CHECKS = [*_FIXED, *_clauses()]
KNOWN = {check.id: check for check in CHECKS}
