"""A small folder of sources with the same structure as the real sources. It has two reading
modes, two operation states and one test."""

from __future__ import annotations

from pathlib import Path

from tests.python.project_files import write_files

# The two modes differ only in their names. The two states also differ only in their names.
MODE_HEADER = """\
#pragma once

#include "main_control/operation_modes/Mode.hpp"

namespace wr {

/// @brief Orders from the NAME.
/// @role{reading-modes, Concrete State}
///
/// @function Reads orders from the NAME.
///
/// @secret The signal by which the NAME shows a new order.
class NAME final : public Mode {
 public:
  /// @param other the other mode [one that exists]
  explicit NAME(Mode& other) : other_(other) {}

  [[nodiscard]] bool newMessage() const override;
  void changeMode(MainController& mCtrl) override;

 private:
  Mode& other_;
};

}  // namespace wr
"""
MODE_SOURCE = """\
#include "main_control/operation_modes/NAME.hpp"

#include "main_control/MainController.hpp"

namespace wr {

bool NAME::newMessage() const { return false; }

void NAME::changeMode(MainController& mCtrl) { mCtrl.changeMode(other_); }

}  // namespace wr
"""
STATE_HEADER = """\
#pragma once

#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief The state NAME.
///
/// @function Acts in NAME.
///
/// @secret The state that follows NAME.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class NAME final : public OperationState {
 public:
  /// @param next the next state
  explicit NAME(OperationState& next) : next_(next) {}

 private:
  void actionWithMsg(MainController& mCtrl, Mode& md) override;
  void actionNoMsg(MainController& mCtrl, Mode& md) override;

  OperationState& next_;
};

}  // namespace wr
"""
STATE_SOURCE = """\
#include "main_control/operation_states/NAME.hpp"

#include "main_control/MainController.hpp"
#include "main_control/operation_modes/Mode.hpp"

namespace wr {

void NAME::actionWithMsg(MainController& mCtrl, Mode& md) { md.changeMode(mCtrl); }

void NAME::actionNoMsg(MainController& mCtrl, Mode& /*md*/) { mCtrl.changeOpState(next_); }

}  // namespace wr
"""
TWINS = {
    "src/main_control/operation_modes": (MODE_HEADER, MODE_SOURCE, ("PC", "RC")),
    "src/main_control/operation_states": (STATE_HEADER, STATE_SOURCE, ("Waiting", "Working")),
}
FILES = {
    "requirements/reading.dox": """\
/** @page requirements-reading Reading orders
  Requirements for the reading of orders.
*/

/**
@requirement FR-15 The system shall set a waiting state if no message can be read from any source.

@rationale A lost message is not yet a lost link.

@source decision: how orders are read.

@level system

@product all

@method test

@priority high
*/
""",
    "src/main_control/MainController.cpp": """\
#include "main_control/MainController.hpp"

#include "main_control/operation_states/OperationState.hpp"

namespace wr {

MainController::MainController(OperationState& initial, Mode& mode)
    : opSt_(&initial), mode_(&mode) {}

void MainController::read() { opSt_->read(*this); }

void MainController::changeOpState(OperationState& next) { opSt_ = &next; }

void MainController::changeMode(Mode& next) { mode_ = &next; }

}  // namespace wr
""",
    "src/main_control/MainController.hpp": """\
#pragma once

namespace wr {

class Mode;
class OperationState;

/// @brief Runs the control cycle.
///
/// @function Stores the current state and the current mode.
///
/// @secret The order of the steps of a cycle.
///
/// @role{reading-modes, Context}
/// @role{operation-states, Context}
class MainController {
 public:
  /// @param initial the first state
  /// @param mode the first mode
  MainController(OperationState& initial, Mode& mode);

  /// @brief Reads one order.
  /// @pre The controller is started.
  /// @isr{no}
  void read();

  /// @brief Changes the state.
  /// @param next the new state
  void changeOpState(OperationState& next);

  /// @brief Changes the mode.
  /// @param next the new mode
  void changeMode(Mode& next);

  /// @brief The current mode.
  /// @return the mode
  [[nodiscard]] Mode& getMode() const { return *mode_; }

 private:
  OperationState* opSt_;
  Mode* mode_;
};

}  // namespace wr
""",
    "src/main_control/module.dox": """\
/** @dir src/main_control
@brief MainControl runs the cycle.

@function Runs the control cycle.

@secret The state machine of the cycle.
*/
""",
    "src/main_control/operation_modes/Mode.hpp": """\
#pragma once

namespace wr {

class MainController;

/// @brief One source of orders.
///
/// @function Reads orders.
///
/// @secret The source of an order.
///
/// @patternapp{reading-modes, State, Reading modes}
/// @why The way of reading depends on the source.
/// @changes A new source; a changed protocol.
///
/// @role{reading-modes, State}
class Mode {
 public:
  /// @brief Returns whether an order has arrived.
  /// @return true when there is one
  /// @satisfies FR-15
  [[nodiscard]] virtual bool newMessage() const = 0;

  /// @brief Selects the other mode.
  /// @param mCtrl the controller
  virtual void changeMode(MainController& mCtrl) = 0;

  Mode(const Mode&) = delete;
  Mode& operator=(const Mode&) = delete;

 protected:
  Mode() = default;
  ~Mode() = default;
};

}  // namespace wr
""",
    "src/main_control/operation_modes/module.dox": """\
/** @dir src/main_control/operation_modes
@brief OperationModes reads orders.

@function Reads orders from one source.

@secret The source of the orders.
*/
""",
    "src/main_control/operation_states/OperationState.cpp": """\
#include "main_control/operation_states/OperationState.hpp"

#include "main_control/MainController.hpp"
#include "main_control/operation_modes/Mode.hpp"

namespace wr {

void OperationState::read(MainController& mCtrl) {
  Mode& md = mCtrl.getMode();
  if (md.newMessage()) {
    actionWithMsg(mCtrl, md);
  } else {
    actionNoMsg(mCtrl, md);
  }
}

}  // namespace wr
""",
    "src/main_control/operation_states/OperationState.hpp": """\
#pragma once

namespace wr {

class MainController;
class Mode;

/// @brief Runs the control cycle.
///
/// @function Reads an order and acts on it.
///
/// @secret The steps that depend on the state.
///
/// @patternapp{operation-states, State, Operation states of the main controller}
/// @why The behaviour depends on the state.
/// @changes A new state.
///
/// @patternapp{read-orders, Template Method, Read orders in the operation states}
/// @why The steps are the same in each state.
/// @changes A new method for a step.
///
/// @role{operation-states, State}
/// @role{read-orders, Abstract Class}
class OperationState {
 public:
  /// @brief Reads one order.
  /// @param mCtrl the controller
  /// @satisfies FR-15
  void read(MainController& mCtrl);

 protected:
  /// @brief Acts on a message.
  /// @param mCtrl the controller
  /// @param md the mode
  virtual void actionWithMsg(MainController& mCtrl, Mode& md) = 0;
  /// @brief Acts without a message.
  /// @param mCtrl the controller
  /// @param md the mode
  virtual void actionNoMsg(MainController& mCtrl, Mode& md) = 0;
  OperationState() = default;
  ~OperationState() = default;
};

}  // namespace wr
""",
    "src/main_control/operation_states/module.dox": """\
/** @dir src/main_control/operation_states
@brief OperationStates acts on the cycle.

@function Acts on the cycle.

@secret The set of operation states.
*/
""",
    "tests/main_control/WorkingTest.cpp": """\
#include <gtest/gtest.h>

/// @brief Without a message the controller waits.
/// @verifies FR-15
TEST(Working, WaitsWithoutMessage) {
  EXPECT_TRUE(true);
}
""",
    "design/trees/reading.tree": """\
FR-15
MainController::read
  Working::read
    Working::actionNoMsg
      MainController::changeOpState
""",
}


def write_tree(root: Path) -> Path:
    files = dict(FILES)
    for folder, (header, source, names) in TWINS.items():
        for name in names:
            files[f"{folder}/{name}.hpp"] = header.replace("NAME", name)
            files[f"{folder}/{name}.cpp"] = source.replace("NAME", name)
    return write_files(root, files)
