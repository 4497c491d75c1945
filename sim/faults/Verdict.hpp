#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace wr::faults {

/// @brief Outputs of the robot in one step of 1 ms.
struct Outputs {
  std::array<float, 4>
      drive{};  ///< fraction of the supply voltage at each wheel, signed; 0: there is no voltage
  float steering = 0;  ///< degrees

  /// @brief Returns true if no wheel has voltage.
  [[nodiscard]] bool wheelsOff() const { return drive == std::array<float, 4>{}; }
};

/// @brief The part of a run after the injection of a fault.
struct Observation {
  static constexpr int kNever = -1;

  std::vector<Outputs> outputs;  ///< one for each ms
  int resetAt = kNever;          ///< time of the first reset [ms after the injection]
  int reportedAt = kNever;       ///< time of the first report of a fault [ms after the injection]
  bool answers = true;           ///< at the end, the robot sends reports or answers a Hello
};

/// @brief Class of the effect of a fault.
enum class Outcome : std::uint8_t {
  Harmless,  ///< no output was wrong, and there was neither a reset nor a report
  Detected,  ///< there was a reset or a report after at most kSafeWithin ms of wrong outputs, and
             ///< no output was wrong after a reset
  Late,    ///< there was a reset or a report, but the outputs were wrong after a reset, or had been
           ///< wrong for more than kSafeWithin ms before the reset or report
  Silent,  ///< the outputs were wrong, and there was neither a reset nor a report
  Hung,    ///< there was no report, no answer and no reset
  Stopped  ///< the virtual board cannot continue; the behaviour of a real board is unknown
};

/// @brief Returns the name of a class, as in the record of the fault campaign.
[[nodiscard]] std::string_view nameOf(Outcome outcome);

/// @brief Class of a fault and the times of its effects.
struct Verdict {
  Outcome outcome = Outcome::Harmless;
  int safeAfter = Observation::kNever;  ///< ms from the injection to the first reset or report
  int wrongFor = 0;                     ///< ms with a wrong output
};

/// @brief A wheel voltage is wrong if it differs from the reference by more than this fraction of
/// the supply voltage. At constant velocity, the control loop changes the voltage by less than this
/// fraction from cycle to cycle.
inline constexpr float kWrongDrive = 0.05F;
/// @brief An angle is wrong if it differs from the reference by more than this number of degrees.
/// The number is twice the permanent error that FR-101 permits.
inline constexpr float kWrongAngle = 1.0F;
/// @brief If an output is wrong for at most this time [ms], it does not move a wheel noticeably. The
/// mechanical time constant of a wheel is longer than this time.
inline constexpr int kShort = 20;
/// @brief Outputs may be wrong for this time [ms] before the safe state. This time is equal to the
/// time-out of the watchdog.
inline constexpr int kSafeWithin = 300;

/// @brief Compares a run that has a fault with the same run without the fault.
/// @param faulty the run with the fault
/// @param reference outputs of the run without the fault. They begin at the same instant as the
/// outputs of the run with the fault, and do not end earlier
/// @return class of the fault, and the times of its effects
[[nodiscard]] Verdict judge(const Observation& faulty, const Outputs* reference);

}  // namespace wr::faults
