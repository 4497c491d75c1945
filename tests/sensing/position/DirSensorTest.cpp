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
  /// One tick, at which the conversion of the tick before has given a sample.
  void tick(std::optional<int> sample) {
    time.advance(milliseconds(1));
    if (sample) {
      input.result = static_cast<std::uint16_t>(*sample);
    }
    sensor.measure();
  }

  void ticks(int count, int sample) {
    for (int i = 0; i < count; ++i) {
      tick(sample);
    }
  }

  [[nodiscard]] int angle() { return pipe.read()->value.count(); }

  FakeTimebase time;
  FakeAnalogInput input;
  SampledAngle function;
  Pipe<Angle> pipe;
  DirSensor sensor{input, function, time, pipe};
};

/// @brief Each tick takes the sample of the tick before and asks for the next.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_SamplesAtEachTick) {
  ticks(3, 2048);
  EXPECT_EQ(input.conversions, 3);
  EXPECT_FALSE(input.result);
}

/// @brief There is no angle before 8 samples have come; then there is one at each tick, with its
/// time.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_FirstAngleAfterEightSamples) {
  ticks(7, 2048);
  EXPECT_FALSE(pipe.read());
  tick(2048);
  ASSERT_TRUE(pipe.read());
  EXPECT_EQ(angle(), 0);
  tick(2048);
  EXPECT_EQ(pipe.read()->at, time.now());
}

/// @brief The whole range is 80 degrees, its middle is straight on, and higher is to the left.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_ScaleOfTheSensor) {
  for (const int sample : {82, 512, 1024, 2047, 2048, 2049, 3000, 3686, 4013}) {
    ticks(8, sample);
    EXPECT_NEAR(angle(), (sample - 2048) * 8000.0 / 4096, 0.5) << sample;
  }
}

/// @brief The angle is the mean of the last 8 samples, and no older one.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_MeanOfTheLastEight) {
  ticks(8, 2048);
  for (int i = 1; i <= 8; ++i) {
    tick(2048 + 512);
    EXPECT_NEAR(angle(), 1000 * i / 8.0, 0.5) << i;
  }
  for (int i = 1; i <= 8; ++i) {
    tick(2048 - 512);
    EXPECT_NEAR(angle(), 1000 - 2000 * i / 8.0, 0.5) << i;
  }
}

/// @brief The mean is rounded to the nearest number.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_MeanIsRounded) {
  ticks(8, 2048);
  tick(2051);
  EXPECT_EQ(angle(), 1);
  ticks(8, 2048);
  tick(2045);
  EXPECT_EQ(angle(), -1);
}

/// @brief Noise of 0.05 degree rms is smoothed to less than 0.02 degree rms.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_NoiseIsSmoothed) {
  std::mt19937 random(seed());
  std::normal_distribution<double> noise(0, 5 * 4096.0 / 8000);
  constexpr double kAngle = 1234;
  double squares = 0;
  constexpr int kTicks = 4000;
  for (int i = 0; i < kTicks; ++i) {
    tick(static_cast<int>(std::lround(2048 + kAngle * 4096 / 8000 + noise(random))));
    if (pipe.read()) {
      squares += std::pow(angle() - kAngle, 2);
    }
  }
  EXPECT_LT(std::sqrt(squares / kTicks), 2.1);
}

/// @brief A sample near an end of the range is refused, and no angle is written until 8 good ones
/// have followed.
/// @verifies FR-130
TEST_F(DirSensorTest, FR130_RefusesTheEndsOfTheRange) {
  for (const int broken : {0, 81, 4014, 4095}) {
    ticks(8, 2148);
    const Instant before = pipe.read()->at;
    tick(broken);
    ticks(7, 2248);
    EXPECT_EQ(pipe.read()->at, before);
    tick(2248);
    EXPECT_EQ(angle(), 391);
    EXPECT_EQ(pipe.read()->at, time.now());
  }
}

/// @brief A tick without a sample writes nothing and forgets nothing.
/// @verifies FR-129
TEST_F(DirSensorTest, FR129_TickWithoutSample) {
  ticks(8, 2148);
  const Instant before = pipe.read()->at;
  tick(std::nullopt);
  EXPECT_EQ(pipe.read()->at, before);
  EXPECT_EQ(input.conversions, 9);
  tick(2148);
  EXPECT_EQ(pipe.read()->at, time.now());
}

}  // namespace
}  // namespace wr::test
