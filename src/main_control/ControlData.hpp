#pragma once

#include <cstdint>
#include <optional>

#include "communication/serialization/ReportData.hpp"
#include "main_control/operation_modes/Mode.hpp"
#include "main_control/operation_states/OperationState.hpp"
#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Data of a control cycle: orders, measurements, outputs.
///
/// @function Stores the set-points in force, their source, and the measured and applied values of
/// the present cycle. Returns the content of the report.
///
/// @secret The values that stay stored from one cycle to the next, and the values that are cleared
/// when a cycle begins.
class ControlData {
 public:
  /// @brief Constructs the data before the first cycle. There are no set-points.
  ControlData() = default;
  ControlData(const ControlData&) = delete;
  ControlData& operator=(const ControlData&) = delete;

  /// @brief Begins the next cycle. Clears the measured and applied values of the previous cycle.
  /// The set-points stay in force.
  /// @param clockPulse time of the clock pulse
  /// @isr{no}
  /// @satisfies FR-174
  void beginCycle(Instant clockPulse);

  /// @brief Records three numbers of processor cycles for the report: from the clock pulse to the
  /// start of this control cycle, between the last two clock pulses, and from the previous clock
  /// pulse to the report of the previous control cycle.
  /// @param pulse count of processor cycles at the clock pulse of this control cycle
  /// @param start count of processor cycles when this control cycle began
  /// @satisfies FR-302
  /// @satisfies FR-303
  /// @isr{no}
  void saveStart(std::uint32_t pulse, std::uint32_t start);

  /// @brief Records the time at which the report of this control cycle was sent. The next report
  /// contains the number of processor cycles from the clock pulse to this time.
  /// @param end count of processor cycles at this time
  /// @satisfies FR-160
  /// @isr{no}
  void saveReported(std::uint32_t end);

  /// @brief Records the source of the set-points that are saved next.
  /// @param source number of the reading mode
  /// @satisfies FR-19
  /// @isr{no}
  void saveModeId(ModeId source);

  /// @brief Records the set-points. The last call of saveModeId() has recorded their source.
  /// @param setPoints set-points of the control systems
  /// @satisfies FR-19
  /// @satisfies FR-305
  /// @isr{no}
  void saveSetPoints(const SetPoints& setPoints);

  /// @brief Records the sources that order a stop in this cycle.
  /// @param sources one bit for each source [bit n is 1 if the source with the mode id n orders a
  /// stop]
  /// @isr{no}
  /// @satisfies FR-175
  /// @satisfies FR-242
  void saveStop(std::uint8_t sources);

  /// @brief Records whether the control systems are held in this cycle.
  /// @param held true if the wheels are halted and the steering is held
  /// @isr{no}
  /// @satisfies FR-306
  void saveHeld(bool held);

  /// @brief Counts this cycle as an overrun.
  /// @post The number of overruns is at most 65535.
  /// @isr{no}
  void saveOverrun();

  /// @brief Returns the set-points in force.
  /// @return set-points that were read last; nothing before the first read.
  /// @isr{no}
  /// @satisfies FR-14
  [[nodiscard]] const std::optional<SetPoints>& setPoints() const;

  /// @brief Returns whether a stop is in force in this cycle.
  /// @return true if any source orders a stop in this cycle.
  /// @isr{no}
  /// @satisfies FR-21
  [[nodiscard]] bool stopped() const;

  /// @brief Returns the number of the present cycle.
  /// @return number of the cycle, counted from 1; 0 before the first cycle.
  /// @isr{no}
  /// @satisfies FR-174
  [[nodiscard]] std::uint32_t cycle() const;

  /// @brief Returns the measured values of this cycle. The caller may change them.
  /// @return measured values; all values are missing when a cycle begins.
  /// @isr{no}
  /// @satisfies FR-93
  [[nodiscard]] Measurements& measurements();

  /// @brief Returns the applied values of this cycle. The caller may change them.
  /// @return applied values; all values are missing when a cycle begins.
  /// @isr{no}
  /// @satisfies FR-94
  [[nodiscard]] Outputs& outputs();

  /// @brief Completes and returns the content of the report of this cycle.
  /// @param state operation state to report
  /// @param mode reading mode to report
  /// @param counts numbers of frames and bytes that the link to the PC lost or rejected
  /// @pre The caller calls this function once in a cycle, when the measurements are complete.
  /// @return content of the report; it is valid until the next cycle begins.
  /// @satisfies FR-61
  /// @satisfies FR-175
  /// @satisfies FR-305
  /// @satisfies FR-306
  /// @satisfies FR-242
  /// @satisfies FR-249
  /// @isr{no}
  [[nodiscard]] const ReportData& report(OperationStateId state, ModeId mode,
                                         const LinkCounts& counts);

 private:
  /// @brief Returns the reason why the set-points are not followed in this cycle.
  /// @satisfies FR-242
  [[nodiscard]] Inhibit inhibit(OperationStateId state) const;

  std::optional<SetPoints> setPoints_;
  ModeId readSource_ = ModeId::None;
  ReportData report_;                   // values of the present cycle
  std::optional<std::uint32_t> pulse_;  // count of processor cycles at the clock pulse
  std::uint32_t reported_ = 0;          // processor cycles from the clock pulse to the report
};

}  // namespace wr
