"""A lamp: two states, the interrupt of its button, a thread, and a pipe between the two."""

from __future__ import annotations

from pathlib import Path

from traceability.reading.declared import read_declared
from traceability.reading.source_facts import Facts, gather_facts
from traceability.reading.syntax import read_syntax

FILES = {
    "src/lamp/Command.hpp": """\
#pragma once
namespace wr {
class Command {
 public:
  virtual void execute() = 0;
};
}  // namespace wr
""",
    "src/lamp/Pipe.hpp": """\
#pragma once
namespace wr {
template <class T>
class Pipe {
 public:
  void write(const T& value) { value_ = value; }
  T read() { return value_; }

 private:
  T value_{};
};
}  // namespace wr
""",
    "src/lamp/Lamp.hpp": """\
#pragma once
#include "lamp/Command.hpp"
#include "lamp/Pipe.hpp"
namespace wr {
class Lamp;
class LampState {
 public:
  virtual void press(Lamp& lamp) = 0;
  virtual void wait(Lamp& lamp);
};
class Lamp {
 public:
  Lamp(LampState& initial, Pipe<int>& presses);
  void tick();
  void changeState(LampState& next);

 private:
  LampState* state_;
  Pipe<int>& presses_;
};
class Off final : public LampState {
 public:
  explicit Off(LampState& on);
  void press(Lamp& lamp) override;

 private:
  LampState& on_;
};
class On final : public LampState {
 public:
  explicit On(LampState& off);
  void press(Lamp& lamp) override;
  void wait(Lamp& lamp) override;

 private:
  void leave(Lamp& lamp, LampState& next);
  LampState& off_;
  int waited_ = 0;
};
class Button final : public Command {
 public:
  explicit Button(Pipe<int>& presses);
  void execute() override;
  int count() const;

 private:
  Pipe<int>& presses_;
  int count_ = 0;
};
class Work final : public Command {
 public:
  Work(Lamp& lamp, Button& button);
  void execute() override;

 private:
  Lamp& lamp_;
  Button& button_;
};
}  // namespace wr
""",
    "src/lamp/Lamp.cpp": """\
#include "lamp/Lamp.hpp"
namespace wr {
void LampState::wait(Lamp&) {}
Lamp::Lamp(LampState& initial, Pipe<int>& presses) : state_(&initial), presses_(presses) {}
void Lamp::tick() {
  if (presses_.read() != 0) {
    state_->press(*this);
  } else {
    state_->wait(*this);
  }
}
void Lamp::changeState(LampState& next) { state_ = &next; }
Off::Off(LampState& on) : on_(on) {}
void Off::press(Lamp& lamp) { lamp.changeState(on_); }
On::On(LampState& off) : off_(off) {}
void On::press(Lamp& lamp) { leave(lamp, off_); }
void On::wait(Lamp& lamp) {
  ++waited_;
  if (waited_ > 2) {
    leave(lamp, off_);
  }
}
void On::leave(Lamp& lamp, LampState& next) {
  waited_ = 0;
  lamp.changeState(next);
}
Button::Button(Pipe<int>& presses) : presses_(presses) {}
void Button::execute() {
  ++count_;
  presses_.write(count_);
}
int Button::count() const { return count_; }
Work::Work(Lamp& lamp, Button& button) : lamp_(lamp), button_(button) {}
void Work::execute() {
  lamp_.tick();
  button_.count();
}
}  // namespace wr
""",
    "src/lamp/start.cpp": """\
#include "lamp/Lamp.hpp"
namespace wr {
struct House {
  House() : off(on), on(off), lamp(off, presses), button(presses), work(lamp, button) {}
  Pipe<int> presses;
  Off off;
  On on;
  Lamp lamp;
  Button button;
  Work work;
};
House house;
Command* pressed = &house.button;
Command* body = &house.work;
constexpr int kButtonLine = 7;
constexpr int kWorkLine = 9;
}  // namespace wr
void buttonInterrupt() { wr::pressed->execute(); }
void workInterrupt() { wr::body->execute(); }
void (*lines[16])();
void connect() {
  lines[wr::kButtonLine] = buttonInterrupt;
  lines[wr::kWorkLine] = workInterrupt;
}
""",
    "design/applications.toml": """\
[[application]]
id = "lamp-states"
pattern = "State"
[application.roles]
State = ["LampState"]
"Concrete State" = ["Off", "On"]
Context = ["Lamp"]
""",
    "design/fsm/lamp.toml": """\
id = "lamp-states"
title = "States of the lamp"
application = "lamp-states"
initial = "Off"

[states]
Off = "Off"
On = "On"

[events]
press = "press"
wait = "wait"

[[transition]]
from = "Off"
on = "press"
to = "On"
requirements = ["FR-1"]
""",
    "design/execution.toml": """\
ends = []

[[context]]
id = "button"
kind = "interrupt"
name = "button"
says = "Counts."
handlers = ["buttonInterrupt"]

[[context]]
id = "work"
kind = "thread"
name = "work"
says = "Changes the lamp."
handlers = ["workInterrupt"]
body = "Work::execute"

[[pipe]]
object = "House::presses"
name = "pipe of presses"
says = "How often the button was pressed."
""",
}


def write_lamp(root: Path) -> Path:
    for name, text in FILES.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return root


def facts_of(root: Path) -> Facts:
    syntax = read_syntax(root, root / "cache")
    assert not syntax.errors
    return gather_facts(root, syntax, read_declared(root))
