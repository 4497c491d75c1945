#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "devices/AnalogInput.hpp"
#include "k64/pins.hpp"

namespace wr {

/// @brief An input of the two converters of the K64.
/// @function Converts the voltage of one pin to 12 bits, as the mean of four samples.
/// @secret How a converter is calibrated and started, and the sequence of the inputs that share it.
class K64Adc final : public AnalogInput {
 public:
  /// @brief Number of converters.
  static constexpr std::size_t kConverterCount = 2;

  /// @brief An input of a converter.
  /// @datatype
  struct Channel {
    std::uint8_t converter;  ///< 0 or 1
    std::uint8_t number;     ///< number of the input
  };

  /// @brief Returns the channel of a signal; a signal that is on no pin does not compile.
  /// @param signal its name in the manual, such as ADC0_SE12
  /// @return its channel
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

  /// @brief One converter: it converts one input at a time.
  class Converter {
   public:
    /// @brief Constructs a converter that is off.
    /// @param number 0 or 1
    explicit constexpr Converter(std::uint8_t number) : number_(number) {}

    Converter(const Converter&) = delete;
    Converter& operator=(const Converter&) = delete;

   private:
    friend class K64Adc;

    void beginCalibration();
    void endCalibration();
    // Always inlined: these methods run several times in a millisecond, and a call would cost as
    // much as the work.
    [[gnu::always_inline]] inline void ask(K64Adc& input);
    [[gnu::always_inline]] inline void begin() const;
    [[gnu::always_inline]] inline void finish();
    [[nodiscard]] std::uint32_t offset() const;

    std::uint8_t number_;
    bool calibrated_ = false;
    K64Adc* first_ = nullptr;  // input that is being converted; the waiting inputs follow
    K64Adc* last_ = nullptr;
  };

  /// @brief The converters.
  using Converters = std::array<Converter, kConverterCount>;

  /// @brief Binds an input to its converter.
  /// @param converters the converters; they exist as long as the input
  /// @param channel the channel; nothing else uses it
  constexpr K64Adc(Converters& converters, Channel channel)
      : converter_(converters[channel.converter]), number_(channel.number) {}

  /// @brief Sets the converters up and calibrates them, all at the same time. The wait is bounded: less
  /// than 45 ms for each.
  /// @param converters the converters
  /// @pre The clock gates of the converters are open, the core still uses the clock after reset,
  /// and the interrupts of the converters are not enabled yet.
  /// @post A converter whose calibration failed or did not end never converts.
  /// @isr{no}
  /// @satisfies FR-143
  static void calibrate(Converters& converters);

  /// @brief Stores a result and begins the next requested conversion. The vector of the
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

  static constexpr std::size_t kConverterAt =
      3;  // position of the converter's number in the name of a signal
  static constexpr std::size_t kNumberAt = 7;
  static constexpr std::uint32_t kNone = 0xFFFF'FFFF;

  Converter& converter_;
  std::uint8_t number_;
  bool asked_ = false;
  K64Adc* next_ = nullptr;
  std::uint32_t result_ = kNone;
};

}  // namespace wr
