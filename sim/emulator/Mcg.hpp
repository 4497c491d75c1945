#pragma once

#include <cstdint>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief Clock generator with an external clock of 50 MHz at EXTAL.
/// See K64P144M120SF5RM, chapter Multipurpose Clock Generator (MCG).
class Mcg final : public Peripheral {
 public:
  static constexpr std::uint64_t kExternalHz = 50'000'000;

  /// @param externalClock true if the external clock is present
  /// @param failingStep step that is never completed. 0: no step; 2: the change to the external
  /// clock; 3: the lock of the PLL; 4: the change to the PLL
  Mcg(Microcontroller& board, bool externalClock, unsigned failingStep)
      : Peripheral(board), external_(externalClock), failingStep_(failingStep) {}

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;
  [[nodiscard]] Time nextEvent() const override;
  void advance() override;

  /// @brief Starts or stops the external clock.
  void setExternalClock(bool present);

  /// @brief Makes the PLL lose its lock.
  void loseLock();

  /// @brief Ends the failure that failingStep selects.
  void endFailure() { failingStep_ = 0; }

  /// @brief Returns the frequency of the output, MCGOUTCLK.
  [[nodiscard]] std::uint64_t outputHz() const;

 private:
  enum class Mode { Fei, Fee, Fbi, Fbe, Blpi, Blpe, Pbe, Pee, None };

  /// @brief A state that changes to the requested value after a delay.
  struct Follower {
    unsigned now = 0;
    unsigned asked = 0;
    Time due = kNever;

    void ask(unsigned value, Time when) {
      due = value == now ? kNever : (value == asked && due != kNever) ? due : when;
      asked = value;
    }
    void settle(Time time) {
      if (due <= time) {
        now = asked;
        due = kNever;
      }
    }
  };

  [[nodiscard]] Mode mode() const;
  [[nodiscard]] static bool leadsTo(Mode from, Mode to);
  [[nodiscard]] bool settled() const;
  void lockIsLost();
  void checkChange(Mode before, bool wasSettled);
  void checkFllReference();
  void checkPll();
  void follow();
  [[nodiscard]] bool pllRuns() const;
  [[nodiscard]] std::uint64_t pllReferenceHz() const;
  [[nodiscard]] std::uint64_t pllHz() const;
  [[nodiscard]] std::uint64_t fllHz() const;
  [[nodiscard]] unsigned fllDivider() const;
  [[nodiscard]] std::uint32_t status() const;

  bool external_;
  unsigned failingStep_;
  std::uint32_t c1_ = 0;
  std::uint32_t c2_ = 0;
  std::uint32_t c3_ = 0;
  std::uint32_t c4_ = 0;
  std::uint32_t c5_ = 0;
  std::uint32_t c6_ = 0;
  std::uint32_t c7_ = 0;
  std::uint32_t c8_ = 0;
  std::uint32_t sc_ = 0;
  Follower reference_;  ///< S.IREFST
  Follower source_;     ///< S.CLKST
  Follower pllChosen_;  ///< S.PLLST
  Follower locked_;     ///< S.LOCK0
  bool lostLock_ = false;
};

}  // namespace wr::emulator
