#pragma once

#include <cstdint>
#include <optional>

#include "devices/Timebase.hpp"
#include "main_control/operation_modes/ModeDecorator.hpp"
#include "safety/RcVigilance.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief A mode that adds the enable switch to the remote control: the switch stops the robot, or
/// selects the source of orders.
///
/// @function Reads the enable switch in every cycle. Latches a stop when the switch is in the
/// position "stop", or when its pulses are missing or out of their range (FR-285). Releases the
/// stop when the switch is in another position and the velocity stick is not deflected. If two
/// successive pulses order a stop, the stop is latched, even if the switch is in another position
/// at the next cycle. In the position "PC" the orders of the remote control are not read. After an
/// operator has moved the switch from "stop" through "PC" to "drive", latched faults are
/// acknowledged by the next three orders that contain no stop. If an order is read more than 1 s
/// after this movement, it acknowledges nothing. Also latches a stop when two conditions are met
/// for more than 2 s: the remote control moves the robot, and neither the sticks nor the switch
/// change their pulses.
///
/// @secret The orders that each position of the enable switch permits, and the moment when a stop
/// by this switch ends.
///
/// @role{mode-extensions, Concrete Decorator}
class EnableSwitch final : public ModeDecorator {
 public:
  /// @brief Signals of the remote control. Each signal must exist as long as this mode.
  /// @datatype
  struct Signals {
    Pipe<Velocity>& velocity;    ///< position of the velocity stick
    Pipe<Angle>& direction;      ///< position of the direction stick
    Pipe<Microseconds>& enable;  ///< width of the pulses of the enable switch
    Pipe<Microseconds>& stop;    ///< width of a pulse that orders a stop, if the previous pulse
                                 ///< also ordered a stop
    const Timebase& timebase;    ///< returns the present time
  };

  /// @brief Shortest width of a pulse that orders no stop.
  static constexpr Microseconds kMinNoStopPulse{1250};

  /// @brief Shortest valid pulse of the switch. A pulse out of the valid range orders a stop, but
  /// shows no position of the switch.
  static constexpr Microseconds kShortestPulse{900};

  /// @brief Latches a stop at the start of the firmware.
  /// @param wrapped the mode that this mode wraps
  /// @param signals signals of the remote control
  EnableSwitch(Mode& wrapped, const Signals& signals);

  /// @brief Reads the switch and the sticks, and latches or releases a stop. Then calls serve() of
  /// the wrapped mode.
  /// @satisfies FR-285
  /// @satisfies FR-286
  /// @satisfies FR-289
  /// @isr{no}
  void serve() override;

  /// @brief Checks whether the remote control has an order that can be read now.
  /// @return true if there is a new order and the switch is not in the position "PC".
  /// @satisfies FR-287
  /// @isr{no}
  [[nodiscard]] bool newMessage() const override;

  /// @brief Reads the order of the remote control. After the switch has moved through the positions
  /// "stop", "PC" and "drive", latched faults are acknowledged by the next three orders that
  /// contain no stop. If an order is read more than 1 s after this movement, it acknowledges
  /// nothing.
  /// @param mCtrl main controller that receives the set-points
  /// @satisfies FR-288
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Has no effect: only the outer mode, which wraps this object, changes the reading mode.
  /// @param mCtrl main controller whose reading mode does not change
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

  /// @brief Checks whether a stop of the remote control is in force.
  /// @return true while a stop of the switch is latched, or while stopOrdered() of the wrapped mode
  /// returns true.
  /// @satisfies FR-285
  /// @satisfies FR-286
  /// @isr{no}
  [[nodiscard]] bool stopOrdered() const override;

 private:
  enum class Position : std::uint8_t { Stop, Pc, Drive };
  // Progress of the switch through the positions "stop", "PC" and "drive". The complete sequence
  // acknowledges faults.
  enum class Sequence : std::uint8_t { None, Stopped, Passed };

  [[nodiscard]] static Position positionOf(Microseconds width, Position before);
  void takePosition(Instant now);
  [[nodiscard]] bool stopConfirmed();
  /// @brief Records the progress of the switch through the positions "stop", "PC" and "drive".
  /// @param now present time
  /// @satisfies FR-288
  void advanceSequence(Instant now);
  [[nodiscard]] bool deflected(Instant now);
  [[nodiscard]] bool unattended(Instant now);

  Signals signals_;
  RcVigilance vigilance_;
  Position position_ = Position::Stop;
  Instant confirmedAt_{};  // time of the newest pulse that confirmed a stop
  // Width of this pulse; no value if an earlier cycle has already read this pulse.
  std::optional<Microseconds> confirmed_;
  Sequence sequence_ = Sequence::None;
  Instant drivenAt_{};                 // time at which the sequence was complete
  std::uint8_t acknowledgements_ = 0;  // number of orders that may still acknowledge faults
  bool stopped_ = true;
};

}  // namespace wr
