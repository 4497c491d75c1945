"""What runs when: contexts and pipes of a small tree."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.model.lamp_tree import facts_of, write_lamp
from traceability.model.design_model import Model
from traceability.model.execution import with_execution
from traceability.schema import Module, Place

MODULES = ("Lamp", "LampState", "Off", "On", "Button", "Work", "Pipe", "Command")
START = "src/lamp/start.cpp"
IN_FUNCTION = "Pipe<int>& queue() {\n  static Pipe<int> presses;\n  return presses;\n}\n"


def model_of(root: Path) -> Model:
    model = Model("", "", "", {})
    place = Place("src/lamp/Lamp.hpp", 1)
    for name in MODULES:
        model.modules[name] = Module(
            name, f"wr::{name}", "lamp", False, False, "", "", "", place, place.file, None
        )
    return with_execution(model, facts_of(root))


def test_a_handler_reaches_the_command_that_it_was_given(tmp_path: Path) -> None:
    model = model_of(write_lamp(tmp_path))
    button, work = model.contexts["button"], model.contexts["work"]
    assert button.lines == [7]
    assert button.methods == ["Button::execute", "Pipe::write"]
    assert work.lines == [9]
    assert work.first == ["Work::execute"]
    assert "On::wait" in work.methods
    assert "Button::execute" not in work.methods
    shared = {one.id: (one.writers, one.readers) for one in model.shared}
    assert shared["Button::count_"] == (["button"], ["work"])
    assert "On::waited_" not in shared


def test_a_pipe_has_its_writer_and_its_reader(tmp_path: Path) -> None:
    [pipe] = model_of(write_lamp(tmp_path)).pipes
    assert (pipe.id, pipe.name, pipe.type) == ("House::presses", "pipe of presses", "Pipe<int>")
    assert pipe.writers == {"Button::execute": ["button"]}
    assert pipe.readers == {"Lamp::tick": ["work"]}


@pytest.mark.parametrize(
    ("declared", "name", "identifier"),
    [
        ("Pipe<int> presses;\n", "presses", f"{START}:presses"),
        (IN_FUNCTION, "queue()", "queue presses"),
    ],
)
def test_a_pipe_outside_classes_has_its_type(
    tmp_path: Path, declared: str, name: str, identifier: str
) -> None:
    path = write_lamp(tmp_path) / START
    text = path.read_text(encoding="utf-8").replace("  Pipe<int> presses;\n", "")
    text = text.replace("off, presses), button(presses)", f"off, {name}), button({name})")
    path.write_text(text.replace("struct House", f"{declared}struct House"), encoding="utf-8")
    [pipe] = model_of(tmp_path).pipes
    assert (pipe.id, pipe.type) == (identifier, "Pipe<int>")
