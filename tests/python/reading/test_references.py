"""The objects to which a reference can refer, and the methods that a virtual call can execute."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import pytest

from traceability.reading.ast_facts import BodyFact, CallFact
from traceability.reading.flow import FlowFact
from traceability.reading.source_facts import Facts, References, replaced_files
from traceability.schema import Place

COMMANDS = ("Ticks::execute", "Read::execute")


def call(file: str, on: str, target: str) -> CallFact:
    return CallFact(target, True, Place(file, 1), on=[on])


def facts(flows: list[FlowFact], bodies: list[BodyFact], commands: tuple[str, ...]) -> Facts:
    """Returns the facts of two builders, each with a command of its own."""
    methods = {"Safe::command": "Safe::command", "Plain::command": "Plain::command"}
    overriders = {"Builder::command": sorted(methods), "Command::execute": list(commands)}
    by_id: dict[str, list[BodyFact]] = {}
    for body in bodies:
        by_id.setdefault(body.id, []).append(body)
    stub = SimpleNamespace(
        syntax=SimpleNamespace(classes=[], variables={}, flows=flows, bodies=bodies),
        classes={},
        subclasses={"Builder": ["Safe", "Plain"], "Command": ["Ticks", "Read"]},
        overriders=overriders,
        bodies=by_id,
        targets=lambda target, **_: overriders[target],
        method=lambda kind, name: SimpleNamespace(id=f"{kind}::{name}"),
    )
    return cast(Any, stub)


def test_a_result_comes_only_from_the_methods_that_the_calls_of_the_file_can_execute() -> None:
    ask = call("src/pool.cpp", "param Pool::fill 0", "Builder::command")
    run = call("src/timer.cpp", "field Timer::command", "Command::execute")
    flows = [
        FlowFact("param Pool::fill 0", ["object src/main.cpp:safe Safe"], "src/main.cpp"),
        FlowFact("result Safe::command", ["object Safe::ticks Ticks"], "src/Safe.cpp"),
        FlowFact("result Plain::command", ["object Plain::read Read"], "src/Plain.cpp"),
        FlowFact("field Timer::command", ["result Builder::command"], "src/pool.cpp"),
    ]
    bodies = [
        BodyFact("Pool::fill", "Pool", Place("src/pool.cpp", 1), 9, calls=[ask]),
        BodyFact("Timer::expired", "Timer", Place("src/timer.cpp", 1), 9, calls=[run]),
    ]
    references = References(facts(flows, bodies, COMMANDS), bool)
    assert references.targets(ask) == ["Safe::command"]
    assert references.targets(run) == ["Ticks::execute"]


def test_a_call_without_a_known_object_reaches_all_overriding_methods_of_the_read_files() -> None:
    run = call("src/timer.cpp", "field Timer::command", "Command::execute")
    bodies = [
        BodyFact("Ticks::execute", "Ticks", Place("src/Ticks.cpp", 1), 9),
        BodyFact("Read::execute", "Read", Place("extensions/other/Read.cpp", 1), 9),
    ]
    inside = References(facts([], bodies, COMMANDS), lambda file: file.startswith("src/"))
    assert inside.targets(run) == ["Ticks::execute"]


def test_a_handler_of_the_extension_replaces_the_file_of_src() -> None:
    files = ("src/k64/start_up/pool.cpp", "extensions/safety/k64/pool.cpp")
    bodies = [BodyFact("tick", "", Place(file, 1), 9) for file in files]
    local = [BodyFact("part", "", Place(file, 1), 9, local=True) for file in ("src/a.cpp",)]
    assert replaced_files(facts([], [*bodies, *local], COMMANDS)) == {files[0]}


def chain() -> References:
    """Returns the references of a chain of stages: the stage Outer wraps the stage Inner, and Inner
    wraps the robot. The class Stage is the base class of Outer and Inner, and declares the member
    ``wrapped``."""
    main = "src/main.cpp"
    flows = [
        FlowFact("param Outer::Outer 0", ["object src/main.cpp:inner Inner"], main),
        FlowFact("param Inner::Inner 0", ["object src/main.cpp:robot Robot"], main),
        FlowFact("field Main::outer", ["object src/main.cpp:outer Outer"], main),
        FlowFact("field Stage::wrapped", ["param Stage::Stage 0"], "src/Stage.cpp"),
        FlowFact("result Stage::next", ["field Stage::wrapped"], "src/Stage.cpp"),
    ]
    bodies = []
    for name in ("Outer", "Inner"):
        at, source = Place(f"src/{name}.cpp", 1), [f"param {name}::{name} 0"]
        flows.append(FlowFact("param Stage::Stage 0", source, at.file))
        base = CallFact("Stage::Stage", False, at, args=[source])
        bodies.append(BodyFact(f"{name}::{name}", name, at, 9, calls=[base]))
    stub: Any = facts(flows, bodies, COMMANDS)
    stub.subclasses = {"Part": ["Stage", "Outer", "Inner", "Robot"], "Stage": ["Outer", "Inner"]}
    stub.bases_of = lambda kind: {base for base, below in stub.subclasses.items() if kind in below}
    stub.overriders = {}
    return References(stub, bool)


@pytest.mark.parametrize("on", ["field Stage::wrapped", "result Stage::next"])
def test_a_member_of_a_base_class_refers_to_the_object_that_the_subclass_passes(on: str) -> None:
    follow = call("src/Stage.cpp", on, "Part::follow")
    assert chain().targets(follow) == ["Inner::follow", "Robot::follow"]
    assert chain().own_targets(follow, "Outer") == ["Inner::follow"]
    assert chain().own_targets(follow, "Inner") == ["Robot::follow"]
    assert chain().own_targets(follow, "Stage") == ["Inner::follow", "Robot::follow"]


def test_a_virtual_call_of_the_own_object_executes_the_method_of_its_class() -> None:
    follow = CallFact("Part::follow", True, Place("src/Stage.cpp", 1))
    assert chain().own_targets(follow, "Inner") == ["Inner::follow"]
    assert chain().constructed == {"Outer", "Inner", "Robot"}


@pytest.mark.parametrize("on", ["field Stage::wrapped", "result Stage::next"])
def test_an_override_is_wired_only_to_callers_that_refer_to_its_object(on: str) -> None:
    follow = call("src/Stage.cpp", on, "Part::follow")
    assert chain().wired_targets(follow, "Outer") == ["Inner::follow"]
    assert chain().wired_targets(follow, "Stage") == ["Inner::follow", "Robot::follow"]
    own = CallFact("Part::follow", True, Place("src/Stage.cpp", 1))
    assert chain().wired_targets(own, "Stage") == ["Outer::follow", "Inner::follow"]
    unknown = call("src/Stage.cpp", "param Stage::end 0", "Part::follow")
    assert chain().wired_targets(unknown, "Outer") == []
