#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include "communication/serialization/Reader.hpp"
#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"
#include "services/SystemConstants.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief A point on the field, measured from a corner of the field.
struct FieldPoint {
  std::int16_t x = 0;  ///< along the rows [cm]
  std::int16_t y = 0;  ///< to the left, at right angles to the rows [cm]
};

/// @brief A reader that computes orders from way-points and from the positions of a GPS receiver.
/// The orders lead the robot along the rows from way-point to way-point.
///
/// The receiver sends each position in 6 bytes: the number 165, two bytes of x, two bytes of y, and
/// the exclusive OR of these 5 bytes.
class WaypointReader final : public Reader {
 public:
  /// @brief A way-point counts as reached if the remaining distance along the row is at most this
  /// value [cm].
  static constexpr std::int32_t kReached = 20;

  /// @brief Velocity that each order sets.
  static constexpr Velocity kVelocity{500};

  /// @param port serial port of the receiver
  /// @param timebase returns the present time
  /// @param way way-points in their sequence along the rows; they must exist as long as the reader
  WaypointReader(SerialPort& port, const Timebase& timebase, std::span<const FieldPoint> way)
      : port_(port), timebase_(timebase), way_(way) {}

  /// @brief Reads the bytes that the receiver has sent.
  /// @isr{no}
  void serve() {
    std::size_t left = kMostBytes;
    std::uint8_t byte = 0;
    // bound: kMostBytes
    while (left != 0 && port_.read({&byte, 1}) == 1) {
      --left;
      take(byte);
    }
  }

  /// @brief Returns whether an order can be read. Three conditions must be true: no order was read
  /// from the last position, this position is not older than the lifetime of an order, and a
  /// way-point is ahead of the robot.
  /// @return true when an order can be read
  /// @isr{no}
  [[nodiscard]] bool available() const override {
    return at_ && next_ < way_.size() &&
           timebase_.now() - *at_ <= SystemConstants::instance().orderLifetime();
  }

  /// @brief Returns false, because the receiver cannot order a stop.
  /// @return false
  /// @isr{no}
  [[nodiscard]] bool stopOrdered() const override { return false; }

  /// @brief Reads a field of 8 bits. The quantity of a set-point is always velocity. Every other
  /// field is 0.
  /// @isr{no}
  std::uint8_t readU8(Field field) override {
    return field.name == FieldName::WheelQuantity
               ? static_cast<std::uint8_t>(WheelQuantity::Velocity)
               : std::uint8_t{0};
  }

  /// @brief Reads the number of the order: the index of the next way-point.
  /// @return index of the next way-point, from 0
  /// @isr{no}
  std::uint16_t readU16(Field /*field*/) override { return static_cast<std::uint16_t>(next_); }

  /// @brief Reads a field of 16 bits with sign: the velocity of a wheel, or the steering angle
  /// towards the next way-point.
  /// @isr{no}
  std::int16_t readI16(Field field) override {
    return field.name == FieldName::WheelValue ? static_cast<std::int16_t>(kVelocity.count())
                                               : towards(way_[next_]);
  }

  /// @brief Returns 0 as the time of the order, because the receiver sends no time.
  /// @return 0
  /// @isr{no}
  std::uint32_t readU32(Field /*field*/) override { return 0; }

  /// @brief Ends the order. The next order is available only when a new position was received.
  /// @return true
  /// @isr{no}
  bool finish() override {
    at_.reset();
    return true;
  }

 private:
  static constexpr std::size_t kMostBytes = 64;  // greatest number of bytes that serve() reads
  static constexpr std::uint8_t kBegin = 165;
  static constexpr std::size_t kLength = 6;
  static constexpr std::int32_t kRadian = 5730;  // one radian [0.01 degree]
  static constexpr std::int32_t kMostAngle = 2500;

  void take(std::uint8_t byte) {
    if (count_ == 0 && byte != kBegin) {
      return;
    }
    bytes_[count_] = byte;
    ++count_;
    if (count_ == kLength) {
      count_ = 0;
      finishPosition();
    }
  }

  void finishPosition() {
    std::uint8_t sum = 0;
    // bound: kLength
    for (const std::uint8_t byte : bytes_) {
      sum ^= byte;
    }
    if (sum != 0) {
      return;
    }
    position_ = {.x = number(1), .y = number(3)};
    at_ = timebase_.now();
    while (next_ < way_.size() && way_[next_].x - position_.x <= kReached) {  // bound: way-points
      ++next_;
    }
  }

  [[nodiscard]] std::int16_t number(std::size_t place) const {
    return static_cast<std::int16_t>(bytes_[place] | bytes_[place + 1] << 8U);
  }

  [[nodiscard]] std::int16_t towards(const FieldPoint& point) const {
    const std::int32_t angle = kRadian * (point.y - position_.y) / (point.x - position_.x);
    return static_cast<std::int16_t>(angle > kMostAngle    ? kMostAngle
                                     : angle < -kMostAngle ? -kMostAngle
                                                           : angle);
  }

  SerialPort& port_;
  const Timebase& timebase_;
  std::span<const FieldPoint> way_;
  std::size_t next_ = 0;  // index of the next way-point
  FieldPoint position_{};
  std::optional<Instant> at_;  // time of a position from which no order was read yet
  std::uint8_t bytes_[kLength]{};
  std::size_t count_ = 0;
};

}  // namespace wr
