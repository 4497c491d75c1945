#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "k64/BoardRobot.hpp"
#include "k64/DriverBoard.hpp"

namespace wr::test {
namespace {

constexpr double kReference = 3.3;

struct Input {
  int converter;
  int channel;
};

// The currents of the wheels, and the angle of the steering.
constexpr std::array<Input, 5> kInputs{{{0, 12}, {0, 13}, {1, 14}, {1, 15}, {1, 6}}};

constexpr std::uint32_t kConverterBegin = 0x4003B000;
constexpr std::uint32_t kDistance = 0x80000;
constexpr std::uint32_t kStatus1 = 0;
constexpr std::uint32_t kStatus3 = 0x24;
constexpr std::uint32_t kNoChannel = 0x1F;
constexpr std::uint32_t kCalibrate = 0x80;

void apply(DriverBoard& drivers, std::size_t input, double volts) {
  drivers.board.setAnalog(kInputs.at(input).converter, kInputs.at(input).channel, volts);
}

/// @brief Each input returns its voltage in units of 3.3 V / 4096. This is also true at the ends of
/// the range.
/// @verifies FR-142
TEST(K64AdcOnBoard, FR142_EachInputGivesItsVoltage) {
  DriverBoard drivers;
  drivers.startUp();
  constexpr std::array<std::uint16_t, 6> kValues{0, 1, 1000, 2048, 4094, 4095};
  for (std::size_t round = 0; round < kValues.size(); ++round) {
    for (std::size_t input = 0; input < kInputs.size(); ++input) {
      apply(drivers, input, kReference / 4096 * kValues.at((round + input) % kValues.size()));
    }
    drivers.run(milliseconds(3));
    const std::vector<std::uint16_t> samples = drivers.ask('A');
    ASSERT_EQ(samples.size(), 2 * kInputs.size());
    for (std::size_t input = 0; input < kInputs.size(); ++input) {
      EXPECT_EQ(samples[2 * input + 1], kValues.at((round + input) % kValues.size())) << input;
    }
  }
}

/// @brief Each of the five inputs has one new value per millisecond, although the inputs share two
/// converters and the program requests each value twice.
/// @verifies FR-142
TEST(K64AdcOnBoard, FR142_EachInputGivesAValueInEachMillisecond) {
  DriverBoard drivers;
  drivers.startUp();
  const std::vector<std::uint16_t> before = drivers.ask('A');
  drivers.run(milliseconds(994));
  const std::vector<std::uint16_t> after = drivers.ask('A');  // the answer takes 6 ms
  ASSERT_EQ(after.size(), 2 * kInputs.size());
  for (std::size_t input = 0; input < kInputs.size(); ++input) {
    EXPECT_EQ(after[2 * input] - before[2 * input], 1000) << input;
  }
}

/// @brief Each input is converted exactly once in each tick.
/// @verifies FR-142
TEST(K64AdcOnBoard, FR142_EachInputIsConvertedOnceInEachTick) {
  constexpr std::uint32_t kTick = 16 + 49;
  constexpr std::size_t kTicks = 200;
  DriverBoard drivers;
  drivers.startUp();
  std::vector<std::array<int, kInputs.size()>> ticks;
  drivers.board.onEvent([&](const emulator::Event& event) {
    if (event.kind == emulator::Event::Kind::LineRaised && event.number == kTick) {
      ticks.emplace_back();
    }
  });
  drivers.board.onWrite([&](std::uint32_t address, unsigned /*size*/, std::uint32_t value) {
    for (std::size_t input = 0; input < kInputs.size() && !ticks.empty(); ++input) {
      const auto converter = static_cast<std::uint32_t>(kInputs.at(input).converter);
      const auto channel = static_cast<std::uint32_t>(kInputs.at(input).channel);
      if (address == kConverterBegin + converter * kDistance && (value & kNoChannel) == channel) {
        ++ticks.back().at(input);
      }
    }
  });
  drivers.run(milliseconds(kTicks + 1));
  ASSERT_GE(ticks.size(), kTicks);
  for (std::size_t tick = 0; tick + 1 < ticks.size(); ++tick) {
    EXPECT_EQ(ticks[tick], (std::array{1, 1, 1, 1, 1})) << tick;
  }
}

/// @brief When the calibration of only one converter fails, the inputs of this converter have no
/// value. The inputs of the other converter have values.
/// @verifies FR-143
TEST(K64AdcOnBoard, FR143_OneConverterFailsAlone) {
  for (const int failed : {0, 1}) {
    DriverBoard drivers({.elf = {}, .calibrates = {failed != 0, failed != 1}});
    drivers.startUp();
    drivers.run(milliseconds(100));
    const std::vector<std::uint16_t> samples = drivers.ask('A');
    ASSERT_EQ(samples.size(), 2 * kInputs.size());
    for (std::size_t input = 0; input < kInputs.size(); ++input) {
      EXPECT_EQ(samples[2 * input] == 0, kInputs.at(input).converter == failed) << input;
    }
  }
}

/// @brief An open input without a resistor to ground has the value of the previously converted
/// input. With the resistor, its value is 0.
/// @verifies FR-205
TEST(K64AdcOnBoard, FR205_OpenInputNeedsItsResistor) {
  DriverBoard drivers;
  drivers.startUp();
  apply(drivers, 2, kReference / 2);
  apply(drivers, 3, kReference / 2);
  drivers.board.openAnalog(kInputs[4].converter, kInputs[4].channel);
  drivers.run(milliseconds(10));
  EXPECT_EQ(drivers.ask('A')[9], 2048) << "the input has the charge of the previous input";
  apply(drivers, 4, 0.0);
  drivers.run(milliseconds(10));
  EXPECT_EQ(drivers.ask('A')[9], 0);
}

/// @brief Each converter is calibrated before its first conversion. The start takes less than 10
/// ms.
/// @verifies FR-143
TEST(K64AdcOnBoard, FR143_ConvertersAreCalibratedBeforeTheyConvert) {
  DriverBoard drivers;
  std::array<bool, 2> calibrated{};
  std::array<bool, 2> converted{};
  drivers.board.onWrite([&](std::uint32_t address, unsigned /*size*/, std::uint32_t value) {
    for (std::size_t converter = 0; converter < 2; ++converter) {
      const auto begin = static_cast<std::uint32_t>(kConverterBegin + converter * kDistance);
      if (address == begin + kStatus3 && (value & kCalibrate) != 0) {
        calibrated.at(converter) = true;
      }
      if (address == begin + kStatus1 && (value & kNoChannel) != kNoChannel) {
        EXPECT_TRUE(calibrated.at(converter));
        converted.at(converter) = true;
      }
    }
  });
  drivers.run(milliseconds(10));
  EXPECT_TRUE(converted[0] && converted[1]);
}

/// @brief When the calibrations fail, the firmware still starts, and no input ever has a value.
/// @verifies FR-143
TEST(K64AdcOnBoard, FR143_AfterAFailedCalibrationThereAreNoValues) {
  DriverBoard drivers({.elf = {}, .calibrates = {false, false}});
  drivers.startUp();
  apply(drivers, 0, 1.0);
  drivers.run(milliseconds(500));
  const std::vector<std::uint16_t> samples = drivers.ask('A');
  ASSERT_EQ(samples.size(), 2 * kInputs.size());
  for (std::size_t input = 0; input < kInputs.size(); ++input) {
    EXPECT_EQ(samples[2 * input], 0) << input;
  }
  drivers.ask('P', 0, 5000);
  EXPECT_NEAR(drivers.board.pwmDuty(0, 0), 0.5, 1e-9) << "the other devices work";
}

constexpr std::uint16_t kAllCurrents = 0b010'010'010'010;  // bits of scenario::PcReport::measured
constexpr std::uint16_t kSteeringPosition = 1U << 12U;

/// @brief The reports of a robot at rest have the currents of all wheels and the angle of the
/// steering.
/// @verifies FR-142
TEST(K64AdcInTheRobot, FR142_ReportsHaveTheCurrentsAndTheAngle) {
  BoardRobot robot;
  robot.startUp();
  robot.connect();
  EXPECT_EQ(robot.report().measured & kAllCurrents, kAllCurrents);
  EXPECT_NE(robot.report().measured & kSteeringPosition, 0);
  for (const std::int16_t current : robot.report().current) {
    EXPECT_NEAR(current, 0, 100);
  }
}

/// @brief The report has no angle when the wire of the angle sensor is broken and the input has a
/// resistor to ground.
/// @verifies FR-205
TEST(K64AdcInTheRobot, FR205_OpenInputOfTheAngleIsMissing) {
  constexpr Input kAngle = kInputs[4];
  BoardRobot robot;
  robot.startUp();
  robot.connect();
  ASSERT_NE(robot.report().measured & kSteeringPosition, 0);
  robot.board.onWrite([&](std::uint32_t address, unsigned /*size*/, std::uint32_t value) {
    if (address == kConverterBegin + kDistance && (value & kNoChannel) == kAngle.channel) {
      robot.board.setAnalog(kAngle.converter, kAngle.channel, 0.0);
    }
  });
  robot.silentCycles(3);
  EXPECT_EQ(robot.report().measured & kSteeringPosition, 0);
}

/// @brief The robot also runs after its calibrations have failed. Its reports then show that the
/// currents and the angle are missing.
/// @verifies FR-143
TEST(K64AdcInTheRobot, FR143_AfterAFailedCalibrationTheCurrentsAreMissing) {
  BoardRobot robot(emulator::Options{.calibrates = {false, false}});
  robot.startUp();
  robot.connect();
  robot.cycles(3);
  EXPECT_EQ(robot.report().measured & (kAllCurrents | kSteeringPosition), 0);
  EXPECT_EQ(robot.report().overruns, 0);
}

}  // namespace
}  // namespace wr::test
