#include "k64/K64Pit.hpp"

#include "k64/K64Board.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

constexpr std::uint32_t kTicksPerMicrosecond = K64Board::kBusClock / 1'000'000;
static_assert(kTicksPerMicrosecond * 1'000'000 == K64Board::kBusClock, "whole ticks");

}  // namespace

void K64Pit::start(Microseconds period) {
  // Erratum: an access right after the clock came is lost, so the module is read first.
  static_cast<void>(pit::MCR.read());
  pit::MCR.write({0});
  stop();
  const auto ticks = static_cast<std::uint32_t>(period.count()) * kTicksPerMicrosecond;
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
