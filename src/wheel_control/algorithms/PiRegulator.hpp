#pragma once

#include <array>
#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief Gains of a regulator. Each gain is at most 16000. The unit of the error is the unit of
/// the controlled quantity: 0.1 rpm in VelocityAlgorithm, and 1 mA in CurrentAlgorithm.
/// @datatype
struct PiGains {
  std::int32_t proportional = 0;  ///< voltage for the present error [uV per unit of the error]
  std::int32_t integral = 0;      ///< voltage added in each cycle [uV per unit of the error]
};

/// @brief A regulator that reduces an error to zero.
///
/// @function Computes a voltage from the present error and from the integral, which is the sum of
/// the errors. If the difference between the calculated and the applied voltage explains an error,
/// the error is not added to the integral.
///
/// @secret The rule that limits the integral while the voltage is limited, the form in which
/// fractions of a millivolt are stored, and the correction of a changed bit in the memory of the
/// integral. With a wrong integral, the wheels of a robot would work against each other for a long
/// time.
class PiRegulator final {
 public:
  /// @brief Three copies of a number: if a bit changes in one copy, this has no effect.
  /// @datatype
  using Copies = std::array<std::int32_t, 3>;

  /// @brief Returns a number from its three copies.
  /// @param copies the copies
  /// @return the number, in the unit of the copies; each bit has the value that it has in at least
  /// two of the copies
  /// @satisfies FR-224
  /// @isr{no}
  [[nodiscard]] static std::int32_t majority(const Copies& copies);

  /// @brief Constructs a regulator with the integral 0.
  /// @param gains gains of the regulator
  explicit PiRegulator(const PiGains& gains);

  PiRegulator(const PiRegulator&) = delete;
  PiRegulator& operator=(const PiRegulator&) = delete;

  /// @brief Computes the voltage from the error of the cycle that ends, and updates the integral.
  /// @param error expected value minus measured value, in the unit of the gains, -65535 to 65535
  /// @return voltage that works against the error [mV], rounded towards zero
  /// @post The magnitude of the integral is at most the supply voltage.
  /// @satisfies FR-83
  /// @satisfies FR-300
  /// @satisfies FR-85
  /// @satisfies FR-224
  /// @isr{no}
  Tension regulate(std::int32_t error);

  /// @brief Records the missing voltage of the cycle that begins: the calculated voltage minus the
  /// applied voltage. If the missing voltage explains the error of this cycle, the error is not
  /// added to the integral. A missing voltage of less than 0.1 V does not explain an error.
  /// @param shortfall calculated minus applied voltage [mV]
  /// @satisfies FR-301
  /// @isr{no}
  void missed(Tension shortfall);

  /// @brief Sets the integral and the missing voltage to 0.
  /// @isr{no}
  void reset();

 private:
  PiGains gains_;
  Copies integral_{};    // [uV]
  Tension shortfall_{};  // missing voltage of the cycle whose error is processed next
};

}  // namespace wr
