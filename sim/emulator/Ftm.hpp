#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief A timer with edge-aligned pulse-width modulation on its channels. The bus clock drives
/// its counter. See K64P144M120SF5RM, chapter FlexTimer Module (FTM).
///
/// The model has no other modes, no interrupts, and no flags of channels (they read 0). The effects
/// of MODE.FTMEN, and of the registers that MODE.FTMEN enables, are not modelled. This bit and
/// these registers must keep their reset values: a write of any other value is an access that is
/// not modelled.
class Ftm final : public Peripheral {
 public:
  /// @param number 0 to 3
  /// @param channels 8, or 2 for the timers 1 and 2
  Ftm(Microcontroller& board, unsigned number, unsigned channels);

  /// @brief Sets the function that returns true if a pin is connected to a channel.
  void connectPins(std::function<bool(unsigned channel)> connected);

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  [[nodiscard]] bool readHasEffect(std::uint32_t offset) const override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;
  [[nodiscard]] Time nextEvent() const override;
  void advance() override;

  /// @brief Returns the duty cycle of a channel, as a fraction of the period; 0 for a channel
  /// without a pin.
  [[nodiscard]] double duty(unsigned channel) const;

  /// @brief Returns true if the counter runs.
  [[nodiscard]] bool counts() const { return (control_ >> 3 & 3U) != 0; }

  /// @brief Reports the channels whose duty cycle has changed. The board calls this function when
  /// the pins may have changed.
  void show();

 private:
  struct Channel {
    std::uint32_t control = 0;
    std::uint32_t value = 0;  ///< CnV in the comparator
    std::optional<std::uint32_t>
        written{};  ///< written CnV, which takes effect at the end of the period
    std::uint32_t shown = 0;
  };

  [[nodiscard]] std::uint64_t bus() const { return board_.busClock().count(board_.time()); }
  [[nodiscard]] std::uint32_t period() const { return (modulo_ == 0 ? 0xFFFFU : modulo_) + 1; }
  [[nodiscard]] std::uint64_t length() const;
  [[nodiscard]] std::uint64_t overflows() const;
  [[nodiscard]] std::uint32_t counter() const;
  [[nodiscard]] std::uint32_t high(const Channel& channel) const;
  [[nodiscard]] bool isProtected(std::uint32_t before, std::uint32_t after, const char* what);
  [[nodiscard]] Channel* channelAt(std::uint32_t offset);
  [[nodiscard]] std::uint32_t readStatus();
  void setStatus(std::uint32_t value);
  void setMode(std::uint32_t value);
  void setChannel(Channel& channel, std::uint32_t value);
  void startFrom(std::uint32_t value);
  void waitForOverflow();
  void takeWritten();
  void checkValues();

  unsigned number_;
  unsigned channelCount_;
  std::string name_;
  std::function<bool(unsigned)> connected_;

  std::array<Channel, 8> channels_{};
  std::uint32_t control_ = 0;  ///< SC without its flag
  std::uint32_t modulo_ = 0;   ///< MOD in the counter
  std::optional<std::uint32_t> moduloWritten_;
  std::uint32_t configuration_ = 0;
  bool protectionOff_ = true;  ///< MODE.WPDIS
  bool protectionSeen_ = false;
  std::uint64_t from_ = 0;  ///< the counter was 0 at this count of the bus clock
  std::uint32_t held_ = 0;  ///< value of the counter while it is stopped
  std::uint64_t overflowsBefore_ = 0;
  std::uint64_t overflowsSeen_ = 0;
  bool flagRead_ = false;
  std::uint64_t takesAt_ = 0;  ///< a written value takes effect at this count of the bus clock
  bool waits_ = false;
};

}  // namespace wr::emulator
