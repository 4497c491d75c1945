"""link-design: what the tables of design/ name is there."""

from __future__ import annotations

from traceability.model.facts import Facts
from traceability.model.schema import Finding, Model


def check(model: Model, facts: Facts) -> list[Finding]:
    named = [
        (element.place, name, f"the element {element.id} of the architecture")
        for element in model.architecture
        for name in element.modules
    ]
    named += [
        (machine.place, module, f"the state {state} of {machine.id}")
        for machine in model.machines.values()
        for state, module in machine.states.items()
    ]
    found = [
        Finding(place, "link-design", f"{who} names {name}, which is no module", "correct the name")
        for place, name, who in named
        if name not in model.modules
    ]
    for machine in model.machines.values():
        if machine.application not in facts.declared.applications:
            text = (
                f"{machine.id} is no machine of an application: there is no {machine.application}"
            )
            found.append(Finding(machine.place, "link-design", text, "correct the name"))
    return found
