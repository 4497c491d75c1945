#pragma once

#include "main_control/MainController.hpp"
#include "main_control/operation_modes/ModeDecorator.hpp"
#include "reading-modes/WaypointReader.hpp"

namespace wr {

/// @brief The reading mode in which the orders are computed from way-points of the field.
class Waypoints final : public ModeDecorator {
 public:
  /// @brief Number of this mode in reports.
  static constexpr ModeId kId{3};

  /// @param wrapped the wrapped mode, which reads the orders of the reader
  /// @param other mode that changeMode() selects; it need not be constructed before the first cycle
  /// @param reader reader that computes orders from the way-points
  Waypoints(Mode& wrapped, Mode& other, WaypointReader& reader)
      : ModeDecorator(kId, wrapped), other_(other), reader_(reader) {}

  /// @brief Reads the bytes of the receiver, then calls serve() of the wrapped mode.
  /// @isr{no}
  void serve() override {
    reader_.serve();
    ModeDecorator::serve();
  }

  /// @brief Records this mode as the source of the set-points, then reads an order.
  /// @param mCtrl main controller
  /// @isr{no}
  void read(MainController& mCtrl) override {
    mCtrl.getData().saveModeId(kId);
    ModeDecorator::read(mCtrl);
  }

  /// @brief Selects the other mode.
  /// @param mCtrl main controller
  /// @isr{no}
  void changeMode(MainController& mCtrl) override { mCtrl.changeMode(other_); }

 private:
  Mode& other_;
  WaypointReader& reader_;
};

}  // namespace wr
