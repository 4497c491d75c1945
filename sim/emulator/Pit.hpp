#pragma once

#include <array>
#include <cstdint>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief Four timers that count down with the bus clock. Their interrupt lines are 48 to 51. See
/// K64P144M120SF5RM, chapter Periodic Interrupt Timer (PIT).
class Pit final : public Peripheral {
 public:
  explicit Pit(Microcontroller& board) : Peripheral(board) {}

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  [[nodiscard]] bool readHasEffect(std::uint32_t offset) const override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;
  [[nodiscard]] Time nextEvent() const override;
  void advance() override;

  /// @brief Reports that the clock gate was opened.
  void gateOpened() { controlRead_ = false; }

 private:
  struct Channel {
    std::uint32_t load = 0;
    std::uint32_t control = 0;
    bool flag = false;
    std::uint32_t reload = 0;    ///< value from which the channel counts at present
    std::uint64_t loadedAt = 0;  ///< if not chained: count of the bus clock at the last load
    std::uint32_t value = 0;     ///< value of a chained channel or of a stopped channel
    [[nodiscard]] bool enabled() const { return (control & 1U) != 0; }
    [[nodiscard]] bool chained() const { return (control & 4U) != 0; }
  };

  [[nodiscard]] bool counts(const Channel& channel) const;
  [[nodiscard]] std::uint64_t bus() const { return board_.busClock().count(board_.time()); }
  [[nodiscard]] std::uint32_t valueOf(const Channel& channel) const;
  void setControl(Channel& channel, std::uint32_t value);
  void setStopped(bool stopped);
  void start(Channel& channel) const;
  void expire(std::size_t index);
  void update(std::size_t index);

  std::array<Channel, 4> channels_;
  std::uint32_t control_ = 0;
  bool controlRead_ = false;
};

}  // namespace wr::emulator
