#include "k64/K64Ftm.hpp"

#include <algorithm>

#include "k64/K64Board.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

constexpr std::uint32_t kPeriod = K64Board::kBusClock / K64Ftm::kFrequency;  // [bus clocks]
static_assert(kPeriod == 3000 && kPeriod <= 0xFFFF,
              "a pulse as wide as the period must also fit into the register");

constexpr DutyCycle kWholePeriod(10'000);  // [0.01 %]
constexpr std::uint32_t kChannelCount = 4;

constexpr std::uint32_t widthOf(DutyCycle dutyCycle) {
  const auto share =
      static_cast<std::uint32_t>(std::clamp(dutyCycle, DutyCycle(0), kWholePeriod).count());
  constexpr auto kPeriodParts = static_cast<std::uint32_t>(kWholePeriod.count());
  return (share * kPeriod + kPeriodParts / 2) / kPeriodParts;
}
static_assert(widthOf(DutyCycle(0)) == 0 && widthOf(kWholePeriod) == kPeriod);

}  // namespace

void K64Ftm::start() {
  // The timer is stopped while its registers are written. Therefore each value takes effect
  // immediately.
  ftm0::MODE.write(ftm0::MODE_WPDIS);
  ftm0::SC.write({0});
  ftm0::CONF.write(ftm0::CONF_BDMMODE_SAFE);
  ftm0::CNTIN.write({0});
  ftm0::CNT.write({0});
  ftm0::MOD.write({kPeriod - 1});
  for (std::uint32_t channel = 0; channel < kChannelCount; ++channel) {
    // The output is high from the beginning of each period until the counter reaches the width. If
    // the width is greater than MOD, the counter never reaches the width, and the output stays
    // high.
    ftm0::CnSC.at(channel * ftm0::kChannelDistance).write(ftm0::CnSC_MSB | ftm0::CnSC_ELSB);
    ftm0::CnV.at(channel * ftm0::kChannelDistance).write({0});
  }
  ftm0::SC.write(ftm0::SC_CLKS_BUS);
}

void K64Ftm::set(DutyCycle dutyCycle) {
  // While the timer runs, a new value takes effect when the counter restarts at 0 after MOD.
  const std::uint32_t offset = static_cast<std::uint32_t>(channel_) * ftm0::kChannelDistance;
  ftm0::CnV.at(offset).write({widthOf(dutyCycle)});
}

}  // namespace wr
