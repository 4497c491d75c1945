#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "sim/robot/RemoteControl.hpp"
#include "sim/robot/Robot.hpp"
#include "sim/scenario/RobotLine.hpp"
#include "sim/scenario/Words.hpp"

namespace wr {

/// @brief Events around the robot: everything in a scenario that does not come over the line of the PC.
namespace world {

/// @brief The sticks move; nothing: the transmitter is off.
struct RemoteControl {
  std::optional<sim::Sticks> sticks;
};
struct Enable {
  sim::EnablePosition position;
};
struct FailSafe {
  sim::FailSafe kind;
};
struct Tremor {
  double microseconds;
};
struct Coincident {
  bool on;
};
struct Slope {
  double percent;
};
struct Grip {
  double share;
};
struct Noise {
  bool on;
};
struct Fault {
  sim::Fault fault;
  std::size_t wheel;
  bool present;
  double value;
};
struct EmergencyStop {
  sim::EmergencyStop state;
};
struct VariedPlant {
  bool varied;
};
struct PlantParameter {
  sim::Parameter parameter;
  double value;
};
struct Clock {
  bool present;
};
struct Reset {
  ResetKind kind;
};

}  // namespace world

using WorldAction =
    std::variant<world::RemoteControl, world::Enable, world::FailSafe, world::Tremor,
                 world::Coincident, world::Slope, world::Grip, world::Noise, world::Fault,
                 world::EmergencyStop, world::VariedPlant, world::PlantParameter, world::Clock,
                 world::Reset>;

/// @brief Reads an action of the world.
///
/// rc velocity N steering N; rc off; rc enable stop|pc|drive; rc failsafe none|hold|neutral; rc
/// tremor MICROSECONDS; rc coincident on|off; slope PERCENT; grip PERCENT; noise on|off; estop
/// press, estop press brake, estop release; plant nominal|varied; plant PARAMETER VALUE; clock
/// lost|back; reset; reset power; fault and mend with a fault:
///
/// hall W, hall-a W, hall-b W, hall-swapped W, hall-misplaced W DEGREES, hall-glitches W RATE,
/// hall-losses W RATE, leads W, block W, current W, current-stuck W, current-offset W MA, angle,
/// angle-open, angle-stuck, angle-drift RATE, stall, left-end, right-end.
/// @param word first word of the action
/// @param words the words after it
/// @return the action; nothing if the word begins no action of the world
[[nodiscard]] std::optional<WorldAction> readWorldAction(const std::string& word, Words& words);

/// @brief Reads an action of the world from a line of its own. Throws ScenarioError.
/// @param line the line
/// @return the action
[[nodiscard]] WorldAction worldActionOf(const std::string& line);

/// @brief Lets an action of the world happen, now.
/// @param action the action
/// @param robot the robot
void act(const WorldAction& action, RobotLine& robot);

}  // namespace wr
