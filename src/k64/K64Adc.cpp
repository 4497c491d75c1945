#include "k64/K64Adc.hpp"

#include <utility>

#include "k64/K64Board.hpp"
#include "k64/core.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

// The clock of the converters is the bus clock divided by 8. No other clock source of the
// converters is used, because the other sources are not the same in all microcontrollers of the
// family. The calibration needs a slow clock. Therefore the calibration runs before the PLL is
// started.
constexpr std::uint32_t kDivider = 8;
constexpr std::uint32_t kMinClock = 1'000'000;                                         // [Hz]
constexpr std::uint32_t kMaxCalibrationClock = 4'000'000;                              // [Hz]
constexpr std::uint32_t kMaxClock = 18'000'000;                                        // [Hz]
constexpr std::uint32_t kSlowestClock = K64Board::kSlowestClockAfterReset / kDivider;  // [Hz]
constexpr std::uint32_t kFastest = K64Board::kFastestClockAfterReset / kDivider;       // [Hz]
constexpr std::uint32_t kClock = K64Board::kBusClock / kDivider;                       // [Hz]
static_assert(kSlowestClock >= kMinClock && kFastest <= kMaxCalibrationClock,
              "the clock must be within the limits for a calibration");
static_assert(kClock >= kMinClock && kClock <= kMaxClock,
              "the clock must be within the limits for a conversion with 12 bits");

// A sample takes 40 clock periods of the converter: 20 until the sampled voltage is equal to the
// voltage of the pin, and 20 for the conversion. A result is the mean of four samples.
// A result takes 22 us, including some bus clocks. One converter computes at most three results in
// a tick. These results take a small part of the tick.
constexpr auto kConfiguration =
    adc::CFG1_ADICLK_BUS | adc::CFG1_MODE_12_BITS | adc::CFG1_ADLSMP | adc::CFG1_ADIV_8;

// Greatest number of reads of the status register. If the calibration has not ended after these
// reads, it has failed. One read takes at least 6 and less than 30 periods of the core clock, which
// has the same source as the clock of the converters. If each read takes 6 periods, there is still
// enough time for a calibration, which needs 14000 clock periods of the converter. A calibration
// takes less than 6 ms, because the clock of the converters has at least 2.5 MHz. If each read
// takes 30 periods of the core clock, all reads take less than 45 ms. The start waits for all reads
// only if a calibration does not end.
constexpr std::uint32_t kMaxPolls = 30'000;
static_assert(kMaxPolls * 6 > 14'000 * kDivider,
              "a calibration must take less time than kMaxPolls times 6 clock periods");

}  // namespace

void K64Adc::Converter::beginCalibration() {
  adc::SC1A.at(offset()).write(adc::SC1A_ADCH_NONE);
  adc::CFG1.at(offset()).write(kConfiguration);
  adc::CFG2.at(offset()).write(adc::CFG2_MUXSEL_B);
  adc::SC2.at(offset()).write({0});
  adc::SC3.at(offset()).write(adc::SC3_CALF);
  adc::SC3.at(offset()).write(adc::SC3_CAL | adc::SC3_AVGE | adc::SC3_AVGS_32);
}

void K64Adc::Converter::endCalibration() {
  auto status = adc::SC3.at(offset()).read();
  for (std::uint32_t look = 0; look < kMaxPolls && (status & adc::SC3_CAL).any(); ++look) {
    status = adc::SC3.at(offset()).read();
  }
  if ((status & (adc::SC3_CAL | adc::SC3_CALF)).any()) {
    return;
  }
  // The plus side and the minus side of the converter each have a gain: half the sum of the
  // calibration results of this side, with the highest bit set.
  constexpr std::uint32_t kHighest = 0x8000;
  std::uint32_t plus = 0;
  std::uint32_t minus = 0;
  for (std::uint32_t result = 0; result < adc::kCalibrationResults; ++result) {
    plus += adc::CLPS.at(offset() + result * adc::kResultDistance).read().value;
    minus += adc::CLMS.at(offset() + result * adc::kResultDistance).read().value;
  }
  adc::PG.at(offset()).write({(plus / 2) | kHighest});
  adc::MG.at(offset()).write({(minus / 2) | kHighest});
  adc::SC3.at(offset()).write(adc::SC3_AVGE | adc::SC3_AVGS_4);
  calibrated_ = true;
}

void K64Adc::Converter::ask(K64Adc& input) {
  if (!calibrated_ || input.asked_) {
    return;
  }
  input.asked_ = true;
  input.next_ = nullptr;
  if (first_ == nullptr) {
    first_ = &input;
    begin();
  } else {
    last_->next_ = &input;
  }
  last_ = &input;
}

void K64Adc::Converter::begin() const {
  adc::SC1A.at(offset()).write(adc::SC1A_AIEN | adc::SC1A.field(first_->number_, 0));
}

void K64Adc::Converter::finish() {
  if (first_ == nullptr || !(adc::SC1A.at(offset()).read() & adc::SC1A_COCO).any()) {
    return;
  }
  K64Adc& done = *first_;
  done.result_ = adc::RA.at(offset()).read().value;  // this read also clears the interrupt request
  done.asked_ = false;
  first_ = done.next_;
  if (first_ != nullptr) {
    begin();
  }
}

std::uint32_t K64Adc::Converter::offset() const {
  return number_ * adc::kConverterDistance;
}

void K64Adc::calibrate(Converters& converters) {
  for (Converter& converter : converters) {
    converter.beginCalibration();
  }
  for (Converter& converter : converters) {
    converter.endCalibration();
  }
}

void K64Adc::serve(Converter& converter) {
  converter.finish();
}

std::uint32_t K64Adc::takeResult() {
  const InterruptLock lock;
  converter_.ask(*this);
  return std::exchange(result_, kNone);
}

std::optional<std::uint16_t> K64Adc::sample() {
  const std::uint32_t result = takeResult();
  if (result == kNone) {
    return std::nullopt;
  }
  return static_cast<std::uint16_t>(result);
}

}  // namespace wr
