#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "services/SystemConstants.hpp"
#include "system/SteppedRobot.hpp"
#include "usual_design/host/OneWheelLine.hpp"
#include "usual_design/patterns/PatternDesign.hpp"
#include "usual_design/usual/UsualDesign.hpp"

namespace wr::test {

/// The number N. After N failed reads in a row, the last waiting state begins.
inline constexpr int kN = SystemConstants::instance().waitingCycles();

/// The types of both designs. Each test runs for each of these types.
using Designs = testing::Types<UsualDesign, PatternDesign>;

/// Returns the name of a design for the names of its tests.
struct DesignName {
  template <class Design>
  static std::string GetName(int /*index*/) {
    return std::is_same_v<Design, UsualDesign> ? "Usual" : "Patterns";
  }
};

/// The mode changes for the first time at this number of successive failed reads. Each later failed
/// read also changes the mode. As in Figure 7 of the paper, the baseline design changes the mode
/// when its counter reaches N. In the state machine, the N-th failed read leads to the last waiting
/// state. The failed read N + 1 leads to Reconnecting, and the failed read N + 2 changes the mode.
template <class Design>
inline constexpr int kFirstAlternation = kN + 2;
template <>
inline constexpr int kFirstAlternation<UsualDesign> = kN;

/// A design on the host, and a PC on its serial line.
template <class Design>
class OneWheelRobot : public SteppedRobot {
 public:
  template <class... More>
  explicit OneWheelRobot(More&... more)
      : OneWheelRobot(std::make_unique<OneWheelLine<Design>>(more...)) {}

  /// Returns an order of a velocity [0.1 rpm] for the wheel.
  static scenario::PcOrder velocity(std::int16_t value, std::uint16_t id = 1) {
    return {.id = id, .wheels = {{{0, value}}}};
  }

  /// Runs cycles. In each cycle, the PC sends the same order.
  void orderedCycles(const scenario::PcOrder& same, int count) {
    for (int i = 0; i < count; ++i) {
      order(same);
      cycle();
    }
  }

  /// Sends orders until the robot reads an order, because the robot may first read another source.
  void commandByPcAgain(const scenario::PcOrder& same) {
    for (int i = 0; i < 4 && !report().orderRead(); ++i) {
      orderedCycles(same, 1);
    }
  }

  /// Runs cycles with the same order, and returns the mean of the velocities in their reports.
  double meanVelocity(const scenario::PcOrder& same, int count) {
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      orderedCycles(same, 1);
      sum += report().velocity[0];
    }
    return sum / count;
  }

 private:
  explicit OneWheelRobot(std::unique_ptr<OneWheelLine<Design>> owner)
      : OneWheelRobot(*owner, owner) {}
  OneWheelRobot(OneWheelLine<Design>& robot, std::unique_ptr<OneWheelLine<Design>>& owner)
      : SteppedRobot(std::move(owner)), line(robot) {}

 public:
  OneWheelLine<Design>& line;
};

/// A suite of tests for both designs.
template <class Design>
class OfBothDesigns : public testing::Test {
 protected:
  OneWheelRobot<Design> robot;
};

}  // namespace wr::test
