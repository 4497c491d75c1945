#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <cstdint>
#include <vector>

#include "support/LineBytes.hpp"

namespace wr::fuzz {

inline constexpr std::uint8_t kHello = 0x01;
inline constexpr std::uint8_t kConfirm = 0x02;
inline constexpr std::uint8_t kKeepAlive = 0x03;
inline constexpr std::uint8_t kOrder = 0x04;
inline constexpr std::uint8_t kWelcome = 0x81;
inline constexpr std::uint8_t kReport = 0x82;

/// @brief A PC that sends valid frames, damaged frames and other bytes. The fuzzer's input selects
/// the frames and the bytes.
class PcLine {
 public:
  /// @brief Returns the next bytes of the PC.
  /// @param input selects the bytes
  /// @return bytes on the serial line
  test::Bytes next(FuzzedDataProvider& input) {
    switch (input.ConsumeIntegralInRange(0, 6)) {
      case 0:
        return input.ConsumeBytes<std::uint8_t>(input.ConsumeIntegralInRange<std::size_t>(0, 260));
      case 1:
        return good(kHello);
      case 2:
        return good(kConfirm, {session});
      case 3:
        return good(kKeepAlive);
      case 4: {
        const test::Bytes payload =
            input.ConsumeBytes<std::uint8_t>(input.ConsumeIntegralInRange<std::size_t>(0, 210));
        const auto type = input.ConsumeIntegralInRange<std::uint8_t>(0, 6);
        const auto version = input.ConsumeIntegralInRange<std::uint8_t>(1, 3);
        return test::lineBytes(type, input.ConsumeIntegral<std::uint8_t>(), payload, version);
      }
      case 5: {
        test::Bytes line = order(input);
        line[input.ConsumeIntegralInRange<std::size_t>(0, line.size() - 1)] ^=
            input.ConsumeIntegral<std::uint8_t>();
        return line;
      }
      default:
        return order(input);
    }
  }

  /// @brief Returns a valid frame with the next sequence number.
  /// @param type type of the frame
  /// @param payload payload of the frame
  /// @return bytes on the serial line
  test::Bytes good(std::uint8_t type, const test::Bytes& payload = {}) {
    return test::lineBytes(type, sequence_++, payload);
  }

  /// @brief Returns an order that sets the same velocity for all wheels.
  /// @param velocity velocity [0.1 rpm]
  /// @param commands bit 0: stop, bit 1: acknowledge
  /// @return bytes on the serial line
  test::Bytes drive(std::int16_t velocity, std::uint8_t commands = 0) {
    return good(kOrder, payload(0, {velocity, velocity, velocity, velocity}, {}, commands));
  }

  std::uint8_t session = 0;  ///< session of the newest Welcome

 private:
  test::Bytes order(FuzzedDataProvider& input) {
    // About half of the orders are neutral, because the robot drives only after neutral orders.
    const bool neutral = input.ConsumeBool();
    const auto value = [&input, neutral]() -> std::int16_t {
      return neutral ? std::int16_t{0} : input.ConsumeIntegralInRange<std::int16_t>(-3010, 3010);
    };
    const auto steering = input.ConsumeIntegralInRange<std::int16_t>(-3210, 3210);
    const std::array<std::int16_t, 4> wheels{value(), value(), value(), value()};
    const auto quantity = input.ConsumeIntegralInRange<std::uint8_t>(0, 3);
    const auto commands = input.ConsumeIntegralInRange<std::uint8_t>(0, 7);
    return good(kOrder, payload(steering, wheels, quantity, commands > 4 ? 0 : commands));
  }

  static void append(test::Bytes& bytes, std::int16_t value) {
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(value >> 8));
  }

  static test::Bytes payload(std::int16_t steering, const std::array<std::int16_t, 4>& wheels,
                             std::uint8_t quantity, std::uint8_t commands) {
    test::Bytes bytes{1, 0, 0, 0, 0, 0};
    append(bytes, steering);
    for (const std::int16_t wheel : wheels) {
      bytes.push_back(quantity);
      append(bytes, wheel);
    }
    bytes.push_back(commands);
    return bytes;
  }

  std::uint8_t sequence_ = 0;
};

}  // namespace wr::fuzz
