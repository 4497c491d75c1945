"""The list of all checks. Each entry states the rule, the limits of the check, and how to fix a
finding."""

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
    reason: str = ""  # reason for this check, if the reason of its family does not fit
    result: str = ""  # address of the section that shows the values that the check examines

    @property
    def why(self) -> str:
        """Returns the reason why this check or its family exists."""
        return self.reason or WHY[self.id.split("-", maxsplit=1)[0]]

    @property
    def text(self) -> str:
        """Returns the complete description of the check as plain text."""
        return f"{self.holds} {self.blind} To fix a finding: {self.fix}"


# The purpose of each family of checks. The first word of a check's id is the name of its family.
WHY = {
    "syntax": "Most checks read the syntax tree of the code. They need a tree without errors.",
    "design": "The checks compare design/ with the code. They cannot compare a file that they "
    "cannot read.",
    "doc": "The pages are generated from the comments of the code, the texts of design/ and the "
    "files of docs/. A mistake in such a text is also on the pages.",
    "module": "A developer can find, understand and replace a small module that has a known place "
    "and a specification. To do this, the developer need not read the other modules.",
    "secret": "Each module hides a design decision, its secret. Only this module uses the names "
    "that belong to the secret. If another module uses these names, a change of the decision also "
    "changes that other module.",
    "pattern": "A pattern makes changes easy only while the code has the structure of the pattern. "
    "Each clause states a part of this structure.",
    "change": "A developer who changes a value must find the other values that depend on it. An "
    "example of a likely change shows which files a developer must edit.",
    "uses": "The allowed uses of a module show two facts: which modules must be reused together "
    "with it, and which changes can break it.",
    "board": "In the tests, the virtual K64 replaces the hardware. If the virtual K64 does not "
    "detect a mistake, the mistake can reach the robot.",
    "tree": "An invocation tree shows the calls by which the code fulfils a requirement. The code "
    "must contain these calls, and a test must execute them.",
    "fsm": "People read the declared state machine instead of the code of the states. Therefore, "
    "the machine and the code must have the same transitions.",
    "proof": "A test checks only some sequences of events. A proof checks all sequences that are "
    "possible in the model.",
    "exec": "Interrupts and threads of different priorities share data. A wrong access may cause a "
    "fault only once in a thousand cycles. Tests may not find such a fault.",
    "stack": "The threads and interrupts share one stack. The stack must be large enough for the "
    "deepest calls. It is possible that no test makes these calls.",
    "time": "A cycle that is too long disturbs the control. It is possible that no test contains "
    "the longest cycle.",
    "req": "A requirement is regarded as fulfilled only if the code, the tests and the test "
    "results show this.",
    "test": "People read the brief of a test instead of its code. The brief must describe the test "
    "that was executed.",
    "suspect": "A verdict is valid only for the texts that were judged. The checks compare the "
    "present texts with the baseline, and find the texts that have changed.",
    "hazard": "The safety case leads from each hazard to tests that ran. If a link in this chain "
    "is missing, the argument is invalid, and a reader may not notice the gap.",
    "paper": "The paper describes the design that this project implements. The project uses the "
    "names of the paper, or explains why a name is different.",
    "arch": "The architecture is the first picture that a newcomer sees. It must match the code.",
    "link": "A reader who follows a link must find the target.",
}

_TEXT_BLIND = (
    "The check cannot judge whether the texts are true and useful. Only a reader can judge this."
)

_FIXED = [
    Check(
        "syntax-error",
        "Code without errors",
        "The syntax tree of every file below src and extensions has no error.",
        "The check does not find an error that only occurs with another compiler or target.",
        "correct the code as the message explains.",
    ),
    Check(
        "doc-warning",
        "Documentation comments and pages without warnings",
        "Doxygen and Sphinx read every comment and every page without a warning. Each @param names "
        "a parameter. Each tag is defined in this project. Each link has a target. If the sentence "
        "before a list on a page states the number of the items, the list has this number of "
        "items. If a text states the total number of hazards, safety goals, assumptions of use, "
        "products, modules, design patterns, applications, state machines, or scenarios of the "
        "paper, this number is right.",
        _TEXT_BLIND,
        "correct the comment or the page as the message explains.",
    ),
    Check(
        "doc-number",
        "Numbers of ports agree with their code",
        "In the README of a port, each number with a unit is the value of a constant with this "
        "kind of unit. The constant is in the folder of the port, or in SystemConstants.",
        "The check cannot judge whether the number belongs to the sentence. It does not find a "
        "number whose unit is on the next line, or whose unit is not in the list of "
        "requirement_numbers.py.",
        "correct the number, or write the unit of the constant in square brackets next to it.",
    ),
    Check(
        "doc-lock",
        "The lists of packages contain the demanded packages",
        "For each package that setup/python.in or setup/strictdoc.in demands, the lock file next "
        "to this file contains a permitted version. For each package or library that CMake "
        "demands, setup/debian.txt contains a package with this name.",
        "The check does not find a package that nobody demands. It does not find a missing package "
        "for a program that a command starts.",
        "make the lock file again, as the comment at the head of the file describes.",
    ),
    Check(
        "doc-name",
        "Names in texts exist in the code",
        "If a text names a class, method, function, constant or value, this name exists in the "
        "code or in the paper. The texts are the comments of the code and the texts of design/. In "
        "pages, the check reads only literals and names of the form Class::method. If a page or a "
        "text of design/ names a test, this test exists. If a page states that a class derives "
        "from another class, this is true. Each constant and formula that a text of design/ "
        "inserts has a value. If a page names an attribute of a report, the classes of the client "
        "have this attribute. The table of these attributes in docs/client.rst is complete. mypy "
        "finds no wrong name, parameter or type in the Python examples on the pages. If a comment "
        "of a module names a function without a class, such as start(), the function is in the "
        "files of this module, or is a method of a module that this module uses. `paper-stale` "
        "checks the names in design/concordance.toml. `pattern-change` checks the names in "
        "design/changes.toml.",
        "The check does not find a wrong name that is also an English word. It does not find a "
        "name whose meaning has changed. In a Python example, it does not check names that come "
        "from packages other than the client.",
        "write the name that the code has now.",
    ),
    Check(
        "design-entry",
        "The files of the design can be read",
        "Every file of design/ exists and is valid TOML. Each entry has all keys that it needs, "
        "and no other keys. No required text is empty. No name has two entries. Each review has a "
        "date.",
        "The check cannot judge whether an entry is true. The other checks compare the entries "
        "with the code. Most of these checks do not run while a file cannot be read.",
        "correct the line, or the name of the key.",
    ),
    Check(
        "module-logic",
        "Each design module is in a logic module",
        "Below src and extensions, every class with a separate header is in a folder that has a "
        "module.dox.",
        "The check cannot judge whether the header is in the right folder. The designer decides "
        "this.",
        "move the header into the folder of its logic module, or describe the folder in a "
        "module.dox.",
    ),
    Check(
        "module-folder",
        "Each logic module has a function and a secret",
        "The module.dox of every folder states @brief, @function and @secret. The @secret differs "
        "from the other two texts. No two folders have the same @secret.",
        _TEXT_BLIND,
        "write the missing paragraph in the module.dox of the folder.",
    ),
    Check(
        "module-function",
        "Each design module has a function",
        "The comment above every design module has @brief and one @function. No two modules have "
        "the same @function.",
        _TEXT_BLIND,
        "write @brief above the class, and a @function that no other module has.",
    ),
    Check(
        "module-secret",
        "Each design module has exactly one secret",
        "The comment above every design module has exactly one @secret, which differs from the "
        "@function and the @brief. No two modules have the same @secret.",
        "The check cannot judge whether the code really hides the stated change from the other "
        "modules.",
        "write @secret above the class, and state the one likely change that only this module "
        "hides.",
    ),
    Check(
        "module-spec",
        "Each public method has a specification",
        "Every public method of a design module has a brief, a text for each parameter, and a text "
        "for its result. A constructor that only stores its arguments needs no brief. Every method "
        "except a constructor has @isr, which states whether interrupts may call it. The texts are "
        "in the comment of the method, or in the comment of the overridden method. If a parameter "
        "or a result is a plain number, its text states the unit or the counted items. If the type "
        "of a parameter has a unit (for example Velocity), the text of the parameter states this "
        "unit. Each unit in a text equals the unit of the type. Every other public part of a "
        "header has a brief: classes, types, functions, members, constants and friends. If one "
        "value of an enumeration has a brief, all its values have a brief.",
        f"{_TEXT_BLIND} The check does not find a constructor that needs a brief and has none.",
        "make the declaration private, or complete the comment above it.",
    ),
    Check(
        "module-name",
        "A header is named after its class",
        "Every design module has the name of its header, and no header contains two modules.",
        "The check cannot judge whether the name is good.",
        "rename the file or the class, or mark a value type with @datatype.",
    ),
    Check(
        "module-count",
        "design/modules.toml lists every design module, and no others",
        "design/modules.toml lists every design module below src, under the folder of the module. "
        "Every listed module exists and is not a data type. The number of listed modules equals "
        "the number in the paper. Modules of extensions are not counted.",
        "The check cannot judge whether the list is correct.",
        "remove the module, mark a value type with @datatype, or add the module to "
        "design/modules.toml and increase the key total of this file.",
    ),
    Check(
        "module-used",
        "Each design module is part of a product",
        "Every design module is used: a composition names the module, or a used module names it. "
        "If a member of a class is an object of a design module, the member is used or passed on. "
        "If design/products.toml lists a module, this module exists. The file lists every concrete "
        "class of the extensions.",
        "The check does not detect whether the product ever executes the code of the module. It "
        "also does not detect whether CMake builds the composition.",
        "let a builder construct the module, or remove the module.",
    ),
    Check(
        "module-errors",
        "A documented assertion is in the code",
        "If @errors of a method names an assertion, this assertion is in the method, or in a "
        "function that the method calls directly or indirectly.",
        "The check does not detect that an assertion is missing in @errors. It does not detect "
        "whether the stated condition is the condition of the assertion. It reads only methods of "
        "the product weeding_robot.",
        "name the assertion that the code has.",
    ),
    Check(
        "module-swapped",
        "No parts are swapped",
        "In src, extensions and ports, the check compares the name of each initialised member or "
        "variable with its value. In an aggregate, the value of a member is not an object with the "
        "name of another member. For example, the value of step is not direction. If the name and "
        "the value have a common word, and the name contains one word of a pair, the value does "
        "not contain the other word of this pair. For example, the value of leftEnd is not "
        "steering_right_end. The pairs are left and right, front and rear, inner and outer, "
        "forward and backward, upper and lower, first and second, A and B, step and direction, "
        "velocity and direction.",
        "The check does not find swapped arguments of a function. It does not find swapped parts "
        "if their names do not contain such words.",
        "correct the value, or rename the part.",
        reason="Two parts of the same type can be swapped without an error of the compiler. On "
        "the robot, such a fault moves the wrong part.",
    ),
    Check(
        "module-data",
        "A data type has no behaviour",
        "No method of a data type has a condition, a switch or a loop.",
        "If a computation contains neither a condition nor a loop, the check does not find this "
        "computation. The check also does not find a free function that works on the data.",
        "move the behaviour into a module.",
    ),
    Check(
        "pattern-known",
        "Each pattern application is declared",
        "Every @patternapp has a title, @why, @changes, and the id and the pattern of an entry in "
        "design/applications.toml. The tag is above the abstract class of the pattern. If several "
        "applications share one abstract class, each tag is above a subclass. Every entry of "
        "design/applications.toml has exactly one @patternapp. Every clause in design/clauses.toml "
        "has a function that checks it, and every such function has a clause. A clause names its "
        "pattern, and only roles of this pattern.",
        _TEXT_BLIND,
        "correct the id or the pattern, or add the missing paragraph.",
    ),
    Check(
        "change-tuned",
        "Each tuned constant is declared",
        "The check assumes in two cases that the value of a constant depends on SystemConstants. "
        "In the first case, the name or the comment of the constant mentions control cycles or "
        "ticks. In the second case, the constant is a time or a number of bytes in a requirement "
        'whose rationale counts cycles, as in "for three cycles". In both cases, the code computes '
        "the value from SystemConstants, or design/tuned.toml declares the dependence. Each "
        "constant and each source line in design/tuned.toml exists. The page about a change of "
        "SystemConstants lists the computed and the declared values.",
        "Sometimes a value depends on another constant, but neither the name, nor the comment, nor "
        "the rationale of its requirement shows this. The check does not find such a value. It "
        "reads no source file outside src and extensions.",
        "compute the value from the constant, or declare it in design/tuned.toml.",
    ),
    Check(
        "pattern-change",
        "Each likely change names only parts that exist",
        "Every pattern has a recipe in design/changes.toml. The recipe lists roles of the pattern: "
        "those of the subclasses that a change adds or alters, and those of their base classes. An "
        "entry for an application names this application, modules with a role in the application, "
        "and modules of extensions as examples. All these parts exist. Each name in backticks in a "
        "step exists.",
        "The check cannot judge whether the steps are sufficient.",
        "correct the name.",
    ),
    Check(
        "change-kit",
        "Each likely change has an example",
        "For each application of a pattern, changes/ contains a folder with the id of the "
        "application. The files in the folder make the likely change. The folder names a class "
        "that derives from a base class of the recipe, or the folder edits a module that the "
        "recipe lists as altered. The folder names tests on the host and on the virtual K64, and "
        "these tests exist. If the change edits existing files, the folder states the reason.",
        "The check cannot judge whether the change is likely, or whether the tests of the change "
        "find a fault in it.",
        "complete the folder of the change as changes/README.md explains.",
    ),
    Check(
        "pattern-role-unknown",
        "Each @role is declared",
        "Every @role names a declared application, and a role of the application's pattern. No tag "
        "is written twice. The tag is above a module to which design/applications.toml assigns "
        "this role, or above a module of an extension.",
        "The check does not find a class that plays a role in a pattern but has no @role. The "
        "clauses of the pattern find some of these classes.",
        "correct the application or the role in the tag, or change design/applications.toml.",
    ),
    Check(
        "pattern-role-missing",
        "Every assigned role has a tag",
        "If the design assigns a module to a role of a pattern application, the comment of the "
        "module contains the tag @role for this role.",
        "The check does not find a role that the design does not list. `pattern-role-required` "
        "finds such a role.",
        "write the tag @role above the class.",
    ),
    Check(
        "pattern-role-required",
        "Every role of the pattern has a module",
        "Every application in design/applications.toml assigns each role of its pattern to modules "
        "that exist. It assigns no other role.",
        "The check cannot judge whether the module has the function of the role. The clauses of "
        "the pattern find some wrong modules.",
        "assign a module to the role in design/applications.toml, or correct the name of the "
        "module.",
    ),
    Check(
        "pattern-count",
        "Each pattern has as many applications as in the paper",
        "Each pattern has the number of applications that design/clauses.toml states.",
        "The check does not count applications of extensions. Extensions add modules to the "
        "existing applications.",
        "correct the entries of design/applications.toml.",
    ),
    Check(
        "pattern-subclass-unbound",
        "Every subclass has a role",
        "If a class has an abstract role in a pattern application (for example Strategy), every "
        "subclass has the role of a subclass (for example Concrete Strategy). For a State, a "
        "Strategy or an Abstract Class, the subclass needs this role in each application of the "
        "base class. There are two exceptions. A decorator, or a component that is decorated, "
        "needs a role in only one application. A Command that is nested in a module contains only "
        "the code of a thread, and needs no role.",
        "The check cannot judge whether the subclass has the right role.",
        "write a @role above the subclass, or derive the subclass from another class.",
    ),
    Check(
        "uses-allowed",
        "Each use of another logic module is allowed",
        "If the code of a logic module includes, calls or names a class of another logic module, "
        "design/uses.toml allows this use.",
        "A use without a name is not found, for example an access to a fixed address.",
        "remove the include or the call, or allow the use with a reason.",
    ),
    Check(
        "uses-extension",
        "Nothing depends on an extension",
        "No file of src includes or calls an extension. No file of src contains a number that an "
        "extension adds to an enumeration. A product can therefore omit the extension. An "
        "extension uses another extension only where design/uses.toml states the reason.",
        "The check does not compare the parts that the linker adds to the image of a product. "
        "Tests of the products check these parts.",
        "remove the include or the call. A composition of the extension must connect the "
        "extension to the robot.",
    ),
    Check(
        "uses-board",
        "Drivers and virtual board are independent",
        "No file of sim/ or tests/ includes a file that is only for the K64. No file of "
        "sim/emulator includes a file of the design, because a driver and the model of its device "
        "must not contain the same mistake. The programs of tests/k64/program and "
        "tests/usual_design/k64 are exceptions: they contain drivers and run on the virtual K64. "
        "In src, `uses-allowed` checks which modules use src/k64. Outside the folders of the K64, "
        "no file of src and extensions contains the name of a driver or of the microcontroller, "
        "not even in a comment.",
        "The check does not find the same wrong number in a driver and in the model of the device.",
        "write the numbers from the manual of the microcontroller, or test the firmware image on "
        "the virtual K64.",
    ),
    Check(
        "secret-registers",
        "A block of registers has owners",
        "design/register_owners.toml lists the owners of each namespace of src/k64/registers.hpp. "
        "Only the owners use the namespace, and each owner uses it. No address is in two "
        "namespaces. Only src/k64/registers.hpp defines registers, and no linker script contains "
        "an address in the range of the registers. Only src/k64/Register.hpp converts a number to "
        "an address, or names a volatile object. No module passes a register to another module. No "
        "offset leads from one block of registers to another block. Assembler instructions are "
        "only in the drivers. Of these instructions, only the instructions of the start-up code "
        "access memory.",
        "If a block has several owners, the check does not detect which channel or pin each owner "
        "uses. It does not follow an offset that is computed elsewhere. It does not detect that a "
        "register has an effect on another block.",
        "call an operation of the owner, or change the design.",
    ),
    Check(
        "board-finding",
        "Each finding of the virtual K64 has a test",
        "For every finding in design/board_findings.toml, a test of tests/sim/emulator names the "
        "finding. If a seeded fault of a driver caused a finding, design/board_findings.toml "
        "declares this finding.",
        "The check does not detect whether the test really causes the finding. The result of the "
        "test shows this.",
        "write a test that causes the finding, or declare the finding.",
    ),
    Check(
        "board-belief",
        "Each belief of the virtual K64 has a source",
        "A belief is an assumption of the virtual K64 about the hardware. Every belief in "
        "design/board_beliefs.toml names a register of src/k64/registers.hpp, a file of "
        "sim/emulator that contains this register, and a declared source. Every register of "
        "src/k64/registers.hpp has a belief.",
        "The check does not detect that design/board_beliefs.toml lacks a value of a register. It "
        "cannot judge whether the source confirms the belief.",
        "correct the entry, or add an entry with its source.",
    ),
    Check(
        "uses-cycle",
        "No cycles of uses",
        "The uses between the top folders form no cycle. Inside a top folder, "
        "design/uses.toml declares each cycle.",
        "The check does not find cycles between classes of one folder.",
        "remove one of the uses, or declare the cycle in design/uses.toml with the pattern that "
        "causes it.",
    ),
    Check(
        "uses-unused",
        "Each allowed use occurs in the code",
        "If design/uses.toml allows a use, this use occurs in the code, and only one entry allows "
        "it. Every declared cycle exists in the code, within the declared folder.",
        "The check cannot judge whether the declared reason is good.",
        "remove the entry.",
    ),
    Check(
        "arch-module",
        "The architecture names modules that exist and are connected",
        "If an element, a group or a connection in design/architecture.toml names a module, this "
        "module exists. If a connection names a connector, this connector exists as an element. A "
        "module of a controller, process, sensor or event is in a connection or a group, and "
        "belongs to only one of these elements. Each command goes from a module of a controller to "
        "a module of a process. Each physical connection begins at a module of a process, and ends "
        "at a module of a sensor. Each process has a physical connection.",
        "The check cannot judge whether two connected modules belong to the same element.",
        "correct the name, or the connection.",
    ),
    Check(
        "arch-code",
        "Connections of the high-level diagram are in the code",
        "For each declared connection between two modules, the code contains calls from the first "
        "module to the second module, through the methods that the connection names. If the kind "
        "of the connection is pipe, the first module writes the pipe and the second module reads "
        "it.",
        "The check does not read physical connections. It does not distinguish the kinds call, "
        "command and interrupt. If the code contains a connection that the architecture does not "
        "declare, the check does not find this connection.",
        "correct the connection, or the code.",
    ),
    Check(
        "exec-declared",
        "Contexts, pipes and protections are declared",
        "Every handler in the vector table belongs to one context of design/execution.toml, "
        "and a call enables the interrupt line of this handler. If design/execution.toml names a "
        "handler, a thread body or a shared member, the code contains this part. The program that "
        "runs after a reset calls the idle program. The interrupt lines of a context have the "
        "declared priority of the context. Each pipe of the robot has a name.",
        "The check does not read handlers of products that have other interrupts.",
        "correct the entry, or declare the missing part.",
    ),
    Check(
        "exec-isr",
        "No interrupt calls a forbidden method",
        "The handler of an interrupt never reaches a method with @isr{no}. A method with "
        "@isr{yes} never calls a method with @isr{no}. If the code calls a method of an abstract "
        "class, the check follows the call to the objects that the builders passed.",
        "The check does not follow calls through pointers to functions. It reads only the product "
        "weeding_robot. It does not find methods without @isr, and it cannot judge whether "
        "@isr{yes} is true.",
        "let a thread call the method, or make the method safe for interrupts and write @isr{yes}.",
    ),
    Check(
        "exec-float",
        "No floating point in an interrupt",
        "If the handler of an interrupt reaches a function, this function uses no floating-point "
        "numbers.",
        "The check does not read functions of the toolchain. It does not follow calls through "
        "pointers to functions. It reads only the product weeding_robot.",
        "compute with integers.",
    ),
    Check(
        "exec-loop",
        "Each loop is bounded",
        "Each loop is a `for` with a condition, or its function is in design/justified.toml. The "
        "entry of this function states why the loop ends, or why it is endless.",
        "The check does not prove that the condition of a `for` becomes false.",
        "count the iterations in the head of the loop, or state in design/justified.toml why the "
        "loop ends.",
        "If a loop does not end, it blocks its thread or interrupt forever. The longest time of a "
        "cycle can be computed only if each loop has a greatest number of iterations.",
    ),
    Check(
        "exec-heap",
        "No heap in the source",
        "No file of src or extensions uses new, delete, malloc or free. Some types of the standard "
        "library, for example std::function, allocate memory. No file of src or extensions "
        "contains the name of such a type, or includes its header.",
        "The check does not find library code that allocates memory internally. The symbols of "
        "the firmware image show such code.",
        "use an array of fixed size or a std::optional.",
        "A heap can run out of memory while the robot drives, and an allocation has no bounded "
        "time. Without a heap, the linker fixes the addresses of all data outside the stack.",
    ),
    Check(
        "exec-shared",
        "Shared data of contexts is protected",
        "If one context changes a member and another context uses this member, the member is a "
        "Pipe, or design/execution.toml declares its protection. If a member is declared as "
        "atomic, its type is atomic. If a member is declared as masked, each function that uses "
        "the member blocks the interrupts. If only its writes are declared as masked, each "
        "function that changes the member blocks the interrupts. The idle program is also regarded "
        "as a context. Exactly one context writes each pipe, and exactly one context reads it.",
        "The check does not find a change in the standard library. It also does not find a change "
        "that code makes through a reference parameter. It reads only the product weeding_robot. "
        "It cannot judge whether the protection is sufficient. It does not compare two threads of "
        "the same kind, such as the threads of two wheels. After a reset, the program starts the "
        "timers and the sensors when the interrupts are already enabled. The check does not read "
        "the calls that start these timers and sensors. It does not read members of data types. "
        "Instead, it reads the members in which modules store values of these data types.",
        "put a Pipe between the contexts, or declare the protection in design/execution.toml.",
    ),
    Check(
        "stack-call",
        "The targets of each indirect call are declared or found in the code",
        "The compiler lists the indirect calls of the firmware image. The possible targets of each "
        "of these calls are known in one of two ways. A builder passed the object whose virtual "
        "method is called, or design/stack.toml declares the targets. The compiler reported the "
        "stack frame of each function of the project.",
        "The check reads only the firmware image of weeding_robot. It reports nothing if this "
        "image was not built from the present sources.",
        "call an object that a builder passes, or declare the call in design/stack.toml.",
    ),
    Check(
        "stack-recursion",
        "No function of the firmware image calls itself",
        "No function calls itself, directly or through functions of its file. No chain of calls "
        "from a handler enters a function twice. A chain of decorators passes at most once through "
        "each Concrete Decorator of its application.",
        "The check does not find a decorator object that decorates another object of the same "
        "class. It reads only the firmware image of weeding_robot. If this image was not built "
        "from the present sources, the check reads the source files instead, and finds only "
        "functions that call themselves directly or through functions of their file.",
        "write a loop with a bound.",
    ),
    Check(
        "stack-bound",
        "The stack is large enough for the worst case",
        "For each interrupt priority, the deepest chain of calls is computed. The stack has at "
        "least as many bytes as these chains need together. Each stack frame has a known size. No "
        "closed-loop run used more bytes of the stack than computed.",
        "The check does not count the stack that is needed if a second fault occurs in a fault "
        "handler. It reads only the firmware image of weeding_robot.",
        "raise stackSize in the linker script, or shorten the deepest chain.",
        result="execution.html#stack",
    ),
    Check(
        "time-bound",
        "Each loop of the firmware image has a bound",
        "If a handler of the firmware image reaches a loop, or a memory copy of unknown size, this "
        "loop or copy has a bound. The bound is the constant in the head of the loop, or a comment "
        "above the loop or the copy declares the bound. For a loop over a std::array, the declared "
        "bound is not lower than the number of elements. There is one exception: if a loop reads "
        "only the first elements, a formula or a name can declare a lower bound. The target of "
        "each indirect call is known. No lock of the interrupts contains a loop or a call.",
        "If a loop does not read a std::array, the check cannot judge whether the declared bound "
        "is right. It does not read loops that run only before the first interrupt. It reads only "
        "the firmware image of weeding_robot.",
        "write the bound above the loop.",
    ),
    Check(
        "time-seen",
        "No run needs more time than the bound",
        "No measured control cycle took longer than the computed bound of the control cycle. In "
        "the runs of the bench and in the tests of the firmware image, the measured time lasts "
        "until the report of the cycle. In the published random drives, the measured time lasts "
        "until the main thread ends. Random drives with noise at the inputs have a larger bound, "
        "which includes the interrupts that the noise causes. The recorded time of each path is at "
        "most the computed bound of this path. In each recording, each interrupt occurs at most as "
        "often as design/times.toml states.",
        "The check does not detect that an interrupt can occur more often than in a recording. The "
        "bounds apply only to weeding_robot.",
        "find the bound that is too small and correct it: the declared bound of a loop, or a "
        "number in design/times.toml.",
    ),
    Check(
        "fsm-declared",
        "Each state machine names only parts that exist",
        "Every application of the State pattern has a machine in design/fsm. Its states are the "
        "Concrete States of the application. Each event refers to an operation of the State. The "
        "states, the event and the requirement of each transition exist. A method serves a "
        "requirement if its @satisfies names the requirement or if the tree of the requirement "
        "contains the method. For the requirement of a transition, two conditions are true. A "
        "method of the old or the new state serves the requirement. The operation of the event, or "
        "a method of the action, also serves the requirement. Each event occurs in a transition. "
        "If a state has several transitions at the same event, guards distinguish these "
        "transitions. If a transition contains a number with a unit, such as 2 s, a requirement of "
        "the transition states the same number.",
        "The check cannot judge the meaning of guards and actions.",
        "correct the entry, or declare the machine.",
    ),
    Check(
        "fsm-code",
        "The transitions in design/fsm agree with the code",
        "The file of a machine in design/fsm declares its transitions. For each operation of a "
        "state and each successor, the number of state changes in the code equals the number of "
        "declared transitions. One operation of the Context assigns the state. A state change is a "
        "call of this operation. The successor is the object that a builder passed to the state. "
        "The builder passes the initial state to the Context. If an operation changes the state on "
        "every path, no declared transition of this operation stays in the state. If an operation "
        "of a state has only one declared transition, the check compares the condition of this "
        "transition. A guard, or an event with a time, is a condition. The transition has a "
        "condition if the code makes the change on some paths only. The transition has no "
        "condition if the code makes the change on every path. If several transitions of a state "
        "have the same event, they are declared in the order in which the code evaluates their "
        "guards. A guard that names a state of another machine, such as 'in Reconnecting', is not "
        "compared. The table [guards] of the file lists the conditions of each guard. Before each "
        "change, the code checks the conditions of the guard. The table [actions] of the file "
        "lists the methods of each action. Before each change, the code calls the methods of the "
        "action. If an operation calls a method of this table, a transition of the operation has "
        "the action of this method. A function that changes the state can call such a method on "
        "every path to the change. If a path contains an earlier change, the call is after the "
        "earlier change. In this case, the transition of the later change has the action of this "
        "method.",
        "The check cannot judge whether the name of a guard or of an action fits the code. It "
        "does not detect whether the code inverts a condition. It does not read states that "
        "extensions add.",
        "correct the code, or the transition in design/fsm.",
    ),
    Check(
        "fsm-seen",
        "Each transition occurs in a test",
        "Each transition occurred in a passing test on the host. The recorded calls of the "
        "test show the transition: the Context calls the operation of the old state, and then "
        "calls methods of the new state. Of all states, only the new state has all these methods. "
        "If a transition names a requirement, a test of this requirement makes the transition. "
        "Each change of the state in a test is a declared transition.",
        "The check does not detect which guard prevented a change of the state. It does not find "
        "a change of the state if the test calls no state after the change. It compares nothing "
        "while the test results are older than the sources.",
        "let a test of the requirement make the transition through the Context, or correct the "
        "machine.",
    ),
    Check(
        "proof-model",
        "The model of the proofs matches the machines and the code",
        "design/proofs/robot.pml uses the step, the guards and the events of every machine of "
        "design/fsm. Each step in this file lists methods that exist. Each number in this file "
        "equals the constant that the comment of the number names.",
        "The check does not prove that a step of the model behaves like the methods that the step "
        "names.",
        "correct design/proofs/robot.pml, or the names of methods and constants in this file.",
    ),
    Check(
        "proof-property",
        "Properties formalise requirements that exist",
        "Each property of design/proofs/properties.toml names a requirement that exists. The "
        "formula of the property uses only names that the observer in design/proofs/robot.pml "
        "sets.",
        "The check cannot judge whether the formula, its sentence and its requirement mean the "
        "same.",
        "correct the property.",
    ),
    Check(
        "proof-proven",
        "Each property is proven",
        "Spin explored every state of the model and found no sequence of events that violates the "
        "property.",
        "The check ignores proofs of an older design. It reports nothing until Spin has run on the "
        "present design.",
        "correct the design, or the formula; the page 'Proofs' shows the counterexample.",
    ),
    Check(
        "uses-apart",
        "Controllers and sensors are independent",
        "If design/uses.toml separates two modules, neither module names the other module or "
        "includes its header. No controller names a sensor, and no sensor names a controller.",
        "The check does not find a third module from which a controller receives a reference to a "
        "sensor, or from which a sensor receives a reference to a controller.",
        "pass the value through a pipe.",
    ),
    Check(
        "module-file",
        "Every file belongs to a module",
        "Every file below src and extensions belongs to a module, contains data types, belongs to "
        "a composition, or is listed as shared in design/modules.toml. The file of a module can "
        "contain functions and classes outside the class of the module. Other files cannot use "
        "these functions and classes. Operators are an exception: other files can use them. If a "
        "variable in the file of a module exists as long as the program, it is a member, a "
        "constant or a reference, or it has its own section of the memory.",
        "The check does not limit the length of a file.",
        "make the code a private part of a module, a separate module, or a @datatype.",
    ),
    Check(
        "module-preprocessor",
        "No macros and no conditional compilation",
        "The preprocessor is used only to include named files, and for #pragma once. Therefore, "
        "every product compiles the same text.",
        "The check does not detect which files the build includes in a product. The tests of the "
        "products check this.",
        "use a constant, a template, or separate modules from which the build chooses.",
    ),
    Check(
        "secret-open",
        "No access except through the interface",
        "No module has public variables. Each friend of a module is nested in this module. A type "
        "is plain if it contains no class of the project. An example is the type of a number. No "
        "operation returns a reference or a pointer with which a caller can change a member of a "
        "plain type. No source file declares a name that another source file defines.",
        "The check does not find an operation that returns a reference to a whole object inside "
        "the module, such as an object that a builder contains.",
        "make the data private and add an operation to the module.",
    ),
    Check(
        "secret-hidden",
        "Only the owner uses a hidden name",
        "If a module lists a header, class, function or constant in @hides, only this module uses "
        "it. If a logic module lists a name in @hides, only files of its folder use this name. If "
        "@hides lists a constant, no constant in another file has the same value and a similar "
        "name.",
        "The check does not find a second constant or function that states the same fact under a "
        "different name. It does not compare constants with a value of at most 1.",
        "call an operation of the module instead.",
    ),
    Check(
        "tree-missing",
        "Each functional requirement has a tree",
        "Every requirement FR-n has a tree of invocations in design/trees.",
        "The check cannot judge whether the tree shows the intended calls.",
        "write the tree of the requirement in design/trees.",
    ),
    Check(
        "tree-node",
        "Each tree names only methods that exist",
        "Every tree belongs to a requirement. Every node names a method that the named class "
        "declares or inherits. No requirement has two trees.",
        "The check does not distinguish overloads: if several methods of a class have the same "
        "name, it regards them as one method.",
        "correct the name in the tree.",
    ),
    Check(
        "tree-static",
        "Each edge of a tree is a possible call",
        "For each edge of a tree, the body of the parent method contains a call that can execute "
        "the child method. A call of a virtual method executes the methods of the objects that the "
        "constructors of the products connect. If no such object is found, the check assumes that "
        "the call can execute every overriding method.",
        "The check does not detect whether the call is ever executed. It does not follow calls "
        "through pointers to functions.",
        "restore the call in the code, or change the tree.",
    ),
    Check(
        "tree-order",
        "The order and the number of calls match the tree",
        "The body of each parent makes the calls in the order of the tree. If a node has no mark, "
        "one statement without a condition calls the method of the node. The mark ? means a "
        "conditional call, or a call after a conditional return. The mark * means a call in a loop "
        "or by several statements.",
        "The check does not detect which condition guards the call, or the order of calls in "
        "different iterations of a loop.",
        "restore the code, or correct the order or the mark in the tree.",
    ),
    Check(
        "tree-chain",
        "Each chain of recorded calls is possible",
        "In a chain of design/recordings.toml, an enclosing step can call each inner step, "
        "directly or indirectly.",
        "The check does not detect a wrong order of steps that have the same enclosing step. The "
        "next recording detects it.",
        "correct the order of the steps in the chain.",
    ),
    Check(
        "tree-dynamic",
        "Each tree was executed",
        "At least one test of the requirement has passed, and its recorded calls contain all calls "
        "of the tree. Each child is called during the call of its parent, and the children are "
        "called in the order of the tree.",
        "Some operations, such as reading a pin, exist only in the drivers of the K64, and not on "
        "the host. In a test on the host, the check ignores these operations. It compares nothing "
        "while the test results are older than the sources.",
        "correct the tree, or make the calls in a test of the requirement.",
    ),
    Check(
        "req-text",
        "Requirements are complete",
        "Every requirement has a unique id, a sentence with the word shall, @rationale, @source "
        "and @priority. The priority is high, medium or low.",
        "The check cannot judge whether the sentence is clear and can be verified.",
        "write the missing part of the requirement.",
    ),
    Check(
        "req-attribute",
        "Requirements have level, product and method",
        "Every requirement has one @level: system, software or driver. It has a @product: all, or "
        "names of products that exist. If a product contains all modules that satisfy a "
        "requirement FR-n, the @product of the requirement names this product. Each named product "
        "contains at least one of these modules. Every requirement has one @method of "
        "verification: test, analysis, measurement or inspection. If the method is test, the "
        "@verifies of a test names the requirement. If the method is measurement or analysis, the "
        "requirement has @evidence.",
        "The check cannot judge whether the method suits the requirement. It does not detect that "
        "@partly is missing although a part of the requirement is not verified.",
        "write the attribute, or correct its value.",
    ),
    Check(
        "module-number",
        "Numbers of specifications agree with the code",
        "In the comments of a module and of its methods, the check reads each number with a unit, "
        "and each limit of a range such as '[mV], 0 to 24000'. A constant or a requirement states "
        "the same number. The constant belongs to the module, to a module that this module uses, "
        "or to SystemConstants. The module satisfies this requirement. The number is in the text "
        "or in the rationale of the requirement.",
        "The check cannot judge whether the number belongs to the sentence. It does not read a "
        "sentence that begins with 'Assumption:'. It omits 100 %, and each number that is not "
        "greater than one smallest unit, such as 0.01 degree.",
        "correct the number, or name the constant in the comment instead of the number.",
    ),
    Check(
        "req-number",
        "Numbers of requirements agree with the code",
        "In design/requirement_numbers.toml, each number in a requirement is linked with a "
        "constant, or with a formula of constants. The number is in digits or written as a word. "
        "The constant or the formula has this value. If the code has no constant for a number, the "
        "file lists this number and the reason. If the @evidence of a requirement has a bound "
        "other than 0, the requirement states this number. If a metric in design/closed_loop.toml "
        "names a requirement, this requirement states the limit of the metric. If the metric is an "
        "error, the requirement can state the limit as a percentage of the target.",
        "The check leaves out the numbers 0, 1 and 2 if they have no unit. A formula may differ by "
        "0.5 % from the number in the text, because the text is rounded. The check cannot judge "
        "whether the linked constant causes the property that the sentence demands.",
        "correct the constant or the requirement, or name the constant in "
        "design/requirement_numbers.toml. If the code has no constant for the number, add the "
        "number to an entry [[without]] of this file.",
    ),
    Check(
        "test-number",
        "Numbers in the brief of a test are in its code",
        "The brief of a C++ test can contain numbers with a physical unit. Each of these numbers "
        "is also in the test, in the other code of its file, in its fixtures or in a scenario that "
        "the test plays. The number can also be the value of a constant that one of these places "
        "names.",
        "The check cannot judge whether the number belongs to the sentence. It does not compare "
        "counts, such as cycles or edges.",
        "correct the brief, or write the number in the code of the test or in a constant that this "
        "code names.",
    ),
    Check(
        "req-source",
        "Sources are references",
        "Every @source has the form 'kind: name'; semicolons separate several sources. After "
        "'paper', the name is a place of design/paper.toml. After 'goal', the name is a safety "
        "goal of design/safety_case.toml that a @goal of the requirement names. After 'protocol', "
        "the name is a heading of docs/protocol.rst. After 'data sheet', the name is a data sheet "
        "that design/safety_case.toml lists. After 'decision', a text states the decision.",
        "The check cannot judge whether the source supports the requirement. Only a reader can "
        "judge this.",
        "write the source in this form.",
    ),
    Check(
        "req-satisfied",
        "Each requirement is satisfied",
        "Every requirement FR-n, and every other requirement with a tree of invocations, is "
        "named in the @satisfies of a method.",
        "The check does not detect whether the method fulfils the requirement. The tests show "
        "this.",
        "write the tag @satisfies above the method that fulfils the requirement.",
    ),
    Check(
        "req-verified",
        "Each requirement is verified",
        "Every requirement without a metric (@evidence) is named in the @verifies of a test.",
        "The check cannot judge whether the test is strict enough.",
        "write a test for the requirement, or tag the existing test with @verifies.",
    ),
    Check(
        "req-method",
        "Each public method serves a requirement",
        "Each public method of a design module is tagged with @satisfies or has a node in a tree. "
        "For a virtual method and all methods that override it, one tag or one node is sufficient. "
        "A constructor serves the requirements of its module. Other methods are justified in "
        "design/justified.toml. Each @satisfies is in the comment of a method of a module.",
        "The check cannot judge whether the requirement needs the method.",
        "tag the method with @satisfies, use it in a tree, remove it, or justify it in "
        "design/justified.toml.",
    ),
    Check(
        "req-caller",
        "Each public method has a caller",
        "Code of the firmware calls every public method of a design module. If the method "
        "overrides another method, a call of the other method is sufficient. Methods without a "
        "caller are justified in design/justified.toml.",
        "The check does not detect whether the calling code is ever executed. It also accepts a "
        "call in dead code. It ignores constructors and operators.",
        "call the method, remove the method, or justify it in design/justified.toml.",
    ),
    Check(
        "req-test",
        "Each test verifies a requirement",
        "Every test in C++ is tagged with @verifies, or justified in design/justified.toml. The "
        "tools recognise the macro of every test. No test is disabled, and no test of a "
        "requirement skips itself. A loop in a test runs at least once. This is checked if the "
        "limits of the loop are numbers, or constants in the file of the test. No loop counts away "
        "from its limit.",
        "The check does not detect whether the test fails when the code violates the requirement. "
        "Mutation tests show this.",
        "tag the test with @verifies, remove it, or justify it in design/justified.toml.",
    ),
    Check(
        "req-justified",
        "Each justification is needed",
        "Every name in design/justified.toml is a method, a test or a source line that needs a "
        "justification. Every entry of design/mutants.toml quotes a source line of its method, and "
        "lists changes of this line. When all mutants of the present sources have been tried, the "
        "check also verifies two facts for each of these changes: a mutant made the change, and no "
        "test found this mutant.",
        "The check cannot judge whether the reason is good.",
        "remove the entry, or correct its names.",
    ),
    Check(
        "req-evidence",
        "Each metric of a requirement meets its bound",
        "Each @evidence of a requirement names a metric and a bound. The metric was measured in "
        "this run, and its value meets the bound. The form of a bound is 'at most', 'at least' or "
        "'exactly'.",
        "The check cannot judge whether the metric shows the property that the requirement "
        "demands.",
        "run ./wr test --all to measure the metric; if the value is beyond its bound, correct the "
        "code.",
    ),
    Check(
        "req-passed",
        "Each test of a requirement ran and passed",
        "Every test that verifies a requirement ran in the last test run and passed. Every other "
        "test ran. The build of the tests names every folder with tests.",
        "The check does not compare results that are older than the sources.",
        "correct the code or the test, then run ./wr test --all.",
    ),
    Check(
        "req-unknown",
        "Each id of a requirement in a tag or a text exists",
        "Every @satisfies and @verifies names one requirement of requirements/. If a transition of "
        "a state machine or a metric in design/closed_loop.toml names a requirement, this "
        "requirement exists. If a comment, a page, a text of design/ or another text contains an "
        "id, a requirement, hazard, safety goal or assumption with this id exists.",
        "The check does not find an id that exists, but is wrong. It does not read the tests of "
        "the tools, because these tests name ids that do not exist.",
        "correct the id.",
    ),
    Check(
        "req-name",
        "Tests that are named after a requirement verify it",
        "If the name of a test begins with the id of a requirement, such as FR41_, the test has "
        "the @verifies for that id.",
        "The check does not read tests whose names do not begin with an id.",
        "write the tag @verifies above the test, or rename the test.",
    ),
    Check(
        "req-stale",
        "Results belong to the present sources",
        "The last test run used exactly the present sources. The tools check the size and the "
        "stack use of the firmware image. This image was also built from the present sources.",
        "The check has no known limits, because it compares contents and not dates.",
        "run ./wr test.",
    ),
    Check(
        "req-line",
        "Each source line serves a requirement",
        "Each source line of a method of the design is executed by a passing test of a "
        "requirement, and the method serves this requirement. A method serves a requirement in "
        "three cases. First case: the tree of the requirement contains the method. Second case: "
        "the @satisfies of the method names the requirement. Third case: no tree contains the "
        "method, and a caller of the method serves the requirement. If a method serves no "
        "requirement, a passing test of any requirement is enough. Other lines are justified in "
        "design/justified.toml.",
        "The check does not read the code that only the K64 uses. The page of the virtual K64 "
        "lists the lines of src/k64 that were not executed. It also lists the files of the "
        "extensions for which the executed lines are not measured. The check does not detect "
        "whether the test checks the effect of the line.",
        "execute the line in a test of its requirement, remove it, or justify it in "
        "design/justified.toml.",
    ),
    Check(
        "hazard-name",
        "The safety case names only parts that exist",
        "Each hazard has an id HZ-n, each safety goal an id SG-n, and each assumption of use an "
        "id AU-n. If an entry of design/safety_case.toml names a goal, an assumption or a safe "
        "state, another entry of the file declares this goal, assumption or safe state.",
        "The check cannot detect that a hazard is missing in the safety case.",
        "correct the name.",
    ),
    Check(
        "hazard-covered",
        "Each hazard is covered",
        "Every hazard has a safety goal or an assumption of use. The risk graph has a level for "
        "the severity, exposure and avoidance of every hazard.",
        "The check cannot judge whether the estimates are right, or whether the goal is "
        "sufficient.",
        "name a goal or an assumption, or complete the estimates.",
    ),
    Check(
        "hazard-goal",
        "Each safety goal is complete",
        "For every safety goal, at least one hazard and one requirement name the goal. Every "
        "safety goal names a safe state.",
        "The check cannot judge whether the requirements are sufficient to reach the goal.",
        "complete the goal in design/safety_case.toml, or name it in a requirement.",
    ),
    Check(
        "hazard-time",
        "Times of safety goals match their formulas",
        "The fault-tolerant time of each goal is the value of its formula, rounded down by at most "
        "10 %. If a goal declares a velocity, its formula contains this velocity. The velocity "
        "differs by at most 1 % from the greatest ordered velocity. That velocity is calculated "
        "from SystemConstants::velocityLimit, and from the gear and the wheels of the simulated "
        "robot. The reaction time of the firmware is at most the fault-tolerant time. If a goal "
        "declares its reaction time as a formula of constants (the key parts), the reaction time "
        "is the value of this formula, rounded up by at most 10 %. The fault-tolerant time and the "
        "reaction time end when the safe state is reached, or when the halt that leads to this "
        "state begins. If a goal has no known exceptions, its scenarios accept only reactions "
        "within the fault-tolerant time.",
        "The check cannot judge whether the distances and energies in the formula are right for "
        "the robot. It does not find a formula with the velocity of the robot if the goal declares "
        "no velocity. It cannot judge whether the tests measure the right reaction. It does not "
        "limit the time and the distance of a halt. It compares only the declared reaction time, "
        "and not the times in the text that describes the reaction. If a goal has a known "
        "exception, the check does not compare the times that the scenarios of this goal accept.",
        "correct the time, the formula or the velocity, or shorten the reaction time of the "
        "firmware.",
    ),
    Check(
        "hazard-requirement",
        "Requirements name existing goals",
        "If a requirement names a safety goal in @goal, this goal exists.",
        "The check does not find a missing tag. If a tag is removed, suspect-requirement reports "
        "this. The check cannot judge whether the requirement really contributes to the goal. If "
        "some requirements of a goal are not verified, the check reports nothing, but the page of "
        "the goal shows the goal as open.",
        "correct the tag @goal.",
    ),
    Check(
        "hazard-scenario",
        "Fault scenarios have a goal, and their tests passed",
        "Every file of sim/scenario/safety names a safety goal, and each named goal exists. At "
        "least one hazard lists the file. If a hazard lists the file, the file names a safety goal "
        "of this hazard. A test plays the scenario, and this test passed on each target for which "
        "it is built.",
        "The check does not find faults without a scenario. If a scenario no longer names one of "
        "its goals, suspect-requirement reports this. The check cannot judge whether the listed "
        "scenarios of a hazard really show this hazard. It ignores test results that are older "
        "than the sources.",
        "complete the links, play the scenario in a test, or correct the failure.",
    ),
    Check(
        "hazard-assumption",
        "Each assumption of use covers a hazard",
        "For every assumption of use, at least one hazard names the assumption.",
        "The check cannot judge whether people follow the assumption.",
        "name the assumption in a hazard, or remove it.",
    ),
    Check(
        "hazard-priority",
        "Safety goals determine the lowest priority",
        "For the level of each safety goal, design/safety_case.toml states a lowest priority. If a "
        "requirement serves the goal, the requirement has at least this priority.",
        "The check ignores requirements that serve no safety goal.",
        "raise the priority.",
    ),
    Check(
        "suspect-requirement",
        "A requirement is as in its baseline",
        "These texts of each requirement are unchanged since its baseline: the requirement, its "
        "invocation tree, its transitions of state machines, its safety goals, and the hazards and "
        "fault scenarios of these goals.",
        "The check cannot judge whether the texts are right. A review answers this question. The "
        "check ignores changes of line breaks.",
        "check the text, and then run ./wr review --baseline with the id of the requirement.",
    ),
    Check(
        "suspect-method",
        "The methods of each requirement are as in the baseline",
        "These texts are unchanged since the baseline: the specifications and bodies of the "
        "methods that satisfy a requirement, the bodies of the methods in the invocation tree of "
        "the requirement, and the constants in the files with these bodies.",
        "The check does not find changes of comments in a body, of formatting, or of names of "
        "local variables.",
        "check the text, and then run ./wr review --baseline with the id of the requirement.",
    ),
    Check(
        "suspect-test",
        "The tests of each requirement are as in the baseline",
        "These texts are unchanged since the baseline: the tests that verify a requirement, their "
        "fixtures, parameters and helpers, the scenarios that the tests play, and the "
        "justifications of source lines.",
        "The check does not compare the simulator, tests in Python, comments and formatting.",
        "check the text, and then run ./wr review --baseline with the id of the requirement.",
    ),
    Check(
        "suspect-design",
        "Texts without a requirement are as in the baseline",
        "These texts are unchanged since the baseline: the sentences in the files of design/ and "
        "changes/, the numbers and names in the pages of docs/ and in the README, the code of "
        "sim/plant and sim/scenario, and the constants, bodies and specifications on which no "
        "requirement depends. Reasons, deviations, steps and answers are examples of sentences in "
        "design/. In docs/bring_up.rst and docs/hazards.rst, the whole text is unchanged.",
        "The check cannot judge whether the texts are right. On other pages, it does not find "
        "changes that leave the numbers and names as they are.",
        "compare the text with the code, then run ./wr review --baseline design.",
    ),
    Check(
        "req-review",
        "Each recorded review is valid",
        "Each record in requirements/reviews.toml names a person with an address. According to "
        "git, this person wrote no line of the reviewed texts. The record answers each question, "
        "and has a remark.",
        "The check cannot judge whether the reviewer was careful. It reports nothing for a "
        "requirement without a review. The page of the requirement shows that the review is "
        "missing.",
        "remove the record, and let another person run ./wr review with the id.",
    ),
    Check(
        "paper-complete",
        "The concordance with the paper is complete",
        "design/paper.toml lists the pictures, tables, sections and named elements of the paper. "
        "Each of them has one entry in design/concordance.toml. The entry names the counterpart of "
        "the element, or the reason why there is none. Entries name each arrow of the high-level "
        "diagram.",
        "The check does not find an element that is missing in the list. The list was written by "
        "hand from the paper.",
        "write the entry in design/concordance.toml, or correct its kind or name.",
    ),
    Check(
        "paper-statement",
        "Each statement of the paper has an answer",
        "Each entry of design/statements.toml names a place of the paper. The entry names an "
        "answer that exists, or states a deviation. Each requirement whose source is a place of "
        "the paper answers a statement of the paper.",
        "The check does not detect that a statement of the paper is missing in the list, or that "
        "an answer is wrong. A person compares the list with the paper.",
        "correct the entry, or add the statement to design/statements.toml.",
    ),
    Check(
        "paper-stale",
        "The concordance names only parts that exist",
        "The entries of design/concordance.toml, and the words in backticks in their texts, name "
        "only existing modules, methods, applications, state machines, requirements, checks and "
        "pages. A count of modules or of applications equals the number of entries in "
        "design/modules.toml or design/applications.toml. The value of a constant equals the value "
        "in the code.",
        "The check cannot judge whether the named part is really the counterpart of the element "
        "in the paper. Only a reader can judge this.",
        "name the part that replaced the missing part.",
    ),
    Check(
        "paper-alias",
        "Each name that differs from the paper has a reason",
        "If the name of a module, method or state differs from the name in the paper, the entry "
        "has an alias with a reason. If the names are equal, the entry has no alias. For a pattern "
        "application, the check compares its title.",
        "The check cannot judge whether the reason is good.",
        "state why the name differs, or use the name of the paper.",
    ),
    Check(
        "doc-diagram",
        "Every diagram can be drawn",
        "PlantUML draws each diagram of the model without an error.",
        "The check cannot judge whether the diagram is easy to read.",
        "correct the source of the diagram.",
    ),
    Check(
        "doc-frame",
        "Numbers of the protocol agree with the code",
        "A value of an enumeration in design/frames.toml can have the name of an enumerator in the "
        "firmware, or can name a constant of the firmware. The value then has the same number as "
        "this enumerator or constant. If a frame has the name of an enumerator of FrameType, the "
        "type of the frame is the number of this enumerator. The client has a text for each cause "
        "of a protective stop.",
        "The check does not compare the fields of the frames, the types of the fields and their "
        "limits. Tests compare them.",
        "correct the number, and never use a number of the protocol for a new meaning.",
    ),
    Check(
        "doc-example",
        "Worked examples of the protocol are consistent",
        "For each example in docs/protocol_examples.txt, the stated check sum and the stated "
        "bytes on the serial line are equal to the values that are computed from the body of the "
        "frame. The body contains the frame that the text of the example names, and the numbers of "
        "this text.",
        "The check does not compare other words of the text, such as the cause of a stop. Tests of "
        "the firmware and of the client decode the body.",
        "run tests/python/client/examples.py, which writes the examples.",
    ),
    Check(
        "doc-scenario",
        "Scenarios agree with their descriptions",
        "docs/scenarios.rst names every action, fault, parameter and true value that a scenario "
        "can contain. Each word of a scenario on this page exists, and each fault in its table has "
        "the right number of arguments. A comment of a scenario can contain numbers with a unit. "
        "Each of these numbers is a value in the lines of this scenario, or a value in a "
        "requirement that the comment names. A time can also be the difference of two times. A "
        "percentage can also be the difference of two values. Any other number can also be in the "
        "middle of an expected range. A test of the firmware names each file of "
        "sim/scenario/examples.",
        "The check does not decide whether this test plays the file. It does not find a wrong "
        "number that is equal to a value in another line of the scenario. It does not read a "
        "number after the word 'about'.",
        "correct the comment or the scenario, or name the requirement that states the number.",
    ),
    Check(
        "link-doc",
        "Links of hand-written pages",
        "Every reference in docs/ has a target. The check reads pages, requirements, comments, "
        "texts of design/ and other texts. If a path in such a text begins with a folder of the "
        "project, the path exists. If a page names a command of ./wr, this command and its options "
        "exist. An option without a command is an option of a command or a program that the page "
        "names. If an option has a list of values, a value after the option is in this list. If a "
        "page or a text of design/ names a product, program, firmware image, folder of the build, "
        "pin or key, this part exists too. The file src/k64/pins.hpp contains each named pin, in "
        "its table or in a comment about unused pins. The README of a port can also name the pins "
        "of this port. If one of these texts names a signal or a connector directly next to a pin, "
        "src/k64/pins.hpp lists the same signal or connector for this pin. Pages and help texts "
        "insert the exit codes.",
        "The check cannot judge whether the link has the right target. It accepts an option "
        "without a command if any command on the page has this option, even if the sentence is "
        "about another command. It does not find a wrong pin in a sentence that does not contain "
        "the words of the table of pins. It accepts a pin that occurs only in a comment of "
        "src/k64/pins.hpp.",
        "correct the target.",
    ),
    Check(
        "link-site",
        "Links of the site",
        "Each link of the site leads to an existing page and an existing anchor. This also applies "
        "to the links in diagrams. In design/questions.toml, every address in `clicks` has a page.",
        "The check does not follow links to other sites.",
        "correct the source of the page.",
    ),
]


def _clauses() -> list[Check]:
    # If the file has errors, the reader of the model reports them. They are ignored here.
    entries = Entries(CLAUSES.parents[1]).tables(
        CLAUSES, "clause", {"id": str, "pattern": str, "says": str, "fix": str}, {"about": list}
    )
    return [
        Check(
            entry["id"],
            f"{entry['pattern']}: {entry['id'].split('-', 2)[2].replace('-', ' ')}",
            f"In every application of {entry['pattern']}: {entry['says']}",
            "The check compares only the structure of the code. It cannot judge whether the "
            "pattern is used for its purpose.",
            f"{entry['fix']}.",
        )
        for entry, _ in entries
    ]


CHECKS = [*_FIXED, *_clauses()]
KNOWN = {check.id: check for check in CHECKS}
