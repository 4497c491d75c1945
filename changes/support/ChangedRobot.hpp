#pragma once

#include <memory>
#include <string>

#include "sim/emulator/Image.hpp"
#include "support/image.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {

/// Name of the unchanged firmware image. This image contains the design of the paper without
/// extensions. It is compiled with the same options as the firmware images of the kits. A kit is a
/// folder of changes/ with a file change.toml.
inline constexpr const char* kUnchanged = "weeding_robot_paper";

/// A virtual board that runs the unchanged firmware image or the firmware image of a kit. A finding
/// of the virtual K64 ends the test.
class ChangedRobot : public SteppedRobot {
 public:
  explicit ChangedRobot(const std::string& image)
      : ChangedRobot(switchProductOn(image, emulator::readImage(imageOf(image)))) {}

  /// Returns the share of the PWM period in which a wheel has the supply voltage.
  [[nodiscard]] double duty(int wheel) const { return session_.board.pwmDuty(0, wheel); }

  /// Returns whether the red light of the board is on. The light is on while its pin is low.
  [[nodiscard]] bool redLight() const { return !session_.board.pin('B', 22); }

  /// Orders a voltage [mV] for all wheels, and runs the cycle.
  void orderVoltage(std::int16_t millivolts) {
    scenario::PcOrder next{.id = 3};
    next.wheels.fill({.quantity = 1, .value = millivolts});
    order(next);
    cycle();
  }

  /// Orders a steering angle [0.01 degree], and runs the cycle.
  void orderSteering(std::int16_t angle) {
    order({.id = 3, .steering = angle});
    cycle();
  }

  [[nodiscard]] emulator::VirtualBoard& board() { return session_.board; }

 private:
  explicit ChangedRobot(std::unique_ptr<board_robot::BoardSession> session)
      : ChangedRobot(*session, session) {}
  ChangedRobot(board_robot::BoardSession& session,
               std::unique_ptr<board_robot::BoardSession>& owner)
      : SteppedRobot(std::move(owner)), session_(session) {}

  board_robot::BoardSession& session_;
};

}  // namespace wr::test
