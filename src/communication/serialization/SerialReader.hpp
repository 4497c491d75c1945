#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "communication/serialization/Reader.hpp"
#include "devices/Timebase.hpp"

namespace wr {

/// @brief The newest order of the PC.
/// @function Keeps the newest order that came over the serial line until it is read, replaced,
/// dropped or too old. Remembers whether the PC has stopped the robot.
/// @secret That the newest order is kept as raw bytes and decoded when it is read.
/// @role{serializer, Concrete Reader}
class SerialReader final : public Reader {
 public:
  /// @brief Length of the payload of an order [bytes].
  static constexpr std::size_t kOrderLength = 17;

  /// @brief Makes a reader without an order and without stop.
  /// @param clock tells the age of orders
  explicit SerialReader(const Timebase& clock);

  /// @brief Takes an order in place of the one before. An order with a field out of range is
  /// refused, and changes nothing.
  /// @param payload the bytes of the order
  /// @return false when a field is out of its range
  /// @isr{no}
  /// @satisfies FR-20
  /// @satisfies FR-21
  /// @satisfies FR-46
  /// @satisfies FR-48
  bool offer(std::span<const std::uint8_t, kOrderLength> payload);

  /// @brief Drops the order that is kept. A stop stays.
  /// @isr{no}
  /// @satisfies FR-33
  /// @satisfies FR-34
  void discard();

  /// @brief Tells whether there is an order of the PC that was not read and is not too old.
  /// @return true when there is such an order
  /// @isr{no}
  /// @satisfies FR-20
  [[nodiscard]] bool available() const override;

  /// @brief Tells whether the newest order that the PC ever gave is a stop.
  /// @return true until the PC orders without stop
  /// @isr{no}
  /// @satisfies FR-21
  [[nodiscard]] bool stopOrdered() const override;

  std::uint8_t readU8(Field field) override;
  std::uint16_t readU16(Field field) override;
  std::int16_t readI16(Field field) override;
  std::uint32_t readU32(Field field) override;
  std::int32_t readI32(Field field) override;

  /// @brief Ends the read of the order. The order is consumed.
  /// @return false when more was read than the order holds
  /// @isr{no}
  /// @satisfies FR-20
  bool finish() override;

 private:
  /// @brief An order, when it came, and whether it was read.
  struct Kept {
    std::array<std::uint8_t, kOrderLength> bytes{};
    Instant at{};
    bool unread = false;
  };

  /// @brief Takes the next number out of the bytes of the order.
  /// @return the number; 0 when the order has no more bytes
  template <class Value>
  Value next();

  const Timebase& clock_;
  Kept kept_{};
  std::size_t position_ = 0;
  bool stop_ = false;
};

}  // namespace wr
