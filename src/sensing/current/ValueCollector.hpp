#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"
#include "services/Command.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Record of the samples of a current. The first samples after the start only determine the
/// zero of the sensor. Sum and number include all later samples, and can overflow. A reader
/// subtracts an earlier record from a later record. The differences are correct for at most
/// ValueCollector::kMaxSamples samples. The difference of the sums is a signed number.
/// @datatype
struct CurrentRecord {
  std::uint32_t sum =
      0;  ///< sum of the samples, each minus the zero of the sensor [1/4096 of the range]
  std::uint32_t number = 0;  ///< number of samples in the sum
  Instant at{};              ///< time of the newest sample
};

/// @brief A collector of the samples of a wheel's current.
/// @function Measures the zero of the sensor at start, that is, its output without current. Adds up
/// the samples for the thread of the wheel. Executes a command as soon as the current is too high.
/// @secret The zero of the sensor, which is subtracted from each sample, and the limit beyond which
/// the motor must be switched off.
/// @hides{ValueCollector::kGroupSize}
/// @hides{ValueCollector::kZeroSamples}
/// @role{wheel-timer-interrupt, Receiver}
class ValueCollector final {
 public:
  /// @brief Number of samples from which the zero is computed.
  static constexpr std::int32_t kZeroSamples = 64;

  /// @brief Greatest number of samples between two records that a reader subtracts.
  static constexpr std::int32_t kMaxSamples = 500'000;

  /// @brief Number of samples between two writes of the record.
  static constexpr std::uint32_t kGroupSize = 8;  // [samples]

  /// @param overcurrent command that is executed in the interrupt: at the fifth successive sample
  /// that is too high, and then at each later sample until a sample is not too high
  /// @param timebase returns the time of a sample
  ValueCollector(Command& overcurrent, const Timebase& timebase);

  ValueCollector(const ValueCollector&) = delete;
  ValueCollector& operator=(const ValueCollector&) = delete;

  /// @brief Adds a sample. The mean of the first 64 samples is the zero of the sensor. If the zero
  /// differs from the middle of the range by more than 5 % of the range, all later samples are
  /// ignored. Otherwise each later sample is added to the record. A sample is too high if it is
  /// beyond 15 A or at an end of the range.
  /// @param raw present sample [1/4096 of the range, 0 to 4095]
  /// @pre The motor has no current until the zero is computed.
  /// @isr{yes}
  /// @satisfies FR-125
  /// @satisfies FR-126
  /// @satisfies FR-128
  void collect(std::uint16_t raw);

  /// @brief Returns the record of the samples, up to the last complete group of 8.
  /// @return the record, which does not change before the next call; it is empty until 8 samples
  /// have followed the 64 samples for the zero
  /// @pre Only the thread of the wheel calls this function.
  /// @isr{no}
  /// @satisfies FR-125
  [[nodiscard]] const CurrentRecord& record();

 private:
  /// @brief Adds a sample to the sum from which the zero of the sensor is computed. Computes the
  /// zero after the last of these samples.
  void learnZero(std::int32_t raw);

  /// @brief Counts the successive samples that are too high, and executes the command from the
  /// fifth such sample on.
  void guard(std::int32_t raw);

  /// @brief Writes the record of all samples up to now. The thread of the wheel reads this record.
  void publish();

  Command& overcurrent_;
  const Timebase& timebase_;
  std::int32_t learned_ = 0;   // number of samples in the sum zero_ during the calibration
  std::int32_t zero_ = 0;      // sum of samples during the calibration, then the zero
  bool plausible_ = false;     // the zero is computed and plausible
  std::int32_t least_ = 0;     // least sample that is not too high
  std::int32_t greatest_ = 0;  // greatest sample that is not too high
  std::uint32_t tooHigh_ = 0;  // number of successive samples that are too high
  std::uint32_t sum_ = 0;
  std::uint32_t number_ = 0;
  Pipe<CurrentRecord> record_;
};

}  // namespace wr
