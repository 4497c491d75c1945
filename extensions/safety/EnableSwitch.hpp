#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"
#include "main_control/operation_modes/ModeDecorator.hpp"
#include "safety/RcVigilance.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Adds a stop to the remote control, and lets its operator choose the source of orders.
///
/// @function Reads the enable switch in every cycle. In its position "stop", or without its pulses, a stop
/// is latched until the switch leaves that position while the velocity stick is centred. A stop
/// between two cycles acts in the second cycle. In the position "PC" the remote control has no
/// orders. The sequence stop, PC, drive acknowledges latched faults. When the remote control moves
/// the robot and its pulses do not change, the robot is stopped.
///
/// @secret Which position of the enable switch permits which orders, and when its stop ends.
///
/// @role{mode-extensions, Concrete Decorator}
class EnableSwitch final : public ModeDecorator {
 public:
  /// @brief Signals of the remote control. Each exists as long as the mode.
  /// @datatype
  struct Signals {
    Pipe<Velocity>& velocity;    ///< position of the velocity stick
    Pipe<Angle>& direction;      ///< position of the direction stick
    Pipe<Microseconds>& enable;  ///< width of the pulses of the enable switch
    Pipe<Microseconds>& stop;    ///< width of the pulses that confirm a stop
    const Timebase& timebase;    ///< returns the time
  };

  /// @brief Shortest pulse of the switch that does not order a stop.
  static constexpr Microseconds kMinNoStopPulse{1250};

  /// @brief Binds the switch to the mode that it extends. It begins with a stop.
  /// @param wrapped the extended mode
  /// @param signals signals of the remote control
  EnableSwitch(Mode& wrapped, const Signals& signals);

  /// @brief Reads the switch and the sticks.
  /// @satisfies FR-285
  /// @satisfies FR-286
  /// @satisfies FR-289
  /// @isr{no}
  void serve() override;

  /// @brief Checks for orders of the remote control.
  /// @return true if there is a new order and the switch is not in the position "PC".
  /// @satisfies FR-287
  /// @isr{no}
  [[nodiscard]] bool newMessage() const override;

  /// @brief Reads the order of the remote control; it acknowledges after the sequence stop, PC, drive.
  /// @param mCtrl controller whose data receive the set-points
  /// @satisfies FR-288
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Has no effect: the mode that wraps this mode changes the reading mode.
  /// @param mCtrl controller whose mode does not change
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

  /// @brief Checks whether the remote control orders a stop.
  /// @return true while its stop is latched.
  /// @satisfies FR-285
  /// @satisfies FR-286
  /// @isr{no}
  [[nodiscard]] bool stopOrdered() const override;

 private:
  enum class Position : std::uint8_t { Stop, Pc, Drive };
  // Progress in the sequence that acknowledges.
  enum class Sequence : std::uint8_t { None, Stopped, Passed };

  [[nodiscard]] static Position positionOf(Microseconds width, Position before);
  void takePosition(Instant now);
  [[nodiscard]] bool stopConfirmed();
  void advanceSequence();
  [[nodiscard]] bool deflected(Instant now);
  [[nodiscard]] bool unattended(Instant now);

  Signals signals_;
  RcVigilance vigilance_;
  Position position_ = Position::Stop;
  Instant confirmedAt_{};  // newest pulse that confirmed a stop
  Sequence sequence_ = Sequence::None;
  std::uint8_t acknowledgements_ = 0;  // number of orders that still acknowledge
  bool stopped_ = true;
};

}  // namespace wr
