#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "communication/serialization/Reader.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Reader of the newest order of the PC.
/// @function Stores the newest order of the PC until the order is read, replaced, dropped or too
/// old. Latches a stop until a later order releases the stop. The stop lasts at least until the
/// present cycle ends.
/// @secret The storage of the newest order: raw bytes, which are decoded when the order is read.
/// @role{serializer, Concrete Reader}
class SerialReader final : public Reader {
 public:
  /// @brief Length of the payload of an order [bytes].
  static constexpr std::size_t kOrderLength = 21;

  /// @brief Constructs a reader without an order and without a latched stop.
  SerialReader() = default;

  /// @brief Begins the next cycle. Sets the time up to which the age of an order is measured. If
  /// the stop was released in the previous cycle, it ends now.
  /// @param clockPulse clock pulse of the present cycle
  /// @isr{no}
  /// @satisfies FR-20
  void beginCycle(Instant clockPulse);

  /// @brief Latches the stop if an order contains a stop, even if other fields of the order are out
  /// of range.
  /// @param payload the bytes of the order
  /// @isr{no}
  /// @satisfies FR-240
  void heedStop(std::span<const std::uint8_t, kOrderLength> payload);

  /// @brief Latches the stop in the same way as an order that contains a stop.
  /// @isr{no}
  /// @satisfies FR-21
  void latchStop();

  /// @brief Stores an order in place of the previous order. An order with a field out of range is
  /// rejected and changes nothing. The stop is released if the order is accepted, contains no stop,
  /// and has only wheel values of 0.
  /// @param payload the bytes of the order
  /// @param receivedAt time at which the last byte of its frame was received
  /// @return false when a field is out of its range
  /// @isr{no}
  /// @satisfies FR-20
  /// @satisfies FR-21
  /// @satisfies FR-46
  /// @satisfies FR-48
  /// @satisfies FR-241
  bool offer(std::span<const std::uint8_t, kOrderLength> payload, Instant receivedAt);

  /// @brief Drops the stored order. A latched stop stays latched.
  /// @isr{no}
  /// @satisfies FR-33
  /// @satisfies FR-34
  void discard();

  /// @brief Returns whether an order can be read: the stored order was not read before, and it is
  /// not too old at the clock pulse of the present cycle.
  /// @return true when an order can be read
  /// @isr{no}
  /// @satisfies FR-20
  [[nodiscard]] bool available() const override;

  /// @brief Checks whether a stop of the PC is in force.
  /// @return true from the stop order until an order of the PC releases the stop, and at least
  /// until the end of the cycle that received the stop order
  /// @isr{no}
  /// @satisfies FR-21
  /// @satisfies FR-240
  [[nodiscard]] bool stopOrdered() const override;

  std::uint8_t readU8(Field field) override;
  std::uint16_t readU16(Field field) override;
  std::int16_t readI16(Field field) override;
  std::uint32_t readU32(Field field) override;

  /// @brief Ends the reading of the order. The order cannot be read again.
  /// @return false when the caller read more bytes than the order contains
  /// @isr{no}
  /// @satisfies FR-20
  bool finish() override;

 private:
  /// @brief The bytes of an order, the time at which its last byte was received, and a flag that is
  /// true while the order is unread.
  struct Kept {
    std::array<std::uint8_t, kOrderLength> bytes{};
    Instant at{};
    bool unread = false;
  };

  /// @brief Reads the next number from the bytes of the order.
  /// @return the number; 0 when the order has too few bytes left for this number
  template <class Value>
  Value next();

  Instant clockPulse_{};
  Kept kept_{};
  std::size_t position_ = 0;
  bool stop_ = false;
  bool stopReceived_ = false;  // the present cycle received a stop
};

}  // namespace wr
