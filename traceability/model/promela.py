"""The state machines of the design in Promela, the language of the model checker Spin.

Each machine of ``design/fsm`` becomes a variable and an inline function. The variable contains the
present state. The function is the step of the machine: it receives an event, and executes the first
transition whose guard is true. The guards are inputs: ``design/proofs/robot.pml`` sets the
guards, calls the steps and reads the actions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from traceability.grouping import grouped
from traceability.reading.declared import Declared
from traceability.reading.proof_record import read_proofs, readable
from traceability.schema import ProofProperty, Proofs, StateMachine, Transition

ROBOT = Path("design/proofs/robot.pml")
HEAD = """\
// Generated from design/fsm. Event 0 sets the initial state.
#define machine_reset 0
"""
# The comments in robot.pml before and after the observing variables. An observing variable records
# a fact at the end of each round of the model. The properties use these variables.
OBSERVED, OBSERVED_END = "// ---- observed", "// ---- environment"
WORD = re.compile(r"[a-z_]\w*")
SIGNS = {"<": " below ", ">": " above ", "=": " is "}


def slug(text: str) -> str:
    """Converts a text into a part of a Promela name. For example, ``a < b`` becomes
    ``a_below_b``."""
    for sign, word in SIGNS.items():
        text = text.replace(sign, word)
    return re.sub(r"\W+", "_", text).strip("_")


def name_of(machine: StateMachine) -> str:
    return slug(machine.id)


def guards_of(machine: StateMachine) -> list[str]:
    """Returns the names of the variables for the guards of a machine. ``robot.pml`` sets these
    variables."""
    guards = dict.fromkeys(step.guard for step in machine.transitions if step.guard)
    return [f"{name_of(machine)}_if_{slug(guard)}" for guard in guards]


def whole(
    machines: Mapping[str, StateMachine], robot: str, proof: ProofProperty | None = None
) -> str:
    """Returns the model that Spin reads: the machines, ``robot.pml`` and the property ``proof``.
    Spin does not store the observing variables that this property does not need."""
    claim = f"ltl {proof.name} {{ {' '.join(proof.formula.split())} }}\n" if proof else ""
    text = without(robot, proof.formula) if proof else robot
    return "\n".join([HEAD, *map(step_of, machines.values()), text, claim])


def observed(robot: str) -> dict[str, set[str]]:
    """Returns a map from each observing variable to the names in the expression that sets it."""
    body = robot.partition("inline observe() {")[2].partition("\n}")[0]
    values = re.findall(r"^    (\w+) = ([^;]+);", body, re.MULTILINE)
    return {name: set(WORD.findall(value)) for name, value in values}


def without(robot: str, formula: str) -> str:
    """Returns the text of ``robot.pml``. If the formula does not need an observing variable, the
    variable gets the keyword ``hidden``. Spin then does not store the variable in its states."""
    head, mark, rest = robot.partition(OBSERVED)
    block, end, rest = rest.partition(OBSERVED_END)
    needed = set(WORD.findall(formula))
    needed |= {word for name, words in observed(robot).items() if name in needed for word in words}

    def hide(match: re.Match[str]) -> str:
        return match[0] if match["name"] in needed else f"hidden byte {match['name']}"

    hidden = re.sub(r"^bool (?P<name>\w+)", hide, block, flags=re.MULTILINE)
    return head + mark + hidden + end + rest


def step_of(machine: StateMachine) -> str:
    """Returns the Promela text of a machine: the names that ``robot.pml`` uses, the variables,
    and the step."""
    name = name_of(machine)
    actions = dict.fromkeys(step.action for step in machine.transitions if step.action)
    lines = [f"// {machine.title}, from {machine.place.file}"]
    lines += _numbers(f"{name}_", machine.states)
    lines += _numbers(f"{name}_on_", machine.events)
    lines += _numbers(f"{name}_does_", actions)
    lines += [f"bool {guard};" for guard in guards_of(machine)]
    lines += [
        f"byte {name} = {name}_{machine.initial};",
        f"byte {name}_did;  // the action of the last step, 0: none",
        f"inline {name}_step(event) {{",
        f"  {name}_did = 0;",
        "  if",
        f"  :: event == machine_reset -> {name} = {name}_{machine.initial}",
    ]
    groups = grouped(machine.transitions, lambda step: (step.source, step.event))
    for (source, event), steps in groups.items():
        at = f"{name} == {name}_{source} && event == {name}_on_{slug(event)}"
        lines += [f"  :: {at} ->", *_choice(machine, steps, "     ")]
    lines += ["  :: else", "  fi", "}", ""]
    return "\n".join(lines)


def _numbers(begin: str, names: Iterable[str]) -> list[str]:
    return [f"#define {begin}{slug(name)} {number}" for number, name in enumerate(names, 1)]


def _choice(machine: StateMachine, steps: list[Transition], indent: str) -> list[str]:
    """Returns the Promela text of the transitions from one state for one event. The text tests the
    guards in the order of the transitions. The first true guard selects the transition."""
    name, first = name_of(machine), steps[0]
    effects = [f"{name} = {name}_{first.target}"]
    if first.action:
        effects.append(f"{name}_did = {name}_does_{slug(first.action)}")
    if first.source != first.target:
        effects.append(f'printf("transition {machine.id} {first.source} {first.target}\\n")')
    done = "; ".join(effects)
    if not first.guard:
        return [f"{indent}{done}"]
    below = _choice(machine, steps[1:], indent + "   ") if steps[1:] else []
    return [
        f"{indent}if",
        f"{indent}:: {name}_if_{slug(first.guard)} -> {done}",
        f"{indent}:: else{' ->' if below else ''}",
        *below,
        f"{indent}fi",
    ]


def proofs_of(root: Path, declared: Declared) -> Proofs:
    """Returns the declared properties, the results of their proofs, and the text of the proved
    model. Also returns the counterexamples, as lists of cycles with their events."""
    path = root / ROBOT
    if not path.exists():
        return Proofs()
    results = read_proofs(root)
    return Proofs(
        declared.proofs,
        results,
        whole(declared.machines, path.read_text(encoding="utf-8")),
        {
            name: readable(result.events, declared.proof_events)
            for name, result in (results or {}).items()
            if result.events
        },
    )
