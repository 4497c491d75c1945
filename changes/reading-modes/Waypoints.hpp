#pragma once

#include "main_control/MainController.hpp"
#include "main_control/operation_modes/ModeDecorator.hpp"
#include "reading-modes/WaypointReader.hpp"

namespace wr {

/// @brief The mode in which way-points of the field command the robot.
class Waypoints final : public ModeDecorator {
 public:
  /// @brief Number of the mode in reports.
  static constexpr ModeId kId{3};

  /// @brief Binds the mode to its parts.
  /// @param wrapped mode that reads with the reader
  /// @param successor of this mode; only its address is used before the first cycle
  /// @param reader reader of the way-points
  Waypoints(Mode& wrapped, Mode& other, WaypointReader& reader)
      : ModeDecorator(kId, wrapped), other_(other), reader_(reader) {}

  /// @brief Serves the receiver, then the wrapped mode.
  /// @isr{no}
  void serve() override {
    reader_.serve();
    ModeDecorator::serve();
  }

  /// @brief Saves the number of the mode, and reads an order.
  /// @param mCtrl main controller
  /// @isr{no}
  void read(MainController& mCtrl) override {
    mCtrl.getData().saveModeId(kId);
    ModeDecorator::read(mCtrl);
  }

  /// @brief Changes to the other mode.
  /// @param mCtrl main controller
  /// @isr{no}
  void changeMode(MainController& mCtrl) override { mCtrl.changeMode(other_); }

 private:
  Mode& other_;
  WaypointReader& reader_;
};

}  // namespace wr
