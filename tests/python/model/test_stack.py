"""The largest use of the stack, computed from stack frames and calls."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest

from traceability.model.design_model import Model
from traceability.model.stack import Declared, Prover, later_classes, objects_in_chains
from traceability.reading.ast_facts import BodyFact, CallFact, Syntax
from traceability.reading.call_graph import Function, _read_listing, _read_unit
from traceability.reading.source_facts import Facts, References
from traceability.schema import ExecutionContext, Place

HERE = Place("src/robot.cpp", 1)
CALLED = Place("src/robot.cpp", 7)


class Targets:
    """A stub that finds the targets of calls. The targets of each call are the methods in the field
    ``on`` of the call."""

    def __init__(self) -> None:
        self.constructed: set[str] = set()

    def targets(self, call: CallFact) -> list[str]:
        return call.on

    def own_targets(self, _call: CallFact, kind: str) -> list[str]:
        return [f"{kind}::wrapped"]


class SmallFacts:
    def __init__(self, *calls: CallFact) -> None:
        body = BodyFact("Loop::run", "Loop", HERE, 9, calls=list(calls))
        self.syntax = Syntax(bodies=[body])
        self.robot = Targets()
        self.bodies = {"Loop::run": [body]}
        self.subclasses: dict[str, list[str]] = {}

    def bases_of(self, name: str) -> set[str]:
        return {base for base, others in self.subclasses.items() if name in others}


def graph(**functions: tuple[int, list[str]]) -> dict[str, Function]:
    return {
        symbol: Function(symbol, f"wr::{symbol.replace('_', '::')}()", frame, calls=calls)
        for symbol, (frame, calls) in functions.items()
    }


def context(name: str, handler: str, priority: int | None) -> ExecutionContext:
    return ExecutionContext(name, "interrupt", name, "", [handler], "", HERE, priority=priority)


def prover(
    functions: dict[str, Function], contexts: list[ExecutionContext], *calls: CallFact
) -> Prover:
    model = Model(commit="", version="", sources_hash="", results_hashes={})
    model = replace(model, contexts={one.id: one for one in contexts})
    facts = cast(Facts, SmallFacts(*calls))
    return Prover(functions, facts, model, Declared())


def test_the_deepest_chain_counts_and_not_the_longest() -> None:
    functions = graph(
        Loop_run=(8, ["Loop_a", "Loop_b"]),
        Loop_a=(8, ["Loop_c"]),
        Loop_b=(100, []),
        Loop_c=(16, []),
    )
    proof = prover(functions, [context("main", "Loop::run", None)]).prove(36)
    assert [call.name for call in proof.contexts[0].chain] == ["Loop::run", "Loop::b"]
    assert proof.total == 108


def test_an_object_of_an_ordered_chain_calls_no_object_before_it() -> None:
    """The inner stage seems to call the outer stage, because both stages have the same
    interface."""
    functions = graph(
        Loop_run=(8, ["Outer_follow", "Inner_follow"]),
        Outer_follow=(100, ["Inner_follow"]),
        Inner_follow=(10, ["Outer_stand", "Inner_stand"]),
        Outer_stand=(1000, []),
        Inner_stand=(1, []),
    )
    chained = prover(functions, [context("main", "Loop::run", None)])
    chained.most = dict.fromkeys(("Outer::follow", "Inner::follow", "Outer::stand"), 1)
    chained.declared = Declared(inner={"Outer": frozenset({"Inner"}), "Inner": frozenset()})
    (deepest,) = chained.prove(36).contexts
    assert [call.name for call in deepest.chain] == [
        *("Loop::run", "Outer::follow", "Inner::follow", "Inner::stand")
    ]


def test_the_constructors_show_the_classes_of_a_chain_and_their_order() -> None:
    passed: dict[str, set[str]] = {
        "Outer": {"Middle", "Memory"},
        "Middle": {"Inner"},
        "Inner": {"Port"},
        "Memory": set(),
        "Port": set(),
    }
    robot = cast(References, SimpleNamespace(arguments=passed.__getitem__))
    assert later_classes(robot, "Outer", "Inner") == {
        "Inner": frozenset(),
        "Outer": {"Inner", "Middle"},
        "Middle": {"Inner"},
    }
    assert not later_classes(robot, "Memory", "Inner")


def test_a_chain_has_an_object_of_a_base_class_for_each_of_its_subclasses() -> None:
    names = ("Wrapper", "A", "B", "C", "D")
    classes = {name: SimpleNamespace(abstract=name == "Wrapper") for name in names}
    subclasses = {"Stage": ["Wrapper", "A", "B", "C"], "Wrapper": ["A", "B"], "Any": ["C", "D"]}
    facts = cast(Facts, SimpleNamespace(classes=classes, subclasses=subclasses))
    chained = {"A": 1, "B": 1, "C": 1, "Wrapper": 2, "Stage": 3}
    assert objects_in_chains({"A", "B", "C"}, facts) == chained


def test_of_each_priority_the_greatest_counts_with_a_frame_of_the_hardware() -> None:
    functions = graph(Loop_run=(10, []), Loop_a=(20, []), Loop_b=(30, []), Loop_c=(40, []))
    contexts = [
        context("main", "Loop::run", None),
        context("small", "Loop::a", 2),
        context("large", "Loop::b", 2),
        context("high", "Loop::c", 1),
    ]
    proof = prover(functions, contexts).prove(36)
    assert [one.id for one in proof.levels] == ["main", "large", "high"]
    assert proof.total == 10 + 36 + 30 + 36 + 40


def test_an_indirect_call_in_an_inlined_method_depends_on_the_class_that_inlines_it() -> None:
    """Outer and Inner are subclasses of Stage. Outer::run calls Stage::run for the same object. The
    code of Stage::run is inlined in Outer::run."""
    functions = graph(Outer_wrapped=(1, []), Inner_wrapped=(1, []))
    inner, outer = Place("src/Stage.cpp", 3), Place("src/Outer.cpp", 5)
    small = prover(functions, [])
    facts = cast(SmallFacts, small.facts)
    facts.robot.constructed = {"Outer", "Inner"}
    facts.subclasses = {"Stage": ["Outer", "Inner"]}
    small.written = {
        (inner.file, inner.line): [("Stage::run", CallFact("Part::run", True, inner, on=["x"]))],
        (outer.file, outer.line): [("Outer::run", CallFact("Stage::run", False, outer))],
    }
    run = Function("Outer_run", "wr::Outer::run()", 8)
    alone, inlined = [(inner.file, 3)], [(inner.file, 3), (outer.file, 5)]
    assert small.targets(run, inner, alone) == ["Inner_wrapped", "Outer_wrapped"]
    assert small.targets(run, inner, inlined) == ["Outer_wrapped"]


def test_an_indirect_call_reaches_what_the_model_says() -> None:
    functions = graph(Loop_run=(8, []), Lamp_on=(50, []), Lamp_off=(70, []))
    functions["Loop_run"].indirect = [CALLED]
    call = CallFact("Command::execute", True, CALLED, on=["Lamp::on"])
    proof = prover(functions, [context("main", "Loop::run", None)], call).prove(36)
    assert proof.total == 58
    assert proof.proven


@pytest.mark.parametrize("written", ["{root}/a.cpp", "../../a.cpp"])
def test_the_graph_of_the_compiler_is_read(tmp_path: Path, written: str) -> None:
    told: dict[str, Function] = {}
    file = written.format(root=tmp_path)
    _read_unit(
        tmp_path,
        tmp_path / "build" / "k64",
        f"""graph: {{ title: "a.cpp"
node: {{ title: "_ZN2wr4Lamp2onEv" label: "void wr::Lamp::on()\\na.cpp:1:1\\n24 bytes (static)" }}
node: {{ title: "a.cpp:_ZL3offv" label: "void off()\\na.cpp:2:1\\n8 bytes (dynamic)" }}
edge: {{ sourcename: "_ZN2wr4Lamp2onEv" targetname: "a.cpp:_ZL3offv" label: "a.cpp:1:9" }}
edge: {{ sourcename: "_ZN2wr4Lamp2onEv" targetname: "__indirect_call" label: "{file}:3:5" }}
""",
        told,
    )
    lamp = told["_ZN2wr4Lamp2onEv"]
    assert (lamp.frame, lamp.calls, lamp.indirect) == (24, ["_ZL3offv"], [Place("a.cpp", 3)])
    assert told["_ZL3offv"].dynamic


def test_a_function_of_a_library_is_read_from_its_instructions() -> None:
    listing = """
00000100 <memset>:
     100:\tpush\t{r4, r5, lr}
     102:\tsub\tsp, #8
     104:\tbl\t200 <helper>
     106:\tbeq.n\t104 <memset+0x4>

00000200 <helper>:
     200:\tstmdb\tsp!, {r4-r7, lr}
     204:\tstr.w\tlr, [sp, #-4]!
"""
    found = _read_listing(listing)
    assert (found["memset"].frame, found["memset"].calls) == (20, ["helper"])
    assert found["helper"].frame == 24
