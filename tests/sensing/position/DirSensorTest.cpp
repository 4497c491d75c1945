#include "sensing/position/DirSensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "functions/SampledAngle.hpp"
#include "sensing/FakeAnalogInput.hpp"
#include "support/FakeTimebase.hpp"
#include "support/seed.hpp"

namespace wr::test {
namespace {

class DirSensorTest : public testing::Test {
 protected:
  /// Runs one tick. `sample` is the result of the conversion that was requested at the previous
  /// tick, or nothing if this conversion has not ended. Returns true when the tick has ended a
  /// measurement.
  bool tick(std::optional<int> sample) {
    time.advance(milliseconds(1));
    if (sample) {
      input.result = static_cast<std::uint16_t>(*sample);
    }
    return sensor.measure();
  }

  void ticks(int count, int sample) {
    for (int i = 0; i < count; ++i) {
      static_cast<void>(tick(sample));
    }
  }

  [[nodiscard]] int angle() { return pipe.read()->value.count(); }

  FakeTimebase time;
  FakeAnalogInput input;
  SampledAngle function;
  Pipe<Angle> pipe;
  DirSensor sensor{input, function, time, pipe};
};

/// @brief At each tick, the sensor reads the sample that it requested at the previous tick, and
/// requests the next sample.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_SamplesAtEachTick) {
  ticks(3, 2048);
  EXPECT_EQ(input.conversions, 3);
  EXPECT_FALSE(input.result);
}

/// @brief There is no angle before the first 8 samples. Then, at each 8th tick, the sensor writes a
/// new angle with its time, and returns true.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_OneAngleInEightTicks) {
  for (int measurement = 1; measurement <= 3; ++measurement) {
    for (int i = 0; i < 7; ++i) {
      EXPECT_FALSE(tick(2048 + measurement * 512));
      EXPECT_EQ(pipe.read().has_value(), measurement > 1);
    }
    EXPECT_TRUE(tick(2048 + measurement * 512));
    ASSERT_TRUE(pipe.read());
    EXPECT_EQ(angle(), measurement * 1000);
    EXPECT_EQ(pipe.read()->at, time.now());
  }
}

/// @brief The function gets the sum of 8 samples and the duration of the sampling.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_ArgumentsOfTheFunction) {
  // Records its arguments.
  class RecordedFunction final : public Function {
   public:
    [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override {
      arguments.fill(values);
      return 0;
    }
    mutable ArgumentValues values;
  };
  RecordedFunction recorded;
  DirSensor recording(input, recorded, time, pipe);
  for (int i = 0; i < 8; ++i) {
    input.result = 2050;
    static_cast<void>(recording.measure());
  }
  EXPECT_EQ(recorded.values[ArgumentId::Raw], 8 * 2050);
  EXPECT_EQ(recorded.values[ArgumentId::Elapsed], 8000);
  EXPECT_EQ(recorded.values[ArgumentId::Scale], 8000);
  EXPECT_EQ(recorded.values[ArgumentId::Divisor], 8 * 4096);
  EXPECT_EQ(recorded.values[ArgumentId::Offset], 8 * 2048);
}

/// @brief The range of the sensor is 80 degrees. The middle of the range is straight ahead, and a
/// higher value is farther to the left.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_ScaleOfTheSensor) {
  for (const int sample : {82, 512, 1024, 2047, 2048, 2049, 3000, 3686, 4013}) {
    ticks(8, sample);
    EXPECT_NEAR(angle(), (sample - 2048) * 8000.0 / 4096, 0.5) << sample;
  }
}

/// @brief The angle is the mean of the last 8 samples only.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_MeanOfEight) {
  ticks(8, 2048);
  for (int i = 0; i <= 8; ++i) {
    ticks(8 - i, 2048);
    ticks(i, 2048 + 512);
    EXPECT_NEAR(angle(), 1000 * i / 8.0, 0.5) << i;
    ticks(i, 2048 - 512);
    ticks(8 - i, 2048);
    EXPECT_NEAR(angle(), -1000 * i / 8.0, 0.5) << i;
  }
}

/// @brief The mean is rounded to the nearest number.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_MeanIsRounded) {
  ticks(7, 2048);
  ticks(1, 2050);  // the mean is 0.49
  EXPECT_EQ(angle(), 0);
  ticks(7, 2048);
  ticks(1, 2051);  // the mean is 0.73
  EXPECT_EQ(angle(), 1);
  ticks(7, 2048);
  ticks(1, 2045);
  EXPECT_EQ(angle(), -1);
}

/// @brief Noise of 0.05 degrees rms is smoothed to less than 0.021 degrees rms.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_NoiseIsSmoothed) {
  std::mt19937 random(seed());
  std::normal_distribution<double> noise(0, 5 * 4096.0 / 8000);
  constexpr double kAngle = 1234;
  double squares = 0;
  constexpr int kMeasurements = 500;
  for (int i = 0; i < kMeasurements; ++i) {
    for (int k = 0; k < 8; ++k) {
      ticks(1, static_cast<int>(std::lround(2048 + kAngle * 4096 / 8000 + noise(random))));
    }
    squares += std::pow(angle() - kAngle, 2);
  }
  EXPECT_LT(std::sqrt(squares / kMeasurements), 2.1);
}

/// @brief A sample near an end of the range is rejected, and its measurement writes no angle. The
/// measurement still ends at its 8th tick. The next measurement writes an angle.
/// @verifies FR-130
TEST_F(DirSensorTest, FR130_RefusesTheEndsOfTheRange) {
  for (const int broken : {0, 81, 4014, 4095}) {
    for (int place = 0; place < 8; ++place) {
      ticks(8, 2148);
      const Instant before = pipe.read()->at;
      ticks(place, 2148);
      const bool ended = tick(broken);
      EXPECT_EQ(ended, place == 7);
      for (int i = place + 1; i < 8; ++i) {
        EXPECT_EQ(tick(2148), i == 7);
      }
      EXPECT_EQ(pipe.read()->at, before);
      ticks(8, 2248);
      EXPECT_EQ(angle(), 391);
      EXPECT_EQ(pipe.read()->at, time.now());
    }
  }
}

/// @brief If a sensor is broken for a long time, it has no angle. Its measurements still end.
/// @verifies FR-130
TEST_F(DirSensorTest, FR130_BrokenForLong) {
  int ended = 0;
  for (int i = 0; i < 800; ++i) {
    ended += tick(i % 2 == 0 ? 0 : 4095) ? 1 : 0;
  }
  EXPECT_EQ(ended, 100);
  EXPECT_FALSE(pipe.read());
}

/// @brief If a sample is missing, the measurement writes no angle. The next measurement writes an
/// angle.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_TickWithoutSample) {
  ticks(8, 2148);
  const Instant before = pipe.read()->at;
  EXPECT_FALSE(tick(std::nullopt));
  EXPECT_EQ(input.conversions, 9);
  ticks(6, 2148);
  EXPECT_TRUE(tick(2148));
  EXPECT_EQ(pipe.read()->at, before);
  ticks(8, 2148);
  EXPECT_EQ(pipe.read()->at, time.now());
}

/// A function that returns no angle.
class NoFunction final : public Function {
 public:
  [[nodiscard]] std::optional<std::int32_t> calculate(
      const Arguments& /*arguments*/) const override {
    return std::nullopt;
  }
};

/// @brief When the function returns no angle, nothing is written.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_NothingWithoutAnAngle) {
  const NoFunction none;
  DirSensor mute(input, none, time, pipe);
  for (int i = 1; i <= 8; ++i) {
    input.result = std::uint16_t{2048};
    EXPECT_EQ(mute.measure(), i == 8);
  }
  EXPECT_FALSE(pipe.read());
}

}  // namespace
}  // namespace wr::test
