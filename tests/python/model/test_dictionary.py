"""The data dictionary: who makes and who reads a part, and which module writes a field."""

from __future__ import annotations

import pytest

from traceability.model.design_model import Model
from traceability.model.dictionary import with_dictionary
from traceability.reading.declared import Declared
from traceability.reading.source_facts import gather_facts
from traceability.reading.syntax import read_syntax
from traceability.schema import Module, Place

FILES = {
    "src/a/Types.hpp": """\
#pragma once
namespace wr {
struct Speed {
  int count = 0;  ///< turns [rpm]
};
struct Order {
  Speed speed;   ///< how fast
  int stop = 0;  ///< 0 or 1
};
enum class FieldName : unsigned char {
  Speed,     ///< the Speed
  Commands,  ///< the Commands
  Spare      ///< the Spare
};
struct Field { FieldName name; };
class Writer {
 public:
  void writeU8(Field field, int value);
  void writeI16(Field field, int value);
};
class Reader {
 public:
  int readU8(Field field);
};
}  // namespace wr
""",
    "src/a/Maker.hpp": """\
#pragma once
#include "a/Types.hpp"
namespace wr {
class Maker {
 public:
  void make(Order& order, Writer& writer);
  Order stopped();
};
}  // namespace wr
""",
    "src/a/Maker.cpp": """\
#include "a/Maker.hpp"
namespace wr {
namespace {
struct Row { FieldName name; };
constexpr Row kRow{.name = FieldName::Commands};
void writeStop(Writer& writer, const Order& order) {
  writer.writeU8({.name = kRow.name}, order.stop);
}
}  // namespace
void Maker::make(Order& order, Writer& writer) {
  order.speed.count = 3;
  writer.writeI16({.name = FieldName::Speed}, order.speed.count);
  writeStop(writer, order);
}
Order Maker::stopped() { return {.stop = 1}; }
}  // namespace wr
""",
    "src/a/User.hpp": """\
#pragma once
#include "a/Types.hpp"
namespace wr {
class User {
 public:
  int use(const Order& order, Reader& reader) {
    return order.stop + order.speed.count + reader.readU8({.name = FieldName::Commands});
  }
};
}  // namespace wr
""",
}


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Model:
    root = tmp_path_factory.mktemp("types")
    for name, text in FILES.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    place = Place("src/a/Types.hpp", 1)
    syntax = read_syntax(root, root / "cache")
    assert not syntax.errors
    model = Model("", "", "", {})
    for name in ("Order", "Speed", "FieldName", "Maker", "User", "Writer", "Reader"):
        value = name in ("Order", "Speed", "FieldName")
        brief = "Speed of a shaft [0.1 rpm]." if name == "Speed" else ""
        model.modules[name] = Module(
            name, f"wr::{name}", "a", False, value, brief, "", "", place, place.file, None
        )
    return with_dictionary(model, gather_facts(root, syntax, Declared()))


def test_a_part_has_those_who_make_and_read_it(model: Model) -> None:
    stop = model.modules["Order"].parts[1]
    assert (stop.makers, stop.readers) == (["Maker"], ["User"])


def test_a_part_has_the_unit_of_its_text_or_of_its_type(model: Model) -> None:
    assert model.modules["Order"].parts[0].unit == "0.1 rpm"
    assert model.modules["Order"].parts[1].unit == ""
    assert model.modules["Speed"].parts[0].unit == "rpm"


def test_a_field_has_its_width_and_those_who_write_and_read_it(model: Model) -> None:
    speed, stop, spare = model.messages
    assert (speed.text, speed.width, speed.writers) == ("the Speed", "i16", ["Maker"])
    assert (stop.width, stop.writers, stop.readers) == ("u8", ["Maker"], ["User"])
    assert (spare.width, spare.writers, spare.readers) == ("", [], [])
