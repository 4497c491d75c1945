"""board-finding: what the virtual K64 can find is declared and tested."""

from __future__ import annotations

from traceability.model.facts import Facts
from traceability.model.schema import Finding, Model, Place


def check(model: Model, _facts: Facts) -> list[Finding]:
    untested = [
        Finding(
            finding.place,
            "board-finding",
            f"no test in tests/sim/k64 makes the finding {finding.id}",
            "write one, or remove the finding",
        )
        for finding in model.board_findings.values()
        if not finding.tests
    ]
    unknown = [
        Finding(
            Place("design/board_findings.toml", 1),
            "board-finding",
            f"the fault '{fault.fault}' gave the finding {fault.finding}, which is not declared",
            "declare it",
        )
        for fault in model.driver_faults or []
        if fault.finding and fault.finding not in model.board_findings
    ]
    return untested + unknown
