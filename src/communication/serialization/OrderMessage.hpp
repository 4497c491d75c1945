#pragma once

#include "communication/serialization/Serializable.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief One order: the set-points of the robot, and whether it has to stop.
/// @function Stores a complete order, and checks whether the robot can execute it.
/// @secret The fields of an order, and the range of each.
/// @role{serializer, Concrete Element}
class OrderMessage final : public Serializable {
 public:
  /// @brief Bit of the last field, the commands, that orders stop.
  static constexpr std::uint8_t kStop = 1;

  /// @brief Constructs an order with all set-points zero, without stop.
  OrderMessage() = default;

  /// @brief Constructs an order.
  /// @param setPoints set-points of the order
  /// @param stop whether the robot has to stop
  OrderMessage(const SetPoints& setPoints, bool stop);

  /// @brief Returns the set-points of the order.
  /// @return the set-points
  /// @satisfies FR-170
  /// @isr{yes}
  [[nodiscard]] const SetPoints& setPoints() const { return setPoints_; }

  /// @brief Checks whether the order stops the robot. A stop is valid with any values of the other
  /// fields.
  /// @return true for a stop
  /// @satisfies FR-21
  /// @satisfies FR-240
  /// @isr{yes}
  [[nodiscard]] bool stop() const { return (commands_ & kStop) != 0; }

  /// @brief Checks whether the value of each wheel is 0, for any quantity.
  /// @return true when no wheel shall move
  /// @satisfies FR-241
  /// @isr{yes}
  [[nodiscard]] bool neutral() const;

  /// @brief Checks whether each field is in its range, also in an order that stops.
  /// @return true when the order can be carried out
  /// @satisfies FR-46
  /// @satisfies FR-178
  /// @isr{yes}
  [[nodiscard]] bool inRange() const;

  /// @satisfies FR-170
  [[nodiscard]] bool readFrom(Reader& reader) override;
  [[nodiscard]] bool writeTo(Writer& writer) const override;

 private:
  static constexpr std::uint8_t kAcknowledge = 2;  // bit of the field for commands

  SetPoints setPoints_{};
  std::uint8_t commands_ = 0;
};

}  // namespace wr
