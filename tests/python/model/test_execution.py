"""What runs when: contexts, pipes and shared members of a small tree."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.python.model.lamp_tree import facts_of, write_lamp
from traceability.checks import execution_checks
from traceability.model.design_model import Model
from traceability.model.execution import with_execution
from traceability.schema import Method, Module, Place

MODULES = ("Lamp", "LampState", "Off", "On", "Button", "Work", "Pipe", "Command")


def model_of(root: Path, interrupt: str = "yes") -> tuple[Model, list[tuple[str, str]]]:
    facts = facts_of(root)
    model = Model("", "", "", {})
    place = Place("src/lamp/Lamp.hpp", 1)
    for name in MODULES:
        model.modules[name] = Module(
            name, f"wr::{name}", "lamp", False, False, "", "", "", place, place.file, None
        )
    words = ("Button::execute", "Button", "execute", "", "public", "override")
    count = Method(*words, place, interrupt=interrupt)
    model.modules["Button"] = replace(model.modules["Button"], methods=[count])
    model = with_execution(model, facts)
    return model, [(one.check, one.text) for one in execution_checks.check(model, facts)]


def test_a_handler_reaches_the_command_that_it_was_given(tmp_path: Path) -> None:
    model, _ = model_of(write_lamp(tmp_path))
    button, work = model.contexts["button"], model.contexts["work"]
    assert button.lines == [7]
    assert button.methods == ["Button::execute", "Pipe::write"]
    assert work.lines == [9]
    assert work.first == ["Work::execute"]
    assert "On::wait" in work.methods
    assert "Button::execute" not in work.methods


def test_a_pipe_has_its_writer_and_its_reader(tmp_path: Path) -> None:
    model, findings = model_of(write_lamp(tmp_path))
    [pipe] = model.pipes
    assert (pipe.id, pipe.name) == ("House::presses", "pipe of presses")
    assert pipe.writers == {"Button::execute": ["button"]}
    assert pipe.readers == {"Lamp::tick": ["work"]}
    assert findings == []


def test_a_pipe_outside_classes_tells_what_it_carries(tmp_path: Path) -> None:
    root = write_lamp(tmp_path, start_cpp="struct House { -> Pipe<int> presses;\nstruct House {")
    start = root / "src/lamp/start.cpp"
    text = start.read_text(encoding="utf-8").replace("  Pipe<int> presses;\n", "")
    start.write_text(text, encoding="utf-8")
    [pipe] = model_of(root)[0].pipes
    assert (pipe.id, pipe.type) == ("src/lamp/start.cpp:presses", "Pipe<int>")
    assert pipe.place == Place("src/lamp/start.cpp", 3)


def test_a_pipe_in_a_function_tells_what_it_carries(tmp_path: Path) -> None:
    root = write_lamp(tmp_path, start_cpp="  Pipe<int> presses; -> ")
    start = root / "src/lamp/start.cpp"
    text = start.read_text(encoding="utf-8").replace(
        "lamp(off, presses), button(presses)", "lamp(off, queue()), button(queue())"
    )
    queue = "Pipe<int>& queue() {\n  static Pipe<int> presses;\n  return presses;\n}\n"
    start.write_text(text.replace("struct House", f"{queue}struct House"), encoding="utf-8")
    [pipe] = model_of(root)[0].pipes
    assert (pipe.id, pipe.type) == ("queue presses", "Pipe<int>")


def test_a_shared_member_needs_a_protection(tmp_path: Path) -> None:
    root = write_lamp(tmp_path, execution_toml='members = ["Button::count_"] -> members = []')
    model, findings = model_of(root)
    count = next(one for one in model.shared if one.id == "Button::count_")
    assert (count.writers, count.readers, count.protection) == (["button"], ["work"], "")
    text = (
        "Button::count_ is changed by button and read by work, and nothing says how it is protected"
    )
    assert findings == [("exec-shared", text)]


def test_a_member_of_one_context_is_not_shared(tmp_path: Path) -> None:
    model, _ = model_of(write_lamp(tmp_path))
    assert "On::waited_" not in {one.id for one in model.shared}


def test_an_interrupt_calls_nothing_that_it_must_not(tmp_path: Path) -> None:
    _, findings = model_of(write_lamp(tmp_path), interrupt="no")
    text = (
        "Button::execute is @isr{no}, and the interrupt 'button' calls it: "
        "buttonInterrupt > Button::execute"
    )
    assert findings == [("exec-isr", text)]


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (
            'handlers = ["buttonInterrupt"] -> handlers = []',
            "the handler buttonInterrupt of line 7 belongs to no context",
        ),
        (
            'handlers = ["workInterrupt"] -> handlers = ["workInterrupt", "otherInterrupt"]',
            "work names the handler otherInterrupt, which does not exist",
        ),
        (
            'object = "House::presses" -> object = "House::waits"',
            "the pipe House::presses has no name",
        ),
        (
            'members = ["Button::count_"] -> members = ["Button::count_", "On::waited_"]',
            "On::waited_ is not shared by two contexts",
        ),
    ],
)
def test_declarations_are_compared(tmp_path: Path, change: str, text: str) -> None:
    _, findings = model_of(write_lamp(tmp_path, execution_toml=change))
    assert ("exec-declared", text) in findings


def test_a_second_writer_of_a_pipe_is_found(tmp_path: Path) -> None:
    change = "  lamp_.tick(); ->   button_.execute();\n  lamp_.tick();"
    _, findings = model_of(write_lamp(tmp_path, Lamp_cpp=change))
    text = "more than one context writes the pipe of presses: button, work"
    assert ("exec-shared", text) in findings
