#pragma once

#include "communication/serialization/Serializable.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief One order: the set-points of the robot, and the commands to stop and to acknowledge.
/// @function Stores a complete order, and checks whether all its fields are in range.
/// @secret The fields of an order, and the range of each field.
/// @role{serializer, Concrete Element}
class OrderMessage final : public Serializable {
 public:
  /// @brief Bit that orders a stop. It is in the field Commands, which is the last field of an
  /// order.
  static constexpr std::uint8_t kStop = 1;

  /// @brief Constructs an order that contains no stop, and whose set-points are all 0.
  OrderMessage() = default;

  /// @param setPoints set-points of the order
  /// @param stop true if the order contains a stop
  OrderMessage(const SetPoints& setPoints, bool stop);

  /// @brief Returns the set-points of the order.
  /// @return the set-points
  /// @satisfies FR-170
  /// @isr{yes}
  [[nodiscard]] const SetPoints& setPoints() const { return setPoints_; }

  /// @brief Checks whether the order contains a stop. A stop is valid even if other fields of the
  /// order are out of range.
  /// @return true when the order contains a stop
  /// @satisfies FR-21
  /// @satisfies FR-240
  /// @isr{yes}
  [[nodiscard]] bool stop() const { return (commands_ & kStop) != 0; }

  /// @brief Checks whether the set-point of each wheel is 0. The quantity of the set-point does not
  /// matter.
  /// @return true when no wheel shall move
  /// @satisfies FR-241
  /// @isr{yes}
  [[nodiscard]] bool neutral() const;

  /// @brief Checks whether each field is in its range. The fields are checked even if the order
  /// contains a stop.
  /// @return true when all fields are in range
  /// @satisfies FR-46
  /// @satisfies FR-178
  /// @isr{yes}
  [[nodiscard]] bool inRange() const;

  /// @satisfies FR-170
  [[nodiscard]] bool readFrom(Reader& reader) override;

 private:
  static constexpr std::uint8_t kAcknowledge = 2;  // bit of the field Commands that is 1 if
                                                   // the order acknowledges the latched faults

  SetPoints setPoints_{};
  std::uint8_t commands_ = 0;
};

}  // namespace wr
