#include "safety/EnableSwitch.hpp"

#include "main_control/ControllerFixture.hpp"
#include "products/safety/SourceMode.hpp"
#include "safety/EnableBuffer.hpp"
#include "safety/PulsePosition.hpp"
#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/PeriodCollector.hpp"
#include "sensing/instants/WidthCollector.hpp"

namespace wr::test {
namespace {

// Widths of the pulse at the positions of the switch [us].
constexpr int kStopPulse = 1100;
constexpr int kPcPulse = 1500;
constexpr int kDrivePulse = 1900;

/// The enable switch of a remote control. A test sets the signals of the remote control.
class EnableSwitchTest : public ControllerFixture {
 protected:
  EnableSwitchTest() { time.advance(milliseconds(1000)); }

  /// Sets the signals of the remote control, 100 ms after the previous signals.
  void signals(int width, int velocityNow = 0, int directionNow = 0) {
    time.advance(milliseconds(100));
    enable.write(Microseconds(width), time.now());
    velocity.write(Velocity(velocityNow), time.now());
    direction.write(Angle(directionNow), time.now());
    mode.serve();
  }

  bool acknowledges() {
    mode.read(controller);
    return data.setPoints()->acknowledge;
  }

  Pipe<Velocity> velocity;
  Pipe<Angle> direction;
  Pipe<Microseconds> enable;
  Pipe<Microseconds> stop;
  SourceMode source;
  EnableSwitch mode{source,
                    {.velocity = velocity,
                     .direction = direction,
                     .enable = enable,
                     .stop = stop,
                     .timebase = time}};
};

/// @brief changeMode() of the enable switch has no effect.
/// @verifies FR-17
TEST_F(EnableSwitchTest, FR17_LeavesTheChangeOfTheModeToTheMode) {
  const Mode& before = controller.getMode();
  mode.changeMode(controller);
  EXPECT_EQ(&controller.getMode(), &before);
}

/// @brief Without a pulse since power-on, the remote control orders a stop.
/// @verifies FR-285
TEST_F(EnableSwitchTest, FR285_BeginsWithAStop) {
  EXPECT_TRUE(mode.stopOrdered());
  mode.serve();
  EXPECT_TRUE(mode.stopOrdered());
}

/// @brief A pulse shorter than 1250 us orders a stop. A pulse in the band "PC" or "drive" orders no
/// stop.
/// @verifies FR-285
TEST_F(EnableSwitchTest, FR285_ShortPulsesStop) {
  for (const int width : {1350, 1650, 1750, 2100}) {
    signals(kPcPulse);
    signals(width);
    EXPECT_FALSE(mode.stopOrdered()) << width;
    signals(1249);
    EXPECT_TRUE(mode.stopOrdered()) << width;
  }
  signals(kPcPulse);
  signals(1250);
  EXPECT_FALSE(mode.stopOrdered());
}

/// @brief A pulse of the enable switch is valid for 200 ms. After this time, the remote control
/// orders a stop.
/// @verifies FR-285
TEST_F(EnableSwitchTest, FR285_SilenceStops) {
  signals(kDrivePulse);
  time.advance(milliseconds(200));
  mode.serve();
  EXPECT_FALSE(mode.stopOrdered());
  time.advance(Microseconds(1));
  mode.serve();
  EXPECT_TRUE(mode.stopOrdered());
}

/// @brief If the wrapped mode reports a stop, the enable switch also reports this stop. When the
/// switch is served, it also serves the wrapped mode.
/// @verifies FR-285
TEST_F(EnableSwitchTest, FR285_TheWrappedModeCanStop) {
  signals(kDrivePulse);
  EXPECT_EQ(source.served, 1);
  source.stop = true;
  EXPECT_TRUE(mode.stopOrdered());
}

/// @brief If two stop pulses arrive between two cycles, they confirm a stop. The robot then stops
/// in the next cycle, even when the newest pulse already shows the position "drive". The stop ends
/// when the stick is in the middle.
/// @verifies FR-285
/// @verifies FR-286
TEST_F(EnableSwitchTest, FR285_AStopBetweenTwoCyclesActs) {
  signals(kDrivePulse);
  signals(kDrivePulse, 3000);
  EXPECT_FALSE(mode.stopOrdered());
  stop.write(Microseconds(1100), time.now());
  signals(kDrivePulse, 3000);
  EXPECT_TRUE(mode.stopOrdered());
  signals(kDrivePulse, 3000);
  EXPECT_TRUE(mode.stopOrdered());
  signals(kDrivePulse, 0);
  EXPECT_FALSE(mode.stopOrdered());
  signals(kDrivePulse, 3000);
  EXPECT_FALSE(mode.stopOrdered());
}

/// @brief If the width of a pulse is between two bands, the enable switch keeps its position.
/// @verifies FR-285
TEST_F(EnableSwitchTest, FR285_BetweenTheBandsThePositionStays) {
  signals(1300);
  EXPECT_TRUE(mode.stopOrdered());
  signals(kPcPulse);
  signals(1349);
  EXPECT_FALSE(mode.newMessage());
  signals(1651);
  EXPECT_FALSE(mode.newMessage());
  signals(1749);
  EXPECT_FALSE(mode.newMessage());
  signals(1750);
  EXPECT_TRUE(mode.newMessage());
  signals(1651);
  EXPECT_TRUE(mode.newMessage());
  signals(1650);
  EXPECT_FALSE(mode.newMessage());
  signals(kDrivePulse);
  signals(1350);
  EXPECT_FALSE(mode.newMessage());
}

/// @brief A stop lasts until the switch has left "stop" and the velocity stick is in the middle.
/// @verifies FR-286
TEST_F(EnableSwitchTest, FR286_TheStopLastsUntilTheStickIsCentred) {
  signals(kStopPulse);
  for (int cycles = 0; cycles < 50; ++cycles) {
    signals(kDrivePulse, 1);
    EXPECT_TRUE(mode.stopOrdered());
    signals(kPcPulse, -1);
    EXPECT_TRUE(mode.stopOrdered());
  }
  signals(kDrivePulse, 0);
  EXPECT_FALSE(mode.stopOrdered());
  signals(kDrivePulse, 3000);
  EXPECT_FALSE(mode.stopOrdered());
}

/// @brief If the velocity stick has no pulses, the switch alone releases the stop. The stick cannot
/// order a motion in this case.
/// @verifies FR-286
TEST_F(EnableSwitchTest, FR286_ASilentStickIsNotDeflected) {
  signals(kStopPulse, 3000);
  time.advance(milliseconds(150));
  enable.write(Microseconds(kPcPulse), time.now());
  mode.serve();
  EXPECT_TRUE(mode.stopOrdered());
  time.advance(milliseconds(51));
  enable.write(Microseconds(kPcPulse), time.now());
  mode.serve();
  EXPECT_FALSE(mode.stopOrdered());
}

/// @brief In the position "PC", the remote control has no order. In the other positions, the remote
/// control has an order if the wrapped mode has a message.
/// @verifies FR-287
TEST_F(EnableSwitchTest, FR287_NoOrdersInThePositionPc) {
  signals(kDrivePulse);
  EXPECT_TRUE(mode.newMessage());
  source.message = false;
  EXPECT_FALSE(mode.newMessage());
  source.message = true;
  signals(kPcPulse);
  EXPECT_FALSE(mode.newMessage());
  signals(kStopPulse);
  EXPECT_TRUE(mode.newMessage());
}

/// @brief After the sequence "stop", "PC", "drive", the first three orders contain an
/// acknowledgement.
/// @verifies FR-288
TEST_F(EnableSwitchTest, FR288_TheSequenceOfTheSwitchAcknowledges) {
  source.order.orderId = 9;
  signals(kStopPulse);
  signals(kPcPulse);
  signals(kDrivePulse);
  for (int order = 0; order < 3; ++order) {
    EXPECT_TRUE(acknowledges());
    EXPECT_EQ(data.setPoints()->orderId, 9);
  }
  EXPECT_FALSE(acknowledges());
}

/// @brief If a new stop occurs during an acknowledgement, the orders after this stop contain no
/// acknowledgement.
/// @verifies FR-288
TEST_F(EnableSwitchTest, FR288_AStopEndsTheAcknowledgement) {
  signals(kStopPulse);
  signals(kPcPulse);
  signals(kDrivePulse);
  EXPECT_TRUE(acknowledges());
  signals(kStopPulse);
  signals(kDrivePulse);
  EXPECT_FALSE(mode.stopOrdered());
  EXPECT_FALSE(acknowledges());
}

/// @brief While the stick is deflected, no order contains an acknowledgement.
/// @verifies FR-288
TEST_F(EnableSwitchTest, FR288_ADeflectedStickDoesNotAcknowledge) {
  signals(kStopPulse);
  signals(kPcPulse, 100);
  signals(kDrivePulse, 100);
  EXPECT_FALSE(acknowledges());
  signals(kDrivePulse, 0);
  EXPECT_TRUE(acknowledges());
}

/// @brief When the pulses return after a gap, the orders contain no acknowledgement, because no
/// operator has moved the switch.
/// @verifies FR-288
TEST_F(EnableSwitchTest, FR288_AGapOfThePulsesDoesNotAcknowledge) {
  signals(kPcPulse);
  signals(kDrivePulse);
  while (acknowledges()) {
  }
  time.advance(milliseconds(5000));
  mode.serve();
  EXPECT_TRUE(mode.stopOrdered());
  signals(kDrivePulse);
  EXPECT_FALSE(acknowledges());
  signals(kStopPulse);  // a receiver that sends its preset fail-safe pulse
  signals(kDrivePulse);
  EXPECT_FALSE(acknowledges());
  signals(kPcPulse);
  signals(kDrivePulse);
  EXPECT_FALSE(acknowledges());
}

/// @brief If two successive pulses are out of the range, the robot stops, but the pulses do not
/// count as the position "stop". A later change from "PC" to "drive" causes no acknowledgement. If
/// two successive stop pulses are in the range, they count as the position "stop", even if both
/// arrive between two cycles.
/// @verifies FR-288
TEST_F(EnableSwitchTest, FR288_PulsesOutOfTheRangeAreNotThePositionStop) {
  for (const bool stopped : {false, true}) {
    for (const int width : {899, 2101, 900, 1249}) {
      signals(kDrivePulse);
      signals(kDrivePulse);
      if (stopped) {
        signals(kStopPulse);
      }
      signals(kPcPulse);
      stop.write(Microseconds(width), time.now());
      signals(kPcPulse);
      EXPECT_TRUE(mode.stopOrdered()) << width;
      signals(kPcPulse);
      signals(kDrivePulse);
      EXPECT_FALSE(mode.stopOrdered()) << width;
      EXPECT_EQ(acknowledges(), width >= 900 && width <= 2100) << width << " after " << stopped;
      time.advance(milliseconds(2000));
    }
  }
}

/// @brief Two successive pulses out of the range stop the robot. The next pulse, with a width of
/// 1250 us, does not show the position "stop". Therefore a later change from "PC" to "drive" causes
/// no acknowledgement.
/// @verifies FR-288
TEST_F(EnableSwitchTest, FR288_APulseThatOrdersNoStopDoesNotShowThePositionStop) {
  signals(kDrivePulse);
  stop.write(Microseconds(899), time.now());
  signals(1250);
  EXPECT_TRUE(mode.stopOrdered());
  signals(kPcPulse);
  signals(kDrivePulse);
  EXPECT_FALSE(mode.stopOrdered());
  EXPECT_FALSE(acknowledges());
}

/// @brief If the pulses are missing while the switch is in the position "PC", a later change from
/// "PC" to "drive" causes no acknowledgement. The same is true if the remote control is switched on
/// while the switch is in the position "PC".
/// @verifies FR-288
TEST_F(EnableSwitchTest, FR288_AGapInThePositionPcDoesNotAcknowledge) {
  mode.serve();
  signals(kPcPulse);
  signals(kDrivePulse);
  EXPECT_FALSE(acknowledges());
  signals(kStopPulse);
  signals(kPcPulse);
  time.advance(milliseconds(5000));
  mode.serve();
  EXPECT_TRUE(mode.stopOrdered());
  signals(kPcPulse);
  signals(kDrivePulse);
  EXPECT_FALSE(mode.stopOrdered());
  EXPECT_FALSE(acknowledges());
}

/// @brief If the pulses have a gap during an acknowledgement, the orders after this gap contain no
/// acknowledgement.
/// @verifies FR-288
TEST_F(EnableSwitchTest, FR288_AGapEndsTheAcknowledgement) {
  signals(kStopPulse);
  signals(kPcPulse);
  signals(kDrivePulse);
  time.advance(milliseconds(201));
  mode.serve();
  signals(kDrivePulse);
  EXPECT_FALSE(mode.stopOrdered());
  EXPECT_FALSE(acknowledges());
}

/// @brief For 1 s after the sequence "stop", "PC", "drive" of the switch, the orders contain an
/// acknowledgement. This is true even if the switch is moved to "PC" and back to "drive" within
/// this second. Later orders contain no acknowledgement.
/// @verifies FR-288
TEST_F(EnableSwitchTest, FR288_TheAcknowledgementExpires) {
  for (const int cycles : {10, 11, 20}) {
    signals(kStopPulse);
    signals(kPcPulse);
    signals(kDrivePulse);
    for (int cycle = 1; cycle < cycles; ++cycle) {
      signals(cycle == 5 ? kPcPulse : kDrivePulse);
    }
    signals(kDrivePulse);
    EXPECT_EQ(acknowledges(), cycles == 10) << cycles;
  }
}

/// @brief If the pulses order a motion and vary by at most 8 us, the remote control orders a stop
/// after 2 s. It does not order the stop earlier.
/// @verifies FR-289
TEST_F(EnableSwitchTest, FR289_PulsesThatDoNotChangeStop) {
  signals(kDrivePulse, 0);
  for (int cycles = 0; cycles <= 20; ++cycles) {
    signals(kDrivePulse, cycles % 2 == 0 ? 1500 : 1548);  // a change of 8 us
    EXPECT_FALSE(mode.stopOrdered()) << cycles;
  }
  signals(kDrivePulse, 1500);
  EXPECT_TRUE(mode.stopOrdered());
  for (int cycles = 0; cycles < 50; ++cycles) {
    signals(kDrivePulse, 1500);
    EXPECT_TRUE(mode.stopOrdered());
  }
  signals(kDrivePulse, 0);
  EXPECT_FALSE(mode.stopOrdered());
}

/// @brief If the pulses of the steering stick vary by only 8 us, the stop begins after 2 s. Such
/// pulses do not restart the 2 s.
/// @verifies FR-289
TEST_F(EnableSwitchTest, FR289_ATremblingSteeringStickStops) {
  signals(kDrivePulse, 0);
  for (int cycles = 0; cycles <= 20; ++cycles) {
    signals(kDrivePulse, 1500, cycles % 2 == 0 ? 0 : 52);  // a change of 8 us
    EXPECT_FALSE(mode.stopOrdered()) << cycles;
  }
  signals(kDrivePulse, 1500);
  EXPECT_TRUE(mode.stopOrdered());
}

/// @brief Without changes of the pulses, a stop begins after 2 s. If the steering pulses
/// change by exactly 8 us, the 2 s do not begin again. If they change by 9 us, the 2 s begin again.
/// This is tested at each deflection of the steering stick.
/// @verifies FR-289
TEST_F(EnableSwitchTest, FR289_ChangesAreExactAtEachDeflection) {
  const auto angleOf = [](int deflection) { return (deflection * 3200 + 250) / 500; };
  for (const int change : {8, 9}) {
    for (int deflection = 21; deflection + change <= 500; ++deflection) {
      for (const int sign : {1, -1}) {
        signals(kDrivePulse, 0);
        for (int cycles = 0; cycles <= 21; ++cycles) {
          const int moved = deflection + (cycles % 2 == 0 ? 0 : change);
          signals(kDrivePulse, 1500, sign * angleOf(moved));
        }
        EXPECT_EQ(mode.stopOrdered(), change == 8) << change << " us at " << sign * deflection;
      }
    }
  }
}

/// @brief If the pulses of any channel change by more than 8 us, the time of 2 s begins again. The
/// stop begins at the end of this time.
/// @verifies FR-289
TEST_F(EnableSwitchTest, FR289_AChangeOfAnyChannelIsEnough) {
  signals(kDrivePulse, 0);
  for (int cycles = 0; cycles < 200; ++cycles) {
    const bool changed = cycles / 20 % 2 == 1;
    switch (cycles / 60 % 3) {
      case 0:
        signals(kDrivePulse, changed ? 1554 : 1500);  // a change of 9 us
        break;
      case 1:
        signals(kDrivePulse, 1500, changed ? 60 : 0);  // a change of 9 us
        break;
      default:
        signals(changed ? kDrivePulse + 9 : kDrivePulse, 1500);
        break;
    }
    EXPECT_FALSE(mode.stopOrdered()) << cycles;
  }
}

/// @brief In the position "PC" the remote control does not move the robot. Its pulses need not
/// change, even if the stick is deflected.
/// @verifies FR-289
TEST_F(EnableSwitchTest, FR289_InThePositionPcNoChangeIsNecessary) {
  signals(kPcPulse, 0);
  for (int cycles = 0; cycles < 40; ++cycles) {
    signals(kPcPulse, 1500);
    EXPECT_FALSE(mode.stopOrdered()) << cycles;
  }
}

/// @brief While the remote control does not move the robot, its pulses need not change.
/// @verifies FR-289
TEST_F(EnableSwitchTest, FR289_ACentredStickNeedsNoChange) {
  for (int cycles = 0; cycles < 200; ++cycles) {
    signals(kDrivePulse, 0);
    EXPECT_FALSE(mode.stopOrdered());
  }
}

/// The pulses of the enable switch.
class EnableBufferTest : public testing::Test {
 protected:
  std::optional<std::int64_t> pulse(int width, int period = 20000) {
    buffer.signal(true, time.now());
    time.advance(Microseconds(width));
    buffer.signal(false, time.now());
    time.advance(Microseconds(period - width));
    const auto newest = pipe.read();
    const bool present = newest && time.now() - newest->at == Microseconds(period - width);
    return present ? std::optional(newest->value.count()) : std::nullopt;
  }

  FakeTimebase time;
  BasicCollector basic;
  PeriodCollector periods{basic};
  WidthCollector widths{periods};
  PulsePosition function;
  Pipe<Microseconds> pipe;
  Pipe<Microseconds> stop;
  EnableBuffer buffer{widths, function, pipe, stop};
};

/// @brief The width of each pulse is stored with the time at which the pulse ended.
/// @verifies FR-285
TEST_F(EnableBufferTest, FR285_TheWidthOfAPulseIsStored) {
  pulse(1500);
  EXPECT_EQ(pulse(1000), 1000);
  EXPECT_EQ(pulse(1249), 1249);
  EXPECT_EQ(pulse(1500), 1500);
  EXPECT_EQ(pulse(1999), 1999);
}

/// @brief Pulses from 900 us to 2100 us are valid. Other pulses count as missing. Pulses with a
/// period outside of 15 ms to 30 ms also count as missing.
/// @verifies FR-285
/// @verifies FR-55
TEST_F(EnableBufferTest, FR285_PulsesOutOfRangeAreMissing) {
  pulse(1500);
  EXPECT_TRUE(pulse(900).has_value());
  EXPECT_TRUE(pulse(2100).has_value());
  EXPECT_FALSE(pulse(899).has_value());
  EXPECT_FALSE(pulse(2101).has_value());
  for (const int period : {15'000, 30'000}) {
    pulse(1500, period);
    EXPECT_TRUE(pulse(1500).has_value()) << period;
  }
  for (const int period : {14'999, 30'001}) {
    pulse(1500, period);
    EXPECT_FALSE(pulse(1500).has_value()) << period;
  }
}

/// @brief A pulse of at most 1249 us is a stop pulse. A pulse of at least 2101 us is also a stop
/// pulse. A single stop pulse counts as a disturbance. Two successive stop pulses confirm the stop.
/// Later pulses do not cancel the confirmed stop.
/// @verifies FR-285
TEST_F(EnableBufferTest, FR285_TwoSuccessivePulsesConfirmAStop) {
  for (const int width : {1249, 899, 2101}) {
    const Instant begin = time.now();
    pulse(1900);
    pulse(width);
    pulse(1900);
    pulse(width);
    EXPECT_LT(stop.read().value_or(Stamped<Microseconds>()).at, begin + Microseconds(1)) << width;
    const Instant second = time.now() + Microseconds(width);
    pulse(width);
    pulse(1900);
    ASSERT_TRUE(stop.read().has_value()) << width;
    EXPECT_EQ(stop.read()->at, second) << width;
  }
}

/// @brief Pulses from 1250 us to 2100 us do not confirm a stop.
/// @verifies FR-285
TEST_F(EnableBufferTest, FR285_PulsesThatDriveConfirmNoStop) {
  pulse(1500);
  for (const int width : {1250, 1250, 1500, 1900, 2100, 2100}) {
    pulse(width);
  }
  EXPECT_FALSE(stop.read().has_value());
}

}  // namespace
}  // namespace wr::test
