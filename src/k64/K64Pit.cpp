#include "k64/K64Pit.hpp"

#include "k64/K64Board.hpp"
#include "k64/registers.hpp"

namespace wr {

void K64Pit::switchOn() {
  // Erratum of the chip: the first access after the opening of the clock gate is lost. Therefore
  // the register is read once before it is written.
  static_cast<void>(pit::MCR.read());
  pit::MCR.write({0});
}

void K64Pit::start(Microseconds period) {
  switchOn();
  stop();
  const auto ticks = static_cast<std::uint32_t>(period.count()) * K64Board::kTicksPerMicrosecond;
  pit::LDVAL.at(offset()).write({ticks - 1});
  pit::TFLG.at(offset()).write(pit::TFLG_TIF);
  pit::TCTRL.at(offset()).write(pit::TCTRL_TIE | pit::TCTRL_TEN);
}

void K64Pit::stop() {
  pit::TCTRL.at(offset()).write({0});
}

void K64Pit::acknowledge() {
  pit::TFLG.at(offset()).write(pit::TFLG_TIF);
}

std::uint32_t K64Pit::offset() const {
  return static_cast<std::uint32_t>(channel_) * pit::kChannelDistance;
}

}  // namespace wr
