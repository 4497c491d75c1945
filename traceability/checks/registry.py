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
        """The whole description, as plain text."""
        return f"{self.holds} Its limits: {self.blind} To fix a finding: {self.fix}"


# The first word of an id names its family.
WHY = {
    "syntax": "All other checks read the syntax tree: they need one without errors.",
    "design": "The checks compare design/ with the code; an unreadable file is not compared.",
    "doc": "Every document is made from these texts: a mistake here is a mistake there.",
    "module": "A module that is small, has a place of its own and a specification can be found, "
    "understood and replaced without reading the others.",
    "secret": "A change stays in one module only as long as no other one uses the hidden names.",
    "pattern": "A pattern absorbs the changes it was chosen for only as long as the code keeps its "
    "shape; each clause is a part of that shape.",
    "change": "A change of a value must show the other values that were chosen for it.",
    "uses": "The allowed uses of a module decide which modules come with it when it is reused, and "
    "which changes can break it.",
    "board": "The virtual K64 replaces the hardware: a mistake that it does not find reaches the "
    "robot.",
    "tree": "A tree shows how the code fulfils a requirement: it must be possible "
    "in the code, and occur in a run.",
    "fsm": "A state machine is read instead of the code of its states: both must be equal.",
    "proof": "A test shows some sequences of events; a proof of the model covers all of them.",
    "exec": "Contexts of different priorities share data: a call in the wrong place causes a fault "
    "only once in a thousand cycles.",
    "stack": "The threads and interrupts share one stack: it must be large enough for the worst "
    "moment, which may occur in no test.",
    "time": "A cycle that comes too late is a fault of a control system; the longest one may occur "
    "in no test.",
    "req": "A requirement counts as fulfilled only when code, tests and results show it.",
    "suspect": "A verdict holds for the texts that it was given for: the baseline shows which of "
    "them changed.",
    "hazard": "The safety case argues from each hazard to tests that ran: a link that is missing "
    "breaks the argument without anybody noticing.",
    "paper": "The paper is the reference of the design: its names must be here, or the difference "
    "must be stated.",
    "arch": "The architecture is the first picture that a newcomer sees: it must match the code.",
    "link": "A reader who follows a link is to arrive.",
}

_TEXT_BLIND = "whether the words are true and useful; a person reads that."

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
        "Documentation comments and pages in order",
        "Doxygen and Sphinx read every comment and page without a warning: each @param names a "
        "parameter, each tag is one of this project, each link has a target.",
        _TEXT_BLIND,
        "correct the comment or the page as in the message.",
    ),
    Check(
        "doc-name",
        "Names in texts exist",
        "Each class, method, function, constant or value that a comment of the code, a literal of "
        "a page of docs/ or a text of design/ names is one of the code, or of the paper. In "
        "design/concordance.toml `paper-stale` finds it, in design/changes.toml `pattern-change`.",
        "names that are words of the language too, such as that of the class Wheel; a name that "
        "means something else now.",
        "write the name that it has now.",
    ),
    Check(
        "design-entry",
        "The files of the design can be read",
        "Every file of design/ is there and is TOML; each entry has the keys that it needs and no "
        "others, and no needed text is empty; each name has one entry; each "
        "baseline and each review has a date.",
        "whether an entry is true; the other checks compare it with the code. As long as "
        "a file cannot be read, they wait.",
        "correct the line, or the name of the key.",
    ),
    Check(
        "module-logic",
        "Each design module lies in a logic module",
        "Every class with its own header lies in a folder below src or extensions that has a "
        "module.dox.",
        "whether it is the right folder; that is a matter of design.",
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
        "state the same.",
        _TEXT_BLIND,
        "write the paragraph above the class.",
    ),
    Check(
        "module-secret",
        "Each design module has one secret of its own",
        "The comment above every design module has exactly one @secret, which is not its function, "
        "and no two modules state the same.",
        "whether the code hides the subject of the secret.",
        "state above the class the one likely change that the module hides.",
    ),
    Check(
        "module-spec",
        "Each public method has a specification",
        "Every public method of a design module has a brief, a text for each parameter and one for "
        "its result, and @isr for calls from interrupts; its own or inherited "
        "from the method that it overrides. The text of a plain number has its unit or the counted "
        "items, the text of a parameter with a unit has the unit, and each unit is that of the "
        "type. Every other public part of a header has a brief: classes, types, functions, "
        "members, constants, friends, and the values of an enumeration when one of them has.",
        _TEXT_BLIND,
        "complete the comment above the declaration.",
    ),
    Check(
        "module-name",
        "A header is named after its class",
        "Every design module has the name of its header, and no header holds two.",
        "the quality of the name.",
        "rename the file or the class, or mark a value type with @datatype.",
    ),
    Check(
        "module-count",
        "The modules of the design, and no other",
        "Every design module below src is listed for its folder in design/modules.toml, every "
        "listed one is there and is no data type, and their number is that of the paper. Those of "
        "extensions are free: they do not count.",
        "whether the list is the right one.",
        "remove the module, mark a value type with @datatype, or change the design.",
    ),
    Check(
        "module-used",
        "Each design module is part of a product",
        "The names in the code lead from a composition to every design module.",
        "whether the product runs the code of the module; whether CMake builds the composition.",
        "let a builder make the module, or remove it.",
    ),
    Check(
        "module-data",
        "A data type has no behaviour",
        "No method of a data type has a condition, a switch or a loop.",
        "a computation without them; the work of a free function on the data.",
        "move the behaviour into a module.",
    ),
    Check(
        "pattern-known",
        "Known pattern applications",
        "Every @patternapp has an id and a pattern of design/applications.toml, a title, @why and "
        "@changes, and is declared once, above an abstraction that it has; every application of "
        "the design is declared, and so is every clause that can be decided, with its pattern "
        "and roles of it.",
        _TEXT_BLIND,
        "correct the id or the pattern, or add the missing paragraph.",
    ),
    Check(
        "change-tuned",
        "Tuned constants are declared",
        "A constant whose name or comment speaks of control cycles or of ticks is computed from "
        "SystemConstants, or design/tuned.toml declares that it is tuned to it. The page of the "
        "change lists both.",
        "a value that depends on another constant, when neither name nor comment shows it.",
        "compute the value from the constant, or add it to design/tuned.toml.",
    ),
    Check(
        "pattern-change",
        "Likely changes name existing parts",
        "Every pattern has a recipe in design/changes.toml, which names roles of the pattern: the "
        "subclasses that it adds or alters, and their base classes. An entry for one application "
        "names an existing one, and existing modules: those with a role in it, and "
        "examples of an extension. Each name in backticks in a step exists.",
        "whether the steps are enough; the extensions show that for some.",
        "correct the name.",
    ),
    Check(
        "pattern-role-unknown",
        "Known roles",
        "Every @role names an application that is declared and a role of it, and is once above "
        "a module that the design binds to that role, or above one of an extension.",
        "a class that plays a role without saying so; the clauses of the pattern find some.",
        "correct the application or the role, or change the design.",
    ),
    Check(
        "pattern-role-missing",
        "All roles bound",
        "Every module that the design binds to a role of a declared application has the @role.",
        "a role that nobody listed; `pattern-role-required` finds that.",
        "write the @role above the class.",
    ),
    Check(
        "pattern-role-required",
        "Every role of the pattern",
        "Every application in design/applications.toml binds each role of its pattern, and no "
        "other, to modules that exist.",
        "whether it is the right module; the clauses of the pattern find some.",
        "bind the role, or correct the name of the module.",
    ),
    Check(
        "pattern-count",
        "As many applications as in the paper",
        "Each pattern has the number of applications that design/clauses.toml states.",
        "applications of extensions; they bind further modules to the applications that exist.",
        "correct the entries of design/applications.toml.",
    ),
    Check(
        "pattern-heir-unbound",
        "Every subclass plays a role",
        "Every class that derives from an abstraction of an application plays the role of a "
        "subclass: one of a State, a Strategy or an Abstract Class in each of its "
        "applications, unless it extends a component or is extended. A Command that is nested in "
        "a module is the body of a thread, and needs none.",
        "whether the role is the right one.",
        "bind the subclass to a role, or derive it from something else.",
    ),
    Check(
        "uses-allowed",
        "Only allowed uses",
        "Every include, call and name of a class from one logic module in another is allowed in "
        "design/uses.toml.",
        "a use through a number alone, such as an address.",
        "remove the include or the call, or allow the use with a reason.",
    ),
    Check(
        "uses-extension",
        "Nothing depends on an extension",
        "No file of src includes or calls one of extensions, so a product can leave it out; nor "
        "does it have a number that an extension adds to an enumeration. An extension uses another "
        "one only where design/uses.toml gives the reason.",
        "the parts that the linker adds to the image of a product; tests of products check them.",
        "remove the include or the call: a composition of the extension binds it to the robot.",
    ),
    Check(
        "uses-board",
        "Drivers and virtual board are independent",
        "No file of sim/ or tests/ includes one that is for the K64 only, and no file of "
        "sim/emulator one of the design: a driver and its model share no mistake. The programs of "
        "tests/k64/program and tests/usual_design/k64 are compositions of drivers, which run on "
        "the virtual K64 itself. In src, `uses-allowed` shows the users of src/k64.",
        "the same number, written down wrongly twice.",
        "write the needed facts from the manual of the part, or test the image.",
    ),
    Check(
        "secret-registers",
        "A block of registers has owners",
        "A namespace of src/k64/registers.hpp is named only by the modules that own it in "
        "design/register_owners.toml; each owner uses it; no address is in two of them; no "
        "other place makes a register, makes a number into an address, names a volatile object, or "
        "hands a register to others, nor does the linker; no number in an offset leads from one "
        "block to another; only the drivers have instructions of the processor.",
        "which channel or pin of a block an owner touches; an offset that is computed elsewhere; "
        "the effect of a register on another block.",
        "call an operation of the owner, or change the design.",
    ),
    Check(
        "board-finding",
        "Each finding of the virtual K64 has a test",
        "Every finding in design/board_findings.toml is named in a test of tests/sim/emulator, and "
        "every finding that a seeded driver fault gave is declared there.",
        "whether the test makes the finding happen; its result shows that.",
        "write a test that makes the finding happen, or correct the id.",
    ),
    Check(
        "board-belief",
        "Each belief of the virtual K64 has a source",
        "Every belief in design/board_beliefs.toml names a register of src/k64/registers.hpp, a "
        "file of sim/emulator that has it, and a declared source; it is marked as shared exactly "
        "when that source is not an outside one. Every register of that file has a belief.",
        "a value of a register that is not listed, and whether the source confirms the belief.",
        "correct the entry, or find an outside source.",
    ),
    Check(
        "uses-cycle",
        "No cycles of uses",
        "The uses between the top folders form no cycle; inside one, the cycles are those declared "
        "in design/uses.toml.",
        "cycles between classes of one folder.",
        "remove one of the uses, or declare the cycle with the pattern that causes it.",
    ),
    Check(
        "uses-unused",
        "No allowance without use",
        "Every use that design/uses.toml allows occurs in the code and is allowed once, and every "
        "declared cycle is one, within its folder.",
        "whether the reason given there is good.",
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
        "Calls lead from the one module to the other, over a Command where the connection is one; "
        "a pipe has a writer in the one and a reader in the other.",
        "physical connections; connections that nobody declared.",
        "correct the connection, or the code.",
    ),
    Check(
        "exec-declared",
        "Contexts, pipes and protections are declared",
        "Every handler in the table of vectors belongs to one context of design/execution.toml, "
        "and a call enables its line; each handler and body named there exists, the lines of a "
        "context have its priority, each pipe of the robot has a name, and each member named there "
        "is shared.",
        "handlers of products that have other interrupts.",
        "correct the entry, or declare the missing one.",
    ),
    Check(
        "exec-isr",
        "No interrupt calls a forbidden method",
        "No method with @isr{no} is reached from the handler of an interrupt, and no method with "
        "@isr{yes} calls one with @isr{no}. Calls of an abstraction reach the objects that the "
        "builders gave.",
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
        "A loop is a `for` with a condition; a function with another one is named in "
        "design/justified.toml with the reason why the loop ends, or may not end.",
        "whether the condition of a `for` becomes false.",
        "count the rounds in the head of the loop, or justify it.",
    ),
    Check(
        "exec-shared",
        "Shared data of contexts is protected",
        "A member that one context changes and another one touches is a Pipe, or has its "
        "protection in design/execution.toml: a member declared as atomic is atomic, and an "
        "InterruptLock is at each place declared as masked. A pipe has one context that writes and "
        "one that reads it.",
        "changes through parameters that are references and in the standard library; whether the "
        "protection is enough; two threads of one kind.",
        "put a Pipe between the contexts, or state the protection.",
    ),
    Check(
        "stack-call",
        "Each indirect call of the image is known",
        "Each call through a pointer that the compiler lists is a call of a virtual method whose "
        "objects the builders gave, or is declared in design/stack.toml.",
        "images that add to the robot; an image that was not built from the present sources.",
        "call an object that a builder gives, or declare the call.",
    ),
    Check(
        "stack-recursion",
        "No function of the image calls itself",
        "From no handler does a chain of calls come back to a function. A chain of decorators "
        "passes once through each Concrete Decorator of its application.",
        "a decorator that wraps another object of its own class.",
        "write a loop with a bound.",
    ),
    Check(
        "stack-bound",
        "The stack is large enough for the worst moment",
        "The greatest chains of calls of all priorities, one above the other, fit into the stack; "
        "each frame has a bound; and no run in closed loop used more than that.",
        "the words that the hardware stores for a fault inside of a fault.",
        "raise stackSize in the linker script, or shorten the deepest chain.",
    ),
    Check(
        "time-bound",
        "Each loop of the image has a bound",
        "Each loop and each copy of unknown size that a handler of the image reaches has a bound: "
        "the constant in its head, or one that is declared next to it. Each indirect call is "
        "known.",
        "whether a declared bound is right; loops that run only before the first interrupt.",
        "write the bound above the loop.",
    ),
    Check(
        "time-seen",
        "No run needs more time than the bound",
        "The longest time to the report in the runs of the bench, and to the end of the main "
        "thread in the published record of random drives, is at most the bound of the control "
        "cycle.",
        "interrupts that come more often than in design/times.toml.",
        "correct the bound that is too small.",
    ),
    Check(
        "fsm-declared",
        "State machines name existing parts",
        "Every application of the State pattern has a machine in design/fsm. Its states are the "
        "Concrete States of the application; each event names an operation of the State, and each "
        "transition states, an event and at least one requirement that exist; a method of one of "
        "its two states serves the requirement. Each event is used, and a guard distinguishes the "
        "transitions of a state at one event apart. A number with a unit is that of one of the "
        "requirements.",
        "the words of guards and actions.",
        "correct the entry, or declare the machine.",
    ),
    Check(
        "fsm-code",
        "Declared transitions are those of the code",
        "The bodies of the states make as many changes to each successor as the machine declares, "
        "in the same operation: the operation that assigns the Context's state is followed to the "
        "states that call it, and each successor to the object that the builder gave. The builder "
        "begins with the initial state, and an operation that always changes the state has no "
        "transition that stays. The only transition of an operation has a guard exactly when the "
        "code makes it under a condition. Before each change the code asks the questions that "
        "[guards] states for its guard, and the operations of a state call the methods that "
        "[actions] states for their actions, and no others of these.",
        "whether the words of a guard or an action mean the same as the code; whether a "
        "question must be true or false; states that extensions add.",
        "correct the code, or the transition in design/fsm.",
    ),
    Check(
        "fsm-seen",
        "Each transition is made in a test",
        "In the recorded calls of a test that passed on the host the Context calls the operation "
        "of the state, and the next call of a state fits the successor only. Each requirement "
        "that a transition names has such a test. No test makes a change that is not declared.",
        "which guard let a state stay; the last state of a test that calls no state afterwards; "
        "nothing is compared while results are stale.",
        "test the transition through its Context, in a test of its requirement, or correct the "
        "machine.",
    ),
    Check(
        "proof-composition",
        "The proofs speak of the machines and the code of the design",
        "Every machine of design/fsm has its step, its guards and its events in the composition "
        "design/proofs/robot.pml. Each hand-written step of the composition names methods that "
        "exist, and each of its numbers is that of the constants that it names.",
        "whether a step does the same as its methods.",
        "correct the composition, or the names of the code in it.",
    ),
    Check(
        "proof-property",
        "Properties formalise requirements that exist",
        "Each property of design/proofs/properties.toml names a requirement that exists, and its "
        "formula has only names that the observer of the composition sets.",
        "whether the formula, its sentence and its requirement mean the same.",
        "correct the property.",
    ),
    Check(
        "proof-proven",
        "Each property is proven",
        "Spin explored every state of the model, and found no sequence of events that violates "
        "the property.",
        "nothing is compared while Spin did not run on the present design.",
        "correct the design, or the formula; the page Proofs shows the counterexample.",
    ),
    Check(
        "uses-apart",
        "Controllers and sensors apart",
        "The modules that design/uses.toml keeps apart never name one another nor include the "
        "other's header: no controller a sensor, no sensor a controller.",
        "a third module that hands one to the other.",
        "let the value go through a pipe.",
    ),
    Check(
        "module-file",
        "Every file belongs to a module",
        "Every file below src and extensions is that of a module, holds data types, belongs to a "
        "composition, or is listed as shared in design/modules.toml; no function or class next to "
        "a module can be used without it; objects of a class have all variables.",
        "how long a file is.",
        "make the code a private detail of a module, or a module of its own.",
    ),
    Check(
        "module-preprocessor",
        "No macro, no condition",
        "The preprocessor includes named files and does nothing else: every product compiles the "
        "same text.",
        "the files that the build leaves out of a product; the tests of the products check them.",
        "use a constant, a template, or another module that the build chooses.",
    ),
    Check(
        "secret-open",
        "No way past the interface",
        "No module has public data that can change, nor a friend outside itself, nor an operation "
        "that gives a reference to a number of its own, through which it can be changed. No source "
        "file declares by itself a name that another one defines.",
        "an operation that gives an object or a record of the module, such as a part of a builder.",
        "make the data private and give the module an operation.",
    ),
    Check(
        "secret-hidden",
        "Hidden names stay inside",
        "A header, class, function or constant that @hides names is used by its module only; one "
        "that a logic module hides, by its folder only. No other constant has the value of a "
        "hidden one and a name of the same words.",
        "the same fact, written down a second time without a name that resembles it.",
        "call an operation of the module instead.",
    ),
    Check(
        "tree-missing",
        "Each requirement has a tree",
        "Every requirement has a tree of invocations in design/trees.",
        "whether the tree is the intended one.",
        "write the tree of the requirement.",
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
        "whether the call is ever made; calls through pointers to functions.",
        "restore the call in the code, or change the tree.",
    ),
    Check(
        "tree-order",
        "Calls are made in the order of the tree, and as often",
        "The body of each parent makes the calls in the order of the tree. A node with no mark is "
        "called by one statement that no condition guards; ? marks a call under a condition or "
        "behind one that may return, * a call in a loop or by several statements.",
        "which condition it is; the order of calls in different turns of a loop.",
        "restore the code, or correct the order or the mark in the tree.",
    ),
    Check(
        "tree-dynamic",
        "Each tree was executed",
        "The tree embeds in the recorded calls of a test that passed and that verifies the "
        "requirement: each child within the call of its parent, in order.",
        "operations that the platform implements, such as those of a port, are not recorded; "
        "nothing is compared while results are stale.",
        "correct the tree, or test the requirement so that the calls are made.",
    ),
    Check(
        "req-text",
        "Requirements are complete",
        "Every requirement has an id of its own, a sentence with a shall, @rationale, @source, and "
        "a @priority: high, medium or low.",
        "whether the sentence is clear and can be verified.",
        "write the missing part.",
    ),
    Check(
        "req-attribute",
        "Requirements have level, product and method",
        "Every requirement has one @level: system, software or driver; a @product: all, or names "
        "of products that exist; and one @method of verification: test, analysis, measurement or "
        "inspection. A test is named in the @verifies of a test; a measurement and an analysis "
        "have @evidence, or a test that makes them.",
        "whether the method suits the requirement; parts that a requirement without @partly "
        "leaves unverified.",
        "write the attribute, or correct its value.",
    ),
    Check(
        "req-number",
        "Numbers of requirements are those of the code",
        "Each number with a unit in a requirement, in digits or as a word, is linked with a "
        "constant in design/requirement_numbers.toml, and the constant has this value. The file "
        "names the other numbers with the reason why no constant has them.",
        "numbers without a unit of the list; whether the linked constant decides on the subject "
        "of the sentence.",
        "correct the constant or the requirement, or name the constant in the file.",
    ),
    Check(
        "req-source",
        "Sources are references",
        "Every @source has the form 'kind: name', several separated by semicolons. A paper names a "
        "place of design/paper.toml, a goal one of design/safety_case.toml that the requirement "
        "has as @goal, a protocol a heading of docs/protocol.rst, a data sheet one that "
        "design/safety_case.toml lists. A decision has its text.",
        "whether the source supports the requirement; a person reads that.",
        "name the source in this form.",
    ),
    Check(
        "req-satisfied",
        "Each requirement is satisfied",
        "Every requirement is named in the @satisfies of a method.",
        "whether the method really does it; the tests show that.",
        "tag the method that does the work.",
    ),
    Check(
        "req-verified",
        "Each requirement is verified",
        "Every requirement is named in the @verifies of a test.",
        "whether the test is strict enough.",
        "write a test for the requirement, or tag the one that exists.",
    ),
    Check(
        "req-method",
        "Each public method serves a requirement",
        "Every public method of a design module is tagged with @satisfies, has a node in a tree, "
        "or overrides or is overridden by one that does; a constructor serves those of its module. "
        " The others are justified in design/justified.toml.",
        "whether the method is needed for the requirement.",
        "tag the method, use it in a tree, remove it, or justify it.",
    ),
    Check(
        "req-caller",
        "Each public method has a caller",
        "Code of the firmware calls every public method of a design module, or the method that it "
        "overrides: so a builder calls each step, and uses each part. The others are justified in "
        "design/justified.toml.",
        "whether the caller runs: a call in dead code counts.",
        "call the method, remove it, or justify it.",
    ),
    Check(
        "req-test",
        "Each test verifies a requirement",
        "Every test in C++ is tagged with @verifies, or justified in design/justified.toml. The "
        "tools read the macro that begins it.",
        "whether the test is about the requirement; mutants show that.",
        "tag the test, remove it, or justify it; use a macro of tests that the tools read.",
    ),
    Check(
        "req-justified",
        "Justifications are needed",
        "Every name in design/justified.toml is that of a method, a test or a line that needs it.",
        "whether the reason is good.",
        "remove the entry, or correct its names.",
    ),
    Check(
        "req-evidence",
        "Measured requirements are met",
        "Each @evidence of a requirement names a metric that was measured in this run and keeps "
        "its bound: at most, at least or exactly.",
        "whether the metric shows the property that the requirement demands.",
        "correct the measured code, or run the command that measures it.",
    ),
    Check(
        "req-passed",
        "Verifying tests ran and passed",
        "Every test that verifies a requirement ran in the last test run and passed, and every "
        "other test ran. The build of the tests names every folder that has some.",
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
        "Results belong to these sources",
        "The last test run was made with exactly the present sources, and so was the image whose "
        "size and stack are compared.",
        "nothing: it compares contents, not dates.",
        "run ./wr test.",
    ),
    Check(
        "req-line",
        "Each line serves a requirement",
        "Each line of a method of the design is executed by a passing test of a requirement that "
        "the method serves: its tree contains the method, the method is tagged with it, or a "
        "caller of the method serves it. Other lines are justified in design/justified.toml.",
        "the drivers of the K64, whose lines the page of the virtual K64 lists; whether the test "
        "checks the effect of the line.",
        "test the line for its requirement, remove it, or justify it.",
    ),
    Check(
        "hazard-name",
        "The safety case names existing parts",
        "Each hazard has an id HZ-n, each safety goal SG-n, each assumption of use AU-n; the "
        "goals, assumptions and safe states that an entry of design/safety_case.toml names are "
        "declared there.",
        "hazards that nobody thought of.",
        "correct the name.",
    ),
    Check(
        "hazard-covered",
        "Each hazard is covered",
        "Every hazard has a safety goal or an assumption of use, and its severity, exposure and "
        "avoidance have a level in the risk graph.",
        "whether the estimates are right, and the goal sufficient.",
        "name a goal or an assumption, or complete the estimates.",
    ),
    Check(
        "hazard-goal",
        "Each safety goal is complete",
        "Every safety goal is named by a hazard, lists requirements and names a safe state.",
        "whether the requirements are enough to reach the goal.",
        "complete the goal in design/safety_case.toml.",
    ),
    Check(
        "hazard-time",
        "Times of goals are derived",
        "The fault-tolerant time of each goal is the value of its formula, rounded down by at most "
        "10 %, and the reaction of the firmware is not longer.",
        "whether distances and energies in the formula fit the robot; whether the tests measure "
        "this reaction.",
        "correct the time or the formula, or let the firmware react sooner.",
    ),
    Check(
        "hazard-requirement",
        "Goals and requirements name each other",
        "Every requirement with a @goal is listed by this goal, and every listed one exists and "
        "has the @goal.",
        "whether the requirement serves the goal. A goal whose requirements are not all verified "
        "is no finding: its page shows it as open.",
        "complete the one side or the other.",
    ),
    Check(
        "hazard-scenario",
        "Fault scenarios have goals and passed",
        "Every file of sim/scenario/safety names a safety goal that lists it, is played by a test, "
        "and passed on each target that the test is built for; every scenario that a goal lists "
        "exists. A result that is older than the sources is not counted as passed.",
        "faults that no scenario has.",
        "complete the links, play the scenario in a test, or correct the failure.",
    ),
    Check(
        "hazard-assumption",
        "Each assumption of use covers a hazard",
        "Every assumption of use is named by a hazard.",
        "whether anybody keeps to it.",
        "name it in a hazard, or remove it.",
    ),
    Check(
        "hazard-priority",
        "Safety has priority",
        "The priority of a requirement is not lower than design/safety_case.toml derives from the "
        "level of its safety goals.",
        "requirements without a goal.",
        "raise the priority.",
    ),
    Check(
        "suspect-requirement",
        "A requirement is as in its baseline",
        "The text of each requirement, its invocation tree, its transitions of state machines, its "
        "safety goals and their hazards are as they were when its baseline was recorded.",
        "whether the texts are right: a review answers that; the lines of a text.",
        "run ./wr review with the id of the requirement, or with --baseline and the id.",
    ),
    Check(
        "suspect-method",
        "Satisfying methods are as in the baseline",
        "The specifications of the methods that satisfy a requirement, the bodies of these methods "
        "and of those in its tree, and the constants of their files are as they were when the "
        "baseline was recorded.",
        "the functions that a body calls; comments in a body, and formatting.",
        "run ./wr review with the id of the requirement, or with --baseline and the id.",
    ),
    Check(
        "suspect-test",
        "Verifying tests are as in the baseline",
        "The tests that verify a requirement, their fixtures, parameters and helpers, and the "
        "scenarios that they play are as they were when the baseline was recorded.",
        "the simulator, and tests in Python; comments and formatting.",
        "run ./wr review with the id of the requirement, or with --baseline and the id.",
    ),
    Check(
        "req-review",
        "A record of a review is a review",
        "Each record in requirements/reviews.toml names a person with an address, and by git this "
        "person wrote no line of the texts; it has a remark, and an answer to each question.",
        "how well the person looked. A requirement without a review is no finding: its page "
        "shows that.",
        "remove the record, and let another person run ./wr review with the id.",
    ),
    Check(
        "paper-complete",
        "The concordance with the paper is complete",
        "Every picture, table, section and named element of the paper that design/paper.toml lists "
        "has one entry in design/concordance.toml: its place here, or why it is not here. "
        "Each arrow of the high-level diagram is named by an entry.",
        "an element that the list leaves out; it was made from the text of the paper by hand.",
        "write the entry, or correct its kind or name.",
    ),
    Check(
        "paper-statement",
        "The statements of the paper are answered",
        "Each entry of design/statements.toml names a place of the paper, and its answer "
        "exists. Each requirement whose source is a place of the paper answers a statement of it.",
        "whether the list has every statement of the paper, and whether an answer is a good one: a "
        "person compares them with the paper.",
        "correct the entry, or add the statement.",
    ),
    Check(
        "paper-stale",
        "The concordance names existing parts",
        "Every module, method, application, state machine, requirement, check and page that an "
        "entry of design/concordance.toml names exists, and so does each name in backticks in "
        "its texts. A count of modules or applications, and the value of a constant, are those of "
        "the code.",
        "whether the paper means this part; a person reads that.",
        "name the part that replaced it.",
    ),
    Check(
        "paper-alias",
        "Other names than the paper's have a reason",
        "A module, method or state whose name here is not the paper's, and an application with "
        "another title, has an alias with the reason, and no other one has.",
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
        "link-doc",
        "Links of hand-written pages",
        "Every reference in docs/ has a target, and every file that a page of docs/, the README or "
        "a text of design/ names by its path is there. Each command of ./wr that a page or the "
        "README names exists, with its options.",
        "whether the target is the right one.",
        "correct the target.",
    ),
    Check(
        "link-site",
        "Links of the site",
        "Every link of every page of the site, diagrams included, has a page and an anchor, and so "
        "has every click of design/questions.toml.",
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
            "intent: it compares the shape of the code only.",
            f"{entry['fix']}.",
        )
        for entry, _ in entries
    ]


CHECKS = [*_FIXED, *_clauses()]
KNOWN = {check.id: check for check in CHECKS}
