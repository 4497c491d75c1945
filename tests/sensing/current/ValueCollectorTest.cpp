#include "sensing/current/ValueCollector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "devices/SecondTimer.hpp"
#include "functions/SampledCurrent.hpp"
#include "sensing/CountingCommand.hpp"
#include "sensing/FakeAnalogInput.hpp"
#include "sensing/current/CntSensor.hpp"
#include "sensing/current/ReadCnt.hpp"
#include "support/FakeTimebase.hpp"
#include "support/seed.hpp"
#include "wheel_control/Wheel.hpp"

namespace wr::test {
namespace {

// The range of the sensor, 33 A, has 4096 steps of the converter.
constexpr int kWithin15A = 15'000 * 4096 / 33'000;  // greatest number of steps within 15 A
constexpr int kTolerance = 4096 * 5 / 100;          // greatest number of steps within 5 %

/// A timer. The test triggers its ticks.
class TickTimer final : public PeriodicTimer {
 public:
  void start(Microseconds /*period*/) override {}
  void stop() override {}
  void acknowledge() override {}
};

class CurrentTest : public testing::Test {
 protected:
  CurrentTest() { timer.add(readCnt); }

  /// Runs one tick. `sample` is the result of the conversion that was requested at the previous
  /// tick, or nothing if this conversion has not ended.
  void tick(std::optional<int> sample) {
    time.advance(milliseconds(1));
    if (sample) {
      input.result = static_cast<std::uint16_t>(*sample);
    }
    timer.expired();
  }

  void ticks(int count, int sample) {
    for (int i = 0; i < count; ++i) {
      tick(sample);
    }
  }

  /// Measures, and returns the value in the pipe.
  std::optional<Stamped<Current>> measured() {
    sensor.measure();
    return pipe.read();
  }

  FakeTimebase time;
  FakeAnalogInput input;
  CountingCommand overcurrent;
  ValueCollector collector{overcurrent, time};
  ReadCnt readCnt{input, collector};
  TickTimer tickTimer;
  SecondTimer timer{tickTimer};
  SampledCurrent function;
  Pipe<Current> pipe;
  CntSensor sensor{collector, function, pipe};
};

/// @brief At each tick of the second timer, the sample that was requested at the previous tick is
/// read, and the next sample is requested.
/// @verifies FR-100
/// @verifies FR-125
TEST_F(CurrentTest, FR100_EachTickSamples) {
  for (int i = 1; i <= 80; ++i) {
    tick(2048);
    EXPECT_EQ(input.conversions, i);
    EXPECT_FALSE(input.result);
  }
  EXPECT_EQ(collector.record().number, 80U - 64U);
  EXPECT_EQ(collector.record().at, time.now());
}

/// @brief The collector writes its record at each eighth sample, with the time of this sample.
/// @verifies FR-125
TEST_F(CurrentTest, FR125_RecordInGroupsOfEight) {
  ticks(64 + 7, 2049);
  EXPECT_EQ(collector.record().number, 0U);
  tick(2049);
  const Instant at = time.now();
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(collector.record().number, 8U);
    EXPECT_EQ(collector.record().sum, 0U);
    EXPECT_EQ(collector.record().at, at);
    tick(2050);
  }
  EXPECT_EQ(collector.record().number, 16U);
  EXPECT_EQ(collector.record().sum, 8U);
}

/// @brief The mean of a cycle is correct even if the sum of the samples overflows. With a negative
/// current, the sum underflows at the first sample. With a positive current, the sum rises until it
/// overflows.
/// @verifies FR-125
TEST_F(CurrentTest, FR125_SumsMayWrap) {
  ticks(64, 2048);
  ticks(800, 2048 - 1000);
  EXPECT_EQ(measured()->value, Current(-8057));
  ticks(1600, 2048 + 1000);
  EXPECT_EQ(measured()->value, Current(8057));
  std::uint32_t before = collector.record().sum;
  bool wrapped = false;
  while (!wrapped) {
    for (int i = 0; i < 100'000; ++i) {
      collector.collect(2048 + kWithin15A);
    }
    EXPECT_EQ(measured()->value, Current(14993));
    wrapped = collector.record().sum < before;
    before = collector.record().sum;
  }
}

/// @brief If no conversion has ended since the previous tick, this tick has no sample. The command
/// still calls the input once at this tick.
/// @verifies FR-125
TEST_F(CurrentTest, FR125_TickWithoutSample) {
  ticks(71, 2048);
  tick(std::nullopt);
  EXPECT_EQ(collector.record().number, 0U);
  EXPECT_EQ(input.conversions, 72);
  tick(2048);
  EXPECT_EQ(collector.record().number, 8U);
}

/// @brief The current of a cycle is the mean of its samples. A voltage of 0.1 V means a
/// current of 1 A, and the range of 3.3 V has 4096 steps.
/// @verifies FR-125
TEST_F(CurrentTest, FR125_MeanOfTheCycle) {
  ticks(64, 2048);
  for (const double amperes : {0.0, 1.0, 5.0, 10.0, 14.9, -1.0, -7.77, -14.9}) {
    const double exact = 2048 + amperes * 0.1 / 3.3 * 4096;
    double carried = 0;
    for (int i = 0; i < 104; ++i) {  // samples whose mean is the exact value
      carried += exact;
      const int sample = static_cast<int>(std::lround(carried));
      carried -= sample;
      tick(sample);
    }
    ASSERT_TRUE(measured());
    EXPECT_NEAR(pipe.read()->value.count(), amperes * 1000, 1);
    EXPECT_EQ(pipe.read()->at, time.now());
  }
  EXPECT_EQ(overcurrent.executions, 0);
}

/// @brief Samples of one cycle do not affect the next cycle.
/// @verifies FR-125
TEST_F(CurrentTest, FR125_EachCycleOfItsOwn) {
  ticks(64, 2048);
  ticks(96, 2048 + 1000);
  EXPECT_EQ(measured()->value, Current(8057));
  ticks(8, 2048);
  EXPECT_EQ(measured()->value, Current(0));
}

/// @brief The samples of an incomplete group are used in the next cycle.
/// @verifies FR-125
TEST_F(CurrentTest, FR125_NoSampleIsLost) {
  ticks(64, 2048);
  ticks(100, 2048);
  EXPECT_EQ(measured()->value, Current(0));
  ticks(4, 2048 + 1000);
  EXPECT_EQ(measured()->value, Current(4028))
      << "the group has 4 earlier samples and 4 new samples";
}

/// @brief If there was no sample since the previous measurement, no value is written. The last
/// value becomes old.
/// @verifies FR-125
TEST_F(CurrentTest, FR125_NothingWithoutSamples) {
  EXPECT_FALSE(measured());
  ticks(64, 2048);
  EXPECT_FALSE(measured());
  ticks(100, 2148);
  const Stamped<Current> before = *measured();
  time.advance(milliseconds(100));
  const Stamped<Current> after = *measured();
  EXPECT_EQ(after.at, before.at);
  EXPECT_EQ(after.value, before.value);
}

/// @brief The mean of a cycle reduces the noise of the sensor. When each sample has a noise of 50
/// mA rms, the error of a measured current of 4 A is at most 50 mA.
/// @verifies FR-125
/// @verifies FR-126
TEST_F(CurrentTest, FR125_NoiseAveragesOut) {
  std::mt19937 random(seed());
  std::normal_distribution<double> noise(0, 50.0 / 8.0566);
  const auto noisy = [&](double value) {
    return static_cast<int>(std::lround(value + noise(random)));
  };
  for (int i = 0; i < 64; ++i) {
    tick(noisy(2100.3));  // a noise of 6 mA rms remains in the zero point
  }
  for (int i = 0; i < 100; ++i) {
    tick(noisy(2100.3 + 4 / 0.0080566));  // a noise of 5 mA rms remains in the mean
  }
  EXPECT_NEAR(measured()->value.count(), 4000, 50);
}

/// @brief The mean of the first 64 samples becomes the zero point of the sensor. The distance of
/// this mean from the middle may be at most 5 % of the range.
/// @verifies FR-126
TEST_F(CurrentTest, FR126_ZeroIsLearned) {
  for (const int zero : {2048 - kTolerance, 2000, 2048 + kTolerance}) {
    ValueCollector fresh(overcurrent, time);
    for (int i = 0; i < 64 + 16; ++i) {
      fresh.collect(static_cast<std::uint16_t>(zero));
    }
    EXPECT_EQ(fresh.record().number, 16U);
    EXPECT_EQ(fresh.record().sum, 0U);
  }
}

/// @brief If the distance of the zero point from the middle is more than 5 % of the range, the
/// sensor is broken. All later samples are ignored.
/// @verifies FR-126
TEST_F(CurrentTest, FR126_ImplausibleZero) {
  for (const int zero : {0, 2048 - kTolerance - 1, 2048 + kTolerance + 1, 4095}) {
    ValueCollector fresh(overcurrent, time);
    CntSensor reader(fresh, function, pipe);
    for (int i = 0; i < 64; ++i) {
      fresh.collect(static_cast<std::uint16_t>(zero));
    }
    for (int i = 0; i < 1000; ++i) {
      fresh.collect(2048);
    }
    reader.measure();
    EXPECT_FALSE(pipe.read());
  }
}

/// @brief The zero point is the mean of its samples, rounded to the nearest number.
/// @verifies FR-126
TEST_F(CurrentTest, FR126_ZeroIsTheMean) {
  ticks(32, 2040);
  ticks(32, 2049);
  ticks(8, 2045);
  EXPECT_EQ(collector.record().number, 8U);
  EXPECT_EQ(collector.record().sum, 0U);
}

/// @brief When five successive samples are beyond 15 A in either direction, the driver is switched
/// off. The command that switches the driver off is executed in the interrupt of the fifth sample.
/// This command is executed again in the interrupt of each following sample that is too high.
/// @verifies FR-128
TEST_F(CurrentTest, FR128_FiveInARow) {
  ticks(64, 2048);
  for (const int sample : {2048 + kWithin15A + 1, 2048 - kWithin15A - 1}) {
    overcurrent.executions = 0;
    ticks(4, sample);
    EXPECT_EQ(overcurrent.executions, 0);
    tick(sample);
    EXPECT_EQ(overcurrent.executions, 1);
    ticks(3, sample);
    EXPECT_EQ(overcurrent.executions, 4);
    tick(2048);
    EXPECT_EQ(overcurrent.executions, 4);
  }
}

/// @brief If samples are beyond 15 A, they count as samples in a row, even if their direction
/// alternates. A tick without a sample does not restart the count.
/// @verifies FR-128
TEST_F(CurrentTest, FR128_EitherDirectionCounts) {
  ticks(64, 2048);
  tick(2048 + kWithin15A + 1);
  tick(2048 - kWithin15A - 1);
  tick(2048 + kWithin15A + 1);
  tick(std::nullopt);
  tick(2048 - kWithin15A - 1);
  EXPECT_EQ(overcurrent.executions, 0);
  tick(2048 + kWithin15A + 1);
  EXPECT_EQ(overcurrent.executions, 1);
}

/// @brief If one sample is within 15 A, the count of samples that are too high begins again.
/// @verifies FR-128
TEST_F(CurrentTest, FR128_NotInARow) {
  ticks(64, 2048);
  for (int i = 0; i < 20; ++i) {
    ticks(4, 2048 + kWithin15A + 1);
    tick(2048 + kWithin15A);
  }
  EXPECT_EQ(overcurrent.executions, 0);
}

/// @brief The overcurrent trip also acts on the extreme values of the converter (0 and 4095), even
/// if the extreme value is less than 15 A from the zero point.
/// @verifies FR-128
TEST_F(CurrentTest, FR128_EndOfTheRange) {
  struct Sensor {
    std::uint16_t zero;
    std::uint16_t end;
  };
  for (const Sensor sensed : {Sensor{2048 + kTolerance, 4095}, Sensor{2048 - kTolerance, 0}}) {
    overcurrent.executions = 0;
    ValueCollector fresh(overcurrent, time);
    for (int i = 0; i < 64; ++i) {
      fresh.collect(sensed.zero);
    }
    for (int i = 0; i < 4; ++i) {
      fresh.collect(sensed.end);
    }
    EXPECT_EQ(overcurrent.executions, 0);
    fresh.collect(sensed.end);
    EXPECT_EQ(overcurrent.executions, 1);
  }
}

/// @brief The zero point may be less than 15 A from an end of the range of the converter. At this
/// end the overcurrent trip then acts only on the extreme value (0 or 4095).
/// @verifies FR-128
TEST_F(CurrentTest, FR128_OnlyTheVeryEnd) {
  struct Sensor {
    std::uint16_t zero;
    std::uint16_t last;
    std::uint16_t end;
  };
  for (const Sensor sensed :
       {Sensor{2048 - kTolerance, 1, 0}, Sensor{2048 + kTolerance, 4094, 4095}}) {
    overcurrent.executions = 0;
    ValueCollector fresh(overcurrent, time);
    for (int i = 0; i < 64; ++i) {
      fresh.collect(sensed.zero);
    }
    for (int i = 0; i < 10; ++i) {
      fresh.collect(sensed.last);
    }
    EXPECT_EQ(overcurrent.executions, 0);
    for (int i = 0; i < 5; ++i) {
      fresh.collect(sensed.end);
    }
    EXPECT_EQ(overcurrent.executions, 1);
  }
}

/// @brief If the mean of a cycle is more than 16 A from the zero point, the current of the cycle is
/// missing. A broken sensor has a value at an end of the range. Therefore this value is not
/// reported.
/// @verifies FR-125
TEST_F(CurrentTest, FR125_EndOfTheRangeIsNoMeasurement) {
  ticks(64, 2048);
  ticks(104, 0);
  EXPECT_FALSE(measured());
  ticks(104, 2048 - 1987);
  EXPECT_FALSE(measured());
  ticks(104, 2048 + 1987);
  EXPECT_FALSE(measured());
  ticks(104, 2048 + 1986);
  EXPECT_EQ(measured()->value, Current(16000));
}

class FakePwm final : public PwmOutput {
 public:
  void set(DutyCycle dutyCycle) override { duty = dutyCycle; }
  DutyCycle duty{};
};

class FakeSwitch final : public DigitalOutput {
 public:
  void set(bool level) override { on = level; }
  bool on = false;
};

/// @brief At the fifth sample that is too high, the driver is switched off, before any control
/// cycle. The test includes the whole path from the tick of the timer to the driver.
/// @verifies FR-128
TEST(Overcurrent, FR128_SwitchesTheDriverOff) {
  FakeTimebase time;
  FakePwm pwm;
  FakeSwitch orientation;
  FakeSwitch enable;
  Wheel wheel(pwm, orientation, enable);
  FakeAnalogInput input;
  ValueCollector collector(wheel.cutOff(), time);
  ReadCnt readCnt(input, collector);
  TickTimer tickTimer;
  SecondTimer timer(tickTimer);
  timer.add(readCnt);
  const auto ticks = [&](int count, std::uint16_t sample) {
    for (int i = 0; i < count; ++i) {
      time.advance(milliseconds(1));
      input.result = sample;
      timer.expired();
    }
  };
  ticks(64, 2048);
  wheel.setTension(Tension(24000));
  ticks(4, 4095);
  EXPECT_TRUE(enable.on);
  ticks(1, 4095);
  EXPECT_FALSE(enable.on);
  EXPECT_TRUE(wheel.isCutOff());
}

}  // namespace
}  // namespace wr::test
