#pragma once

#include <cstdint>
#include <optional>

#include "communication/serialization/Reader.hpp"
#include "devices/Timebase.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Reader of the newest order of the remote control.
/// @function Builds each order from two signals of the remote control: velocity and direction.
/// These two signals cannot order a stop.
/// @secret The rules by which the two signals of the remote control form a complete order.
/// @role{serializer, Concrete Reader}
class BufferReader final : public Reader {
 public:
  /// @param velocity velocity signal; a value beyond the velocity limit is read as the limit
  /// @param direction direction signal; a value beyond the steering limit is read as the limit
  /// @param clock returns the present time, from which the age of the signals is computed
  BufferReader(Pipe<Velocity>& velocity, Pipe<Angle>& direction, const Timebase& clock);

  /// @brief Returns whether an order can be read: each of the two signals has a value that was not
  /// read before and is not older than the lifetime of an order.
  /// @return true when an order can be read
  /// @isr{no}
  /// @satisfies FR-20
  /// @satisfies FR-50
  /// @satisfies FR-56
  [[nodiscard]] bool available() const override;

  /// @brief Returns false, because the two signals cannot order a stop.
  /// @return false
  /// @isr{no}
  [[nodiscard]] bool stopOrdered() const override;

  /// @brief Reads one of two fields: the commands, or the quantity of a wheel set-point. The
  /// quantity is always velocity. The commands are always 0: neither stop nor acknowledge.
  /// @param field name of the field
  /// @return value of the field
  /// @isr{no}
  /// @satisfies FR-51
  std::uint8_t readU8(Field field) override;

  /// @brief Reads the number of the order, which is always 0.
  /// @param field name of the field
  /// @return value of the field
  /// @isr{no}
  std::uint16_t readU16(Field field) override;

  /// @brief Reads one of two fields: the steering angle, or the velocity of a wheel. The velocity
  /// is the same for all wheels.
  /// @param field name of the field
  /// @return value of the field; 0 when the order does not have this field
  /// @isr{no}
  /// @satisfies FR-51
  std::int16_t readI16(Field field) override;

  /// @brief Reads the time of the sender's clock, which is always 0, because the remote control has
  /// no clock.
  /// @param field name of the field
  /// @return value of the field
  /// @isr{no}
  std::uint32_t readU32(Field field) override;

  /// @brief Ends the reading of the order. The two signal values of this order cannot be read
  /// again.
  /// @return false when a signal had no value, or when the caller read a field that the order does
  /// not have
  /// @isr{no}
  /// @satisfies FR-50
  bool finish() override;

 private:
  /// @brief Stores the value of each signal when the first field of an order is read. All fields of
  /// this order use the stored values, even if a signal changes before the last field is read.
  /// @satisfies FR-51
  void take();

  Pipe<Velocity>& velocitySignal_;
  Pipe<Angle>& directionSignal_;
  const Timebase& clock_;
  std::optional<Stamped<Velocity>> velocity_;  // signal values of the order that is being read
  std::optional<Stamped<Angle>> direction_;
  std::optional<Instant> velocityRead_;  // times of the signal values in the last order
  std::optional<Instant> directionRead_;
  bool reading_ = false;
  bool failed_ = false;
};

}  // namespace wr
