#include "remote_control/RcBuffer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "communication/serialization/BufferReader.hpp"
#include "functions/RcDirection.hpp"
#include "functions/RcVelocity.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "main_control/operation_modes/RC.hpp"
#include "remote_control/DirectionBuffer.hpp"
#include "remote_control/RcPin.hpp"
#include "remote_control/ReadRcPin.hpp"
#include "remote_control/VelocityBuffer.hpp"
#include "sensing/FakeEdgeInput.hpp"
#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/PeriodCollector.hpp"
#include "sensing/instants/WidthCollector.hpp"
#include "support/FakeTimebase.hpp"

namespace wr::test {
namespace {

/// One signal of the remote control, with all objects from its pin to its pipe.
template <class Buffer, class Lever, class Value>
struct Signal {
  explicit Signal(FakeTimebase& timebase) : time(timebase) { pin.start(); }

  void level(bool high) {
    input.set(high);
    pin.serve();
  }

  /// Generates a pulse and the pause after the pulse, up to the end of the period.
  void pulse(int width, int period = 20'000) {
    level(true);
    time.advance(Microseconds(width));
    level(false);
    time.advance(Microseconds(period - width));
  }

  [[nodiscard]] std::optional<int> value() {
    const std::optional<Stamped<Value>> newest = pipe.read();
    return newest ? std::optional<int>(newest->value.count()) : std::nullopt;
  }

  FakeTimebase& time;
  FakeEdgeInput input;
  BasicCollector basic;
  PeriodCollector periods{basic};
  WidthCollector widths{periods};
  Lever function;
  Pipe<Value> pipe;
  Buffer buffer{widths, function, pipe};
  RcPin pin{input, read};
  ReadRcPin read{buffer, pin, time};
};

using VelocitySignal = Signal<VelocityBuffer, RcVelocity, Velocity>;
using DirectionSignal = Signal<DirectionBuffer, RcDirection, Angle>;

class RcBufferTest : public testing::Test {
 protected:
  FakeTimebase time;
  VelocitySignal velocity{time};
  DirectionSignal direction{time};
};

/// @brief The pulses at the pins set a velocity and an angle. The velocity is positive forwards,
/// and the angle is positive to the left.
/// @verifies FR-52
TEST_F(RcBufferTest, FR52_PulsesSetVelocityAndAngle) {
  EXPECT_TRUE(velocity.input.started);
  for (const int width : {1000, 1250, 1400, 1521, 1750, 2000}) {
    velocity.pulse(width);
    velocity.pulse(width);
    EXPECT_EQ(velocity.value(), (width - 1500) * 6);
    direction.pulse(width);
    direction.pulse(width);
    EXPECT_EQ(direction.value(), std::lround((width - 1500) * 6.4));
  }
}

/// @brief A value of the remote control has the time at which its pulse ended.
/// @verifies FR-52
TEST_F(RcBufferTest, FR52_TellsWhenThePulseEnded) {
  velocity.pulse(1700);
  velocity.level(true);
  time.advance(Microseconds(1700));
  velocity.level(false);
  EXPECT_EQ(velocity.pipe.read()->at, time.now());
}

/// @brief An interrupt of another pin of the port does not count as an edge of this pin.
/// @verifies FR-52
TEST_F(RcBufferTest, FR52_InterruptOfAnotherPin) {
  velocity.pulse(1700);
  velocity.input.high = true;  // the level changes, but no edge is pending
  velocity.pin.serve();
  Instants instants;
  velocity.widths.fill(instants);
  EXPECT_EQ(instants.width, Microseconds(1700));
  EXPECT_EQ(instants.last, Instant(1700));
}

/// @brief When a stick is near its centre, it sets the value 0.
/// @verifies FR-53
TEST_F(RcBufferTest, FR53_MiddleSetsZero) {
  direction.pulse(1800);
  direction.pulse(1800);
  EXPECT_EQ(direction.value(), 1920);
  for (const int width : {1480, 1500, 1520}) {
    direction.pulse(width);
    EXPECT_EQ(direction.value(), 0);
  }
}

/// @brief If a pulse is slightly beyond an end of the stick, it counts as full deflection. If it is
/// far beyond the end, it sets no value.
/// @verifies FR-54
TEST_F(RcBufferTest, FR54_WidthOutOfRange) {
  velocity.pulse(1500);
  velocity.pulse(2100);
  EXPECT_EQ(velocity.value(), 3000);
  velocity.pulse(900);
  EXPECT_EQ(velocity.value(), -3000);
  velocity.pulse(1500);
  for (const int width : {100, 899, 2101, 14'000}) {
    velocity.pulse(width);
    EXPECT_EQ(velocity.value(), 0);
  }
}

/// @brief A pulse sets no value when the previous pulse began less than 15 ms or more than 30 ms
/// earlier.
/// @verifies FR-55
TEST_F(RcBufferTest, FR55_PeriodOutOfRange) {
  velocity.pulse(1600);
  velocity.pulse(1600);
  ASSERT_EQ(velocity.value(), 600);
  for (const int period : {3000, 14'999, 30'001, 500'000}) {
    velocity.pulse(1700, period);
    velocity.pulse(1800);
    EXPECT_NE(velocity.value(), 1800) << period;
    velocity.pulse(1600);
    EXPECT_EQ(velocity.value(), 600);
  }
  for (const int period : {15'000, 30'000}) {
    velocity.pulse(1700, period);
    velocity.pulse(1800);
    EXPECT_EQ(velocity.value(), 1800) << period;
  }
}

/// @brief The first pulse sets no value, because there is no pulse before it.
/// @verifies FR-55
TEST_F(RcBufferTest, FR55_FirstPulse) {
  velocity.pulse(1600);
  EXPECT_FALSE(velocity.value());
}

/// @brief A lost edge affects only the pulse of this edge.
/// @verifies FR-54
/// @verifies FR-55
TEST_F(RcBufferTest, FR55_LostEdges) {
  velocity.pulse(1600);
  velocity.pulse(1600);
  const auto edge = [&](bool rising, int after) {
    time.advance(Microseconds(after));
    velocity.buffer.signal(rising, time.now());
    return velocity.value();
  };
  EXPECT_EQ(edge(false, 1700), 600);  // the previous edge was lost
  edge(true, 18'300);                 // the next edge is lost
  edge(true, 20'000);
  EXPECT_EQ(edge(false, 1700), 1200);
}

/// @brief If a pulse is much too long, it sets no value. This is true even when the lower 32 bits
/// of its width are the width of a valid pulse.
/// @verifies FR-54
TEST_F(RcBufferTest, FR54_LineThatStaysHigh) {
  for (const std::int64_t width : {std::int64_t{21'500}, (std::int64_t{1} << 32) + 1600}) {
    velocity.pulse(1600);
    velocity.level(true);
    time.advance(Microseconds(width));
    velocity.level(false);
    EXPECT_FALSE(velocity.value());
    time.advance(milliseconds(100));
  }
}

class RcPathTest : public RcBufferTest {
 protected:
  /// Generates pulses on both pins for some periods.
  void bothPulse(int count) {
    for (int i = 0; i < count; ++i) {
      velocity.pulse(1750, 10'000);
      direction.pulse(1250, 10'000);
    }
  }

  BufferReader reader{velocity.pipe, direction.pipe, time};
  BasicMode basic{reader};
  RC mode{basic, basic};
};

/// @brief With pulses on both pins, the mode RC has a message.
/// @verifies FR-56
TEST_F(RcPathTest, FR56_MessageWithPulses) {
  EXPECT_FALSE(mode.newMessage());
  bothPulse(3);
  EXPECT_TRUE(mode.newMessage());
  EXPECT_EQ(reader.readI16({.name = FieldName::WheelValue}), 1500);
  EXPECT_EQ(reader.readI16({.name = FieldName::Steering}), -1600);
}

/// @brief When the pulses end on both pins, the message can be read until the older of the two last
/// pulses is 200 ms old.
/// @verifies FR-56
TEST_F(RcPathTest, FR56_NoMessageWithoutPulses) {
  bothPulse(3);
  const Instant older = velocity.pipe.read()->at;  // the last pulse at the pin of the velocity
  time.advance(older + milliseconds(200) - time.now());
  EXPECT_TRUE(mode.newMessage());
  time.advance(Microseconds(1));
  EXPECT_FALSE(mode.newMessage());
}

/// @brief Pulses on only one pin are not a message.
/// @verifies FR-56
TEST_F(RcPathTest, FR56_OnePinIsNoMessage) {
  bothPulse(3);
  for (int i = 0; i < 12; ++i) {
    velocity.pulse(1750);
  }
  EXPECT_FALSE(mode.newMessage());
  bothPulse(1);
  bothPulse(1);
  EXPECT_TRUE(mode.newMessage());
  for (int i = 0; i < 12; ++i) {
    direction.pulse(1750);
  }
  EXPECT_FALSE(mode.newMessage());
}

/// @brief Pulses that set no value do not prolong the time in which the message can be read.
/// @verifies FR-56
TEST_F(RcPathTest, FR56_BadPulsesAreNoMessage) {
  bothPulse(3);
  for (int i = 0; i < 12; ++i) {
    velocity.pulse(500, 10'000);
    direction.pulse(1250, 10'000);
  }
  EXPECT_FALSE(mode.newMessage());
}

}  // namespace
}  // namespace wr::test
