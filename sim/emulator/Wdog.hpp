#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief The watchdog (K64P144M120SF5RM, chapter Watchdog Timer (WDOG)).
class Wdog final : public Peripheral {
 public:
  explicit Wdog(Microcontroller& board) : Peripheral(board) {}

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;
  [[nodiscard]] Time nextEvent() const override;
  void advance() override;

 private:
  enum class Lock {
    FreshlyReset,  ///< waits for the first key of the unlock
    Locked,
    Open  ///< the configuration may be written
  };

  void fail(std::string id, std::string what);
  void unlock(std::uint32_t key);
  void refresh(std::uint32_t key);
  void configure(std::uint32_t offset, std::uint32_t value);
  void close();
  void checkConfiguration();
  void restart();
  [[nodiscard]] std::uint64_t bus() const { return board_.busClock().count(board_.time()); }
  [[nodiscard]] const Clock& source() const;
  [[nodiscard]] std::uint64_t divider() const;
  [[nodiscard]] std::uint64_t timer() const;
  [[nodiscard]] std::uint32_t timeOut() const;
  [[nodiscard]] bool counts() const { return (registers_[0] & 1U) != 0; }

  std::array<std::uint16_t, 12> registers_{};
  Lock lock_ = Lock::FreshlyReset;
  std::uint64_t lockChanged_ = 0;  ///< count of the bus clock at the last change of lock_
  bool configured_ = false;
  std::uint32_t written_ = 0;  ///< registers that were written since the unlock
  std::optional<std::uint64_t> unlockKeyAt_;
  std::optional<std::uint64_t> refreshKeyAt_;
  std::uint64_t countsFrom_ = 0;  ///< count of the clock source at the last refresh
  Clock oscillator_;
  std::optional<std::uint64_t> resetAt_;  ///< count of the bus clock at the watchdog's reset
  std::uint16_t resets_ = 0;
};

}  // namespace wr::emulator
