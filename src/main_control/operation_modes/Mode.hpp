#pragma once

#include <cstdint>

namespace wr {

class MainController;

/// @brief The reading modes. Their values are the numbers of the modes in reports.
/// @datatype
enum class ModeId : std::uint8_t {
  RC = 0,     ///< the remote control
  PC = 1,     ///< the PC on the robot
  None = 255  ///< no source
};

/// @brief A reading mode: the source from which orders are read.
///
/// @function Provides one interface to check for a message, to read the message and to change to
/// the other source. Each mode also returns whether a stop of its source is in force, even while
/// orders are read from another source.
///
/// @secret The source of orders that belongs to a reading mode.
///
/// @role{reading-modes, State}
/// @role{mode-extensions, Component}
///
/// @patternapp{reading-modes, State, Reading modes}
/// @why The system reads orders from the PC or from the remote control, and each source needs its
/// own steps. Each mode is an object with these steps. Therefore no other module has to check which
/// mode is set.
/// @changes A mode may read orders in a different way. A new source of orders, such as a Bluetooth
/// device, needs a new subclass of this class. No other module of Main Control changes.
class Mode {
 public:
  Mode(const Mode&) = delete;
  Mode& operator=(const Mode&) = delete;

  /// @brief Processes the input of the source. In each cycle, the main controller calls this
  /// function once for every mode.
  /// @isr{no}
  virtual void serve() = 0;

  /// @brief Returns whether an order can be read now.
  /// @return true if the source has a complete order that is not too old and was not read before.
  /// @isr{no}
  [[nodiscard]] virtual bool newMessage() const = 0;

  /// @brief Reads the order into the data of the controller.
  /// @param mCtrl controller whose data receive the set-points and the source
  /// @pre newMessage() was true in this cycle.
  /// @post The order cannot be read again.
  /// @isr{no}
  virtual void read(MainController& mCtrl) = 0;

  /// @brief Sets the reading mode of the controller to the successor of this mode.
  /// @param mCtrl controller whose mode changes
  /// @isr{no}
  virtual void changeMode(MainController& mCtrl) = 0;

  /// @brief Returns whether the source ordered a stop and has not released it.
  /// @return true from the stop order of the source until this source releases the stop.
  /// @isr{no}
  [[nodiscard]] virtual bool stopOrdered() const = 0;

  /// @brief Returns the number of this mode.
  /// @return number of the mode, as in reports.
  /// @isr{yes}
  [[nodiscard]] ModeId id() const;

 protected:
  /// @param id number of the mode, as in reports
  explicit Mode(ModeId id);
  ~Mode() = default;

 private:
  ModeId id_;
};

}  // namespace wr
