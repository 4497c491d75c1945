#pragma once

#include "sim/k64/VirtualBoard.hpp"
#include "sim/robot/RemoteControl.hpp"
#include "sim/robot/Robot.hpp"

namespace wr {

/// @brief The robot's physics on the pins of the virtual K64.
class BoardBinding {
 public:
  /// @brief Connects pins and physics. From now on the physics take a step at each ms of board time.
  /// @param board the board; it lives as long as the binding
  explicit BoardBinding(k64::VirtualBoard& board);
  BoardBinding(const BoardBinding&) = delete;
  BoardBinding& operator=(const BoardBinding&) = delete;

  /// @brief Takes what the board tells: the step pulses of the steering.
  /// @param event event of the board
  void take(const k64::Event& event);

  sim::Robot physics;
  sim::RemoteControl remoteControl;

 private:
  void beat();
  void drive();
  void measure();

  k64::VirtualBoard& board_;
};

}  // namespace wr
