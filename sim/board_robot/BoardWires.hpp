#pragma once

#include "sim/emulator/VirtualBoard.hpp"
#include "sim/plant/RemoteControl.hpp"
#include "sim/plant/Robot.hpp"

namespace wr::board_robot {

/// @brief The connections between the pins of the virtual K64 and the physics of the robot.
class BoardWires {
 public:
  /// @brief Connects the pins to the physics. After this, the physics advance by one step in each
  /// ms of board time.
  /// @param board the board; it must outlive the wires
  explicit BoardWires(emulator::VirtualBoard& board);
  BoardWires(const BoardWires&) = delete;
  BoardWires& operator=(const BoardWires&) = delete;

  /// @brief Passes the step pulses of the steering to the plant.
  /// @param event event of the board
  void take(const emulator::Event& event);

  plant::Robot physics;
  plant::RemoteControl remoteControl;

 private:
  void step();
  void drive();
  void measure();

  emulator::VirtualBoard& board_;
};

}  // namespace wr::board_robot
