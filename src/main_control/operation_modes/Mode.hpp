#pragma once

#include <cstdint>

namespace wr {

class MainController;

/// @brief The reading modes, as they are numbered in reports.
/// @datatype
enum class ModeId : std::uint8_t {
  RC = 0,     ///< the remote control
  PC = 1,     ///< the PC on the robot
  None = 255  ///< no source
};

/// @brief A reading mode: the source from which orders are read.
///
/// @function Provides one interface to check for a message, to read it and to change to the other
/// source. Also returns, in every mode, whether its source ordered a stop.
///
/// @secret Which source belongs to a reading mode.
///
/// @role{reading-modes, State}
/// @role{mode-extensions, Component}
///
/// @patternapp{reading-modes, State, Reading modes}
/// @why The steps that read an order depend on the source: the system reads orders from the PC or
/// from the remote control. Each mode is a state, so no other module has to compare modes.
/// @changes The way a mode reads may change. A new source of orders, such as a Bluetooth device, is
/// a new subclass of this class and changes no other module of Main Control.
class Mode {
 public:
  Mode(const Mode&) = delete;
  Mode& operator=(const Mode&) = delete;

  /// @brief Processes the input of the source. It is called once in each cycle, in every mode.
  /// @isr{no}
  virtual void serve() = 0;

  /// @brief Returns whether an order can be read now.
  /// @return true if the source has a fresh and complete order that was not read before.
  /// @isr{no}
  [[nodiscard]] virtual bool newMessage() const = 0;

  /// @brief Reads the order into the data of the controller.
  /// @param mCtrl controller whose data receive the set-points and the source
  /// @pre newMessage() was true in this cycle.
  /// @post The order cannot be read again.
  /// @isr{no}
  virtual void read(MainController& mCtrl) = 0;

  /// @brief Lets the controller read from the successor of this mode.
  /// @param mCtrl controller whose mode changes
  /// @isr{no}
  virtual void changeMode(MainController& mCtrl) = 0;

  /// @brief Returns whether the source ordered a stop and has not released it.
  /// @return true from a stop order until the same source sends an order without stop.
  /// @isr{no}
  [[nodiscard]] virtual bool stopOrdered() const = 0;

  /// @brief Returns the number of this mode.
  /// @return number of the mode, as in reports.
  /// @isr{yes}
  [[nodiscard]] ModeId id() const;

 protected:
  /// @brief Constructs a mode with a number.
  /// @param id number of the mode, as in reports
  explicit Mode(ModeId id);
  ~Mode() = default;

 private:
  ModeId id_;
};

}  // namespace wr
