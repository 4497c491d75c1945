#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace wr::faults {

/// @brief Outputs of the robot in one step of 1 ms.
struct Outputs {
  std::array<float, 4> drive{};  ///< share of the supply at each wheel, signed; 0: driver off
  float steering = 0;            ///< degrees

  /// @brief Returns whether no wheel has voltage.
  [[nodiscard]] bool wheelsOff() const { return drive == std::array<float, 4>{}; }
};

/// @brief The run with a fault, after the injection.
struct Observation {
  static constexpr int kNever = -1;

  std::vector<Outputs> outputs;  ///< one for each ms
  int resetAt = kNever;          ///< ms after the injection of the first reset
  int reportedAt = kNever;       ///< ms after the injection of the first report of a fault
  bool answers = true;           ///< the robot reports, or it answers a Hello, at the end
};

/// @brief Class of a fault.
enum class Outcome : std::uint8_t {
  Harmless,  ///< the outputs are equal to the outputs of the run without the fault
  Detected,  ///< a reset or a report in time, and no wrong output afterwards
  Late,      ///< a reset or a report, but the outputs were wrong for too long, or after the reset
  Silent,    ///< wrong outputs, no reset and no report
  Hung,      ///< no reports, no answers and no reset
  Stopped    ///< the virtual board cannot continue: the behaviour of a real board is unknown
};

/// @brief Returns the name of a class in the record.
[[nodiscard]] std::string_view nameOf(Outcome outcome);

/// @brief Class of a fault, with its times.
struct Verdict {
  Outcome outcome = Outcome::Harmless;
  int safeAfter = Observation::kNever;  ///< ms from the injection to the reset or the report
  int wrongFor = 0;                     ///< ms with a wrong output
};

/// @brief Voltages of wheels that differ by more than this share of the supply are wrong. At constant
/// velocity the control loop changes the voltage by less from cycle to cycle.
inline constexpr float kWrongDrive = 0.05F;
/// @brief Angles that differ by more degrees than this are wrong. The value is twice the greatest
/// permanent error.
inline constexpr float kWrongAngle = 1.0F;
/// @brief A wrong output of at most this duration [ms] does not move a wheel noticeably: the
/// mechanical time constant of a wheel is longer.
inline constexpr int kShort = 20;
/// @brief Outputs may be wrong for this time [ms] before the safe state: the longest time of the
/// watchdog and one control cycle.
inline constexpr int kSafeWithin = 300;

/// @brief Compares a run with a fault with the same run without the fault.
/// @param faulty the run with the fault
/// @param reference outputs of the run without the fault, from the same instant; at least as many
/// @return its class
[[nodiscard]] Verdict judge(const Observation& faulty, const Outputs* reference);

}  // namespace wr::faults
