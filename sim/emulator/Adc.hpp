#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief An analog-to-digital converter and the voltages at its inputs. See K64P144M120SF5RM,
/// chapter Analog-to-Digital Converter (ADC). For the limits of the conversion clock, see data
/// sheet K64P144M120SF5, 16-bit ADC operating conditions.
///
/// A conversion returns the voltage that the input has when the conversion begins. At an open
/// input, the capacitor of the converter keeps the charge of the previous conversion. The model
/// has the calibration, and single-ended conversions that the program starts. Its only clock is the
/// bus clock. It has no hardware triggers, differential inputs, continuous conversions, compare
/// function, or DMA.
class Adc final : public Peripheral {
 public:
  /// @brief Mode of the pin of a channel; None if the channel has no separate pin.
  enum class Input { None, Digital, Analog };

  /// @param number 0 or 1
  /// @param calibrates true if the calibration succeeds
  Adc(Microcontroller& board, unsigned number, bool calibrates);

  /// @brief Sets the function that returns the mode of the pin of a channel.
  void connectPins(std::function<Input(unsigned channel)> input);

  /// @brief Puts a voltage on an input.
  void setVolts(unsigned channel, double volts) { volts_.at(channel) = volts; }

  /// @brief Opens an input. A conversion of an open input returns the voltage of the previous
  /// conversion, because the capacitor keeps this voltage.
  void open(unsigned channel) { volts_.at(channel).reset(); }

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  [[nodiscard]] bool readHasEffect(std::uint32_t offset) const override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;
  [[nodiscard]] Time nextEvent() const override;
  void advance() override;

 private:
  enum class Doing { Nothing, Converts, Calibrates };

  static constexpr std::size_t kWords = 0x70 / 4;

  [[nodiscard]] std::uint64_t bus() const { return board_.busClock().count(board_.time()); }
  [[nodiscard]] std::uint32_t& at(std::uint32_t offset) { return words_[offset / 4]; }
  [[nodiscard]] std::uint32_t at(std::uint32_t offset) const { return words_[offset / 4]; }
  [[nodiscard]] std::uint32_t busClocksOfClock() const;
  [[nodiscard]] std::uint32_t clocksOfConversion() const;
  [[nodiscard]] std::uint32_t gain(std::uint32_t firstResult) const;
  [[nodiscard]] std::uint32_t measured(unsigned channel);
  void checkClock(std::uint64_t least, std::uint64_t most, const char* what);
  void checkInput(unsigned channel);
  void begin(Doing doing, std::uint64_t busClocks);
  void start(std::uint32_t value);
  void calibrate();
  void setControl3(std::uint32_t value);
  void finish();
  void update();

  std::string name_;
  unsigned line_;
  bool calibrates_;
  std::function<Input(unsigned)> input_;
  std::array<std::optional<double>, 24> volts_;
  double capacitor_ = 0;  ///< voltage of the previous conversion; all inputs share the capacitor

  std::array<std::uint32_t, kWords> words_{};
  Doing doing_ = Doing::Nothing;
  std::uint64_t endsAt_ = 0;  ///< doing_ becomes Nothing at this count of the bus clock
  std::uint32_t sample_ = 0;
  bool calibrated_ = false;
};

}  // namespace wr::emulator
