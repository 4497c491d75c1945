#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "devices/AnalogInput.hpp"
#include "k64/pins.hpp"

namespace wr {

/// @brief Analog input of the K64, which has two converters.
/// @function Converts the voltage of one pin to 12 bits, as the mean of four samples.
/// @secret The steps that calibrate and start a converter, and the sequence in which a converter
/// serves its inputs.
class K64Adc final : public AnalogInput {
 public:
  /// @brief Number of converters.
  static constexpr std::size_t kConverterCount = 2;

  /// @brief Number of a converter, and number of one of its inputs.
  /// @datatype
  struct Channel {
    std::uint8_t converter;  ///< 0 or 1
    std::uint8_t number;     ///< number of the input at this converter
  };

  /// @brief Returns the channel of a signal. If no pin has this signal, the compiler reports an
  /// error.
  /// @param signal name of the signal in the manual, such as ADC0_SE12
  /// @return channel of the signal
  /// @satisfies FR-142
  /// @isr{yes}
  static consteval Channel channelOf(std::string_view signal) {
    static_cast<void>(pinOf(signal));
    std::uint8_t number = 0;
    for (const char digit : signal.substr(kNumberAt)) {
      if (digit >= '0' && digit <= '9') {
        number = static_cast<std::uint8_t>(number * 10 + (digit - '0'));
      }
    }
    return {static_cast<std::uint8_t>(signal[kConverterAt] - '0'), number};
  }

  /// @brief Converter that several inputs share. It converts one input at a time.
  class Converter {
   public:
    /// @brief Constructs a converter that is not calibrated and converts nothing yet.
    /// @param number 0 or 1
    explicit constexpr Converter(std::uint8_t number) : number_(number) {}

    Converter(const Converter&) = delete;
    Converter& operator=(const Converter&) = delete;

   private:
    friend class K64Adc;

    void beginCalibration();
    void endCalibration();
    // These methods are always inlined. They run several times in a millisecond, and the call of a
    // method would take as long as the method itself.
    [[gnu::always_inline]] inline void ask(K64Adc& input);
    [[gnu::always_inline]] inline void begin() const;
    [[gnu::always_inline]] inline void finish();
    [[nodiscard]] std::uint32_t offset() const;

    std::uint8_t number_;
    bool calibrated_ = false;
    K64Adc* first_ = nullptr;  // first input in the queue: it is being converted now
    K64Adc* last_ = nullptr;
  };

  /// @brief All converters of the microcontroller.
  using Converters = std::array<Converter, kConverterCount>;

  /// @param converters the converters; they must exist as long as this input
  /// @param channel the channel; no other object may use it
  constexpr K64Adc(Converters& converters, Channel channel)
      : converter_(converters[channel.converter]), number_(channel.number) {}

  /// @brief Sets up all converters and calibrates them at the same time, within the time of FR-143.
  /// If a calibration does not end, the function stops waiting for this converter after a limited
  /// number of reads, and the start continues.
  /// @param converters the converters
  /// @pre The clock gates of the converters are open. The core still uses the slow clock with which
  /// it starts after a reset, because the full clock is too fast for a calibration. The interrupts
  /// of the converters are not enabled yet.
  /// @post If the calibration of a converter failed or did not end in time, this converter never
  /// converts.
  /// @isr{no}
  /// @satisfies FR-143
  static void calibrate(Converters& converters);

  /// @brief Stores a result, and starts the next requested conversion. The handler of the
  /// converter's interrupt calls this function.
  /// @param converter the converter
  /// @isr{yes}
  /// @satisfies FR-142
  static void serve(Converter& converter);

  /// @isr{yes}
  /// @satisfies FR-142
  /// @satisfies FR-205
  [[nodiscard]] std::optional<std::uint16_t> sample() override;

 private:
  [[gnu::always_inline]] inline std::uint32_t takeResult();

  static constexpr std::size_t kConverterAt = 3;  // position of the converter's number in a signal
  static constexpr std::size_t kNumberAt = 7;     // position of the input's number in a signal
  static constexpr std::uint32_t kNone = 0xFFFF'FFFF;

  Converter& converter_;
  std::uint8_t number_;
  bool asked_ = false;
  K64Adc* next_ = nullptr;
  std::uint32_t result_ = kNone;
};

}  // namespace wr
