#pragma once

#include "devices/DigitalOutput.hpp"
#include "ports/mps2/registers.hpp"

namespace wr::mps2 {

/// @brief A light of the board.
class FpgaLight final : public DigitalOutput {
 public:
  /// @param bit bit of this light in the register of the lights
  explicit constexpr FpgaLight(decltype(lights::LED)::Bits bit) : bit_(bit) {}

  void set(bool on) override {
    if (on) {
      lights::LED.set(bit_);
    } else {
      lights::LED.clear(bit_);
    }
  }

 private:
  decltype(lights::LED)::Bits bit_;
};

}  // namespace wr::mps2
