#include "wheel_control/WheelSystem.hpp"

#include <gtest/gtest.h>

#include "sim/host/HostScheduler.hpp"
#include "sim/host/HostThread.hpp"
#include "wheel_control/SensedWheel.hpp"

namespace wr::test {
namespace {

constexpr int kMainPriority = 1;
constexpr int kWheelPriority = 2;

/// One wheel of the robot, with all parts from its interrupts to the values for the main
/// controller.
class WheelSystemTest : public testing::Test, protected SensedWheel {
 protected:
  static SetPoints orderOf(const WheelSetPoint& setPoint) {
    SetPoints order;
    order.wheels.at(kWheel) = setPoint;
    return order;
  }

  static constexpr std::size_t kWheel = 2;

  host::HostScheduler scheduler;
  host::HostThread thread{scheduler, kWheelPriority};
  WheelSystem system{{.wheel = kWheel,
                      .thread = thread,
                      .readVelocity = readVelocity,
                      .registerPosition = registerPosition,
                      .readCurrent = readCurrent,
                      .applyControl = applyControl,
                      .haltWheel = haltWheel}};
};

/// @brief Before its start, the control system of a wheel does no work, completes no cycle and
/// returns no value.
/// @verifies FR-92
TEST_F(WheelSystemTest, FR92_NoWorkBeforeStart) {
  system.control(orderOf(tensionOf(5000)), 1);
  EXPECT_FALSE(system.completed(1));
  Measurements measurements;
  Outputs outputs;
  system.collect(measurements, outputs);
  EXPECT_EQ(measurements, Measurements{});
  EXPECT_EQ(outputs, Outputs{});
  EXPECT_FALSE(enable.isOn());
}

/// @brief The thread executes the orders of a cycle when the scheduler runs the thread. It does not
/// execute them earlier. After the execution, the cycle is complete.
/// @verifies FR-92
TEST_F(WheelSystemTest, FR92_ThreadExecutesTheOrders) {
  system.start();
  pass(true, kMiddle);
  scheduler.interrupt([this] {
    system.control(orderOf(tensionOf(5000)), 7);
    EXPECT_FALSE(system.completed(7));
    EXPECT_EQ(output(), Tension(0));
  });
  EXPECT_TRUE(system.completed(7));
  EXPECT_FALSE(system.completed(6));
  EXPECT_NEAR(output().count(), 5000, 25);
}

/// @brief When a thread of lower priority sends orders, the thread of the wheel executes them
/// immediately.
/// @verifies FR-92
TEST_F(WheelSystemTest, FR92_WorkIsDoneWhenTheMainThreadGoesOn) {
  class Order final : public Command {
   public:
    explicit Order(WheelSystem& ordered) : ordered_(ordered) {}
    void execute() override {
      ordered_.control(orderOf(tensionOf(5000)), 1);
      done = ordered_.completed(1);
    }
    bool done = false;

   private:
    WheelSystem& ordered_;
  };
  Order order(system);
  host::HostThread main(scheduler, kMainPriority);
  system.start();
  main.start(order);
  pass(true, kMiddle);
  main.post();
  EXPECT_TRUE(order.done);
}

/// @brief The thread of one wheel cannot also be the thread of another wheel.
/// @verifies FR-92
TEST_F(WheelSystemTest, FR92_ThreadIsNotShared) {
  WheelSystem other{{.wheel = 0,
                     .thread = thread,
                     .readVelocity = readVelocity,
                     .registerPosition = registerPosition,
                     .readCurrent = readCurrent,
                     .applyControl = applyControl,
                     .haltWheel = haltWheel}};
  system.start();
  EXPECT_DEATH(other.start(), "assertion 3 failed");
}

/// @brief The control system of a wheel writes measured and applied values into the entries of its
/// wheel. The entries of other wheels do not change.
/// @verifies FR-93
/// @verifies FR-94
TEST_F(WheelSystemTest, FR93_FR94_CollectsAtItsPlace) {
  system.start();
  pass(true, kTwoAmperes);
  system.control(orderOf(tensionOf(5000)), 1);
  pass(true, kTwoAmperes);
  system.control(orderOf(tensionOf(5000)), 2);
  Measurements measurements;
  Outputs outputs;
  measurements.wheels[0].velocity = Velocity(77);
  outputs.tensions[1] = Tension(88);
  system.collect(measurements, outputs);
  const WheelMeasurements& wheelTwo = measurements.wheels.at(kWheel);
  EXPECT_EQ(wheelTwo.position, HallCount(20));
  EXPECT_EQ(wheelTwo.velocity, Velocity(1000));
  ASSERT_TRUE(wheelTwo.current);
  EXPECT_NEAR(wheelTwo.current->count(), 2000, 10);
  EXPECT_EQ(outputs.tensions.at(kWheel), Tension(5000));
  EXPECT_EQ(measurements.wheels[0].velocity, Velocity(77));
  EXPECT_EQ(outputs.tensions[1], Tension(88));
}

/// @brief If there was no sample of the current for 200 ms, the current is reported as missing, and
/// the wheel is stopped.
/// @verifies FR-93
TEST_F(WheelSystemTest, FR93_MissingValueIsReportedAsMissing) {
  system.start();
  pass(true, kTwoAmperes);
  system.control(orderOf(tensionOf(5000)), 1);
  time.advance(milliseconds(200));
  system.control(orderOf(tensionOf(5000)), 2);
  Measurements measurements;
  Outputs outputs;
  system.collect(measurements, outputs);
  EXPECT_EQ(measurements.wheels.at(kWheel).current, std::nullopt);
  EXPECT_EQ(outputs.tensions.at(kWheel), Tension(2600)) << "the wheel is being stopped";
}

/// @brief During a hold, the control system of a wheel still measures, and stops the wheel.
/// @verifies FR-88
TEST_F(WheelSystemTest, FR88_HoldStopsTheWheel) {
  system.start();
  pass(true, kMiddle);
  system.control(orderOf(tensionOf(5000)), 1);
  for (std::uint32_t cycle = 2; cycle < 5; ++cycle) {
    pass(true, kMiddle);
    system.hold(cycle);
    EXPECT_TRUE(system.completed(cycle));
  }
  Measurements measurements;
  Outputs outputs;
  system.collect(measurements, outputs);
  EXPECT_EQ(outputs.tensions.at(kWheel), Tension(0));
  EXPECT_EQ(measurements.wheels.at(kWheel).position, HallCount(40));
  EXPECT_EQ(output(), Tension(0));
}

/// @brief An acknowledgement releases faults only in the cycle of the acknowledgement. An
/// overcurrent trip after this cycle is not released by later holds. The next acknowledgement
/// releases it.
/// @verifies FR-89
TEST_F(WheelSystemTest, FR89_AcknowledgementActsOnce) {
  const auto cutOff = [this] {
    Measurements measurements;
    Outputs outputs;
    system.collect(measurements, outputs);
    return measurements.wheels.at(kWheel).cutOff;
  };
  system.start();
  pass(false, kMiddle);
  system.acknowledge(1);
  wheel.cutOff().execute();
  for (std::uint32_t cycle = 2; cycle < 10; ++cycle) {
    pass(false, kMiddle);
    system.hold(cycle);
    EXPECT_TRUE(cutOff()) << cycle;
  }
  pass(false, kMiddle);
  system.acknowledge(10);
  EXPECT_FALSE(cutOff());
}

/// @brief After a second start, the program ends.
/// @verifies FR-176
TEST_F(WheelSystemTest, SecondStartEndsTheProgram) {
  system.start();
  EXPECT_DEATH(system.start(), "assertion 3 failed");
}

}  // namespace
}  // namespace wr::test
