#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "sim/plant/RemoteControl.hpp"
#include "sim/plant/Robot.hpp"
#include "sim/scenario/RobotSession.hpp"
#include "sim/scenario/Words.hpp"

namespace wr::scenario {

/// @brief Actions on the robot and its surroundings. All actions of a scenario are actions of this
/// kind, except the actions of the PC, the action 'mark' and the expectations.
namespace world {

/// @brief Moves the sticks. Without a value, switches the transmitter off.
struct MoveSticks {
  std::optional<plant::Sticks> sticks;
};
struct SetEnable {
  plant::EnablePosition position;
};
struct SetFailSafe {
  plant::FailSafe kind;
};
struct SetTremor {
  double microseconds;
};
struct SetCoincident {
  bool on;
};
struct SetSlope {
  double percent;
};
struct SetGrip {
  double share;
};
struct SetNoise {
  bool on;
};
struct SetFault {
  plant::Fault fault;
  std::size_t wheel;
  bool present;
  double value;
};
struct SetEmergencyStop {
  plant::EmergencyStop state;
};
struct VaryPlant {
  bool varied;
};
struct SetParameter {
  plant::Parameter parameter;
  double value;
};
struct SetClock {
  bool present;
};
struct ResetBoard {
  ResetKind kind;
};

}  // namespace world

using WorldAction =
    std::variant<world::MoveSticks, world::SetEnable, world::SetFailSafe, world::SetTremor,
                 world::SetCoincident, world::SetSlope, world::SetGrip, world::SetNoise,
                 world::SetFault, world::SetEmergencyStop, world::VaryPlant, world::SetParameter,
                 world::SetClock, world::ResetBoard>;

/// @brief Reads an action of the world.
///
/// The actions are: rc velocity N steering N; rc off; rc enable stop|pc|drive|stop-pc|pc-drive; rc
/// failsafe none|hold|neutral; rc tremor MICROSECONDS; rc coincident on|off; slope PERCENT; grip
/// PERCENT; noise on|off; estop press; estop press brake; estop release; plant nominal|varied;
/// plant PARAMETER VALUE; clock lost|back; reset; reset power; fault FAULT; repair FAULT.
///
/// FAULT is one of these faults (W is the number of a wheel): hall W, hall-a W, hall-b W,
/// hall-swapped W, hall-misplaced W DEGREES, hall-glitches W RATE, hall-losses W RATE, leads W,
/// block W, current W, current-open W, current-stuck W, current-offset W MA, angle, angle-open,
/// angle-stuck, angle-drift RATE, stall, left-end, right-end.
/// @param word first word of the action
/// @param words the words after the first word
/// @return the action; nothing if no action of the world begins with the word
[[nodiscard]] std::optional<WorldAction> readWorldAction(const std::string& word, Words& words);

/// @brief Reads an action of the world from a separate line. Throws ScenarioError.
/// @param line the line of text
/// @return the action
[[nodiscard]] WorldAction worldActionOf(const std::string& line);

/// @brief Executes an action of the world now.
/// @param action the action
/// @param robot the robot
void act(const WorldAction& action, RobotSession& robot);

}  // namespace wr::scenario
