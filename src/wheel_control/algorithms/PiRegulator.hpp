#pragma once

#include <array>
#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief Gains of a regulator, up to 16000 each.
/// @datatype
struct PiGains {
  std::int32_t proportional = 0;  ///< voltage of the present error [uV per unit of the error]
  std::int32_t integral = 0;      ///< voltage that each cycle of the error adds [uV per unit]
};

/// @brief Regulates an error to zero.
///
/// @function Computes a voltage from a part of the present error and a part of each earlier error.
/// An error that comes from a voltage that could not be applied is not added to the integral.
///
/// @secret How the integral is limited while the voltage is limited, and how fractions of a
/// millivolt are stored. How a changed bit in the memory of the integral is corrected. A wrong
/// integral would make the wheels of a robot work against each other for a long time.
class PiRegulator final {
 public:
  /// @brief Three copies of a number: a bit that changes in one copy has no effect.
  /// @datatype
  using Copies = std::array<std::int32_t, 3>;

  /// @brief Returns a number from its three copies.
  /// @param copies the copies
  /// @return the number, in the unit of the copies; each of its bits is equal in at least two
  /// copies
  /// @satisfies FR-224
  /// @isr{no}
  [[nodiscard]] static std::int32_t majority(const Copies& copies);

  /// @brief Constructs a regulator without memory.
  /// @param gains gains of the regulator
  explicit PiRegulator(const PiGains& gains);

  PiRegulator(const PiRegulator&) = delete;
  PiRegulator& operator=(const PiRegulator&) = delete;

  /// @brief Processes the error of the cycle that ends.
  /// @param error expected value minus measured value, in the unit of the gains, -65535 to 65535
  /// @return voltage that works against the error [mV], rounded towards zero
  /// @post The part of the integral is at most the supply.
  /// @satisfies FR-83
  /// @satisfies FR-300
  /// @satisfies FR-85
  /// @satisfies FR-224
  /// @isr{no}
  Tension regulate(std::int32_t error);

  /// @brief Records the voltage that the wheel will lack in the cycle that begins. An error of that
  /// cycle that the missing voltage explains is not added to the integral. A missing voltage of
  /// less than 0.1 V does not explain an error.
  /// @param shortfall calculated minus applied voltage [mV]
  /// @satisfies FR-301
  /// @isr{no}
  void missed(Tension shortfall);

  /// @brief Clears all errors.
  /// @isr{no}
  void reset();

 private:
  PiGains gains_;
  Copies integral_{};    // [uV]
  Tension shortfall_{};  // missing voltage of the cycle whose error comes next
};

}  // namespace wr
