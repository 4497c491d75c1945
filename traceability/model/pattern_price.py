"""The cost of each pattern application: the virtual calls that remain in the firmware image."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from traceability.model.design_model import Model
from traceability.model.image_code import ImageCode, Program
from traceability.model.stack import Prover, read_declared
from traceability.reading.bench_record import CYCLES, MANUAL
from traceability.reading.call_graph import short_name, table_bytes
from traceability.reading.products import DEFAULT
from traceability.reading.results import read_object
from traceability.reading.source_facts import Facts
from traceability.schema import PatternPrice, Place

SCENARIO = "steps_and_steering"
MEASURED = Path("build/bench") / f"{DEFAULT}-{SCENARIO}-{MANUAL}.json"
# A virtual call has three instructions: load the address of the virtual table, load the address of
# the method from this table, and branch.
OF_A_CALL = 3
BYTES_OF_A_CALL = 6  # bytes of these instructions in their short forms

Site = tuple[int, set[str]]  # address of a call, and the classes whose methods it can execute


def prices(
    root: Path, model: Model, facts: Facts, image: ImageCode | None
) -> dict[str, PatternPrice]:
    """Returns the cost of each pattern application. Returns an empty dictionary if no firmware
    image or no measurement of the present sources exists."""
    measured = read_object(root / MEASURED)
    if image is None or model.bench is None or not measured:
        return {}
    executed = {int(at): sum(times) for at, times in measured["profile"].items()}
    prover = Prover(image.graph, facts, model, read_declared(root, facts))
    calls = list(sites(image.program, prover))
    tables = table_bytes(image.elf)
    result = {}
    for pattern in model.patterns.values():
        modules = {binding.module for binding in pattern.roles}
        own = {at: classes for at, classes in calls if classes and classes <= modules}
        result[pattern.id] = PatternPrice(
            instructions=round(OF_A_CALL * sum(executed.get(at, 0) for at in own) / CYCLES, 1),
            flash=BYTES_OF_A_CALL * len(own) + sum(tables.get(name, 0) for name in modules),
            virtual_calls=len(own),
            choices=sum(len(classes) > 1 for classes in own.values()),
        )
    return result


def sites(program: Program, prover: Prover) -> Iterator[Site]:
    """Yields each virtual call: its address in the firmware image, and the classes whose methods it
    can execute."""
    for symbol, code in program.codes.items():
        function = prover.graph.get(symbol)
        for instruction in code.instructions():
            lines = program.places.get(instruction.address) if instruction.indirect else None
            if function is None or not lines:
                continue
            targets = prover.targets(function, Place(*lines[0]))
            names = (short_name(prover.graph[target].name) for target in targets)
            yield instruction.address, {name.rpartition("::")[0].split("::")[0] for name in names}
