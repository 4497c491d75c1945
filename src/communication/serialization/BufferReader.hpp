#pragma once

#include <cstdint>
#include <optional>

#include "communication/serialization/Reader.hpp"
#include "devices/Timebase.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The newest order of the remote control.
/// @function Builds one order from the velocity signal and the direction signal of the remote control.
/// The remote control cannot order a stop.
/// @secret How the two signals of the remote control are combined in a complete order.
/// @role{serializer, Concrete Reader}
class BufferReader final : public Reader {
 public:
  /// @brief Connects the reader to the signals.
  /// @param velocity velocity signal; a greater value counts as the limit
  /// @param direction direction signal; a greater value counts as the limit
  /// @param clock returns the present time, for the age of the signals
  BufferReader(Pipe<Velocity>& velocity, Pipe<Angle>& direction, const Timebase& clock);

  /// @brief Returns whether both signals have a fresh value that was not read before.
  /// @return true when there is a complete order
  /// @isr{no}
  /// @satisfies FR-20
  /// @satisfies FR-50
  /// @satisfies FR-56
  [[nodiscard]] bool available() const override;

  /// @brief Returns whether the remote control orders a stop.
  /// @return false
  /// @isr{no}
  [[nodiscard]] bool stopOrdered() const override;

  /// @brief Reads the quantity of the wheels, which is always velocity, or the stop flag, which is
  /// always false.
  /// @param field name of the field
  /// @return value of the field
  /// @isr{no}
  /// @satisfies FR-51
  std::uint8_t readU8(Field field) override;

  /// @brief Reads the number of the order, which is 0.
  /// @param field name of the field
  /// @return value of the field
  /// @isr{no}
  std::uint16_t readU16(Field field) override;

  /// @brief Reads the steering angle, or the velocity, which is the same for all wheels.
  /// @param field name of the field
  /// @return value of the field; 0 when the order has no such field
  /// @isr{no}
  /// @satisfies FR-51
  std::int16_t readI16(Field field) override;

  /// @brief Reads the time of the sender's clock. It is 0, because the remote control has no clock.
  /// @param field name of the field
  /// @return value of the field
  /// @isr{no}
  std::uint32_t readU32(Field field) override;

  std::int32_t readI32(Field field) override;

  /// @brief Ends the read of the order. The values of both signals cannot be read again.
  /// @return false when a signal had no value, or when a field was read that the order does not have
  /// @isr{no}
  /// @satisfies FR-50
  bool finish() override;

 private:
  /// @brief Reads one value of each signal at the first field of an order. All fields of the order
  /// come from these values, even when a signal changes during the read.
  /// @satisfies FR-51
  void take();

  Pipe<Velocity>& velocitySignal_;
  Pipe<Angle>& directionSignal_;
  const Timebase& clock_;
  std::optional<Stamped<Velocity>> velocity_;  // values of the order that is being read
  std::optional<Stamped<Angle>> direction_;
  std::optional<Instant> velocityRead_;  // times of the values of the order that was read last
  std::optional<Instant> directionRead_;
  bool reading_ = false;
  bool failed_ = false;
};

}  // namespace wr
