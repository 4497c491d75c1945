#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/emulator/Clock.hpp"
#include "sim/emulator/Event.hpp"

namespace wr::emulator {

/// @brief The interface of the microcontroller for its peripherals.
class Microcontroller {
 public:
  Microcontroller(const Microcontroller&) = delete;
  Microcontroller& operator=(const Microcontroller&) = delete;

  [[nodiscard]] virtual Time time() const = 0;
  [[nodiscard]] virtual const Clock& coreClock() const = 0;
  [[nodiscard]] virtual const Clock& busClock() const = 0;

  /// @brief Sets the level of an interrupt line.
  virtual void setLine(unsigned line, bool high) = 0;

  /// @brief Raises the non-maskable interrupt.
  virtual void raiseNmi() = 0;

  /// @brief Reports that the source or the divider of a clock has changed.
  virtual void clocksChanged() = 0;

  /// @brief Stops the run with a finding.
  virtual void report(std::string id, std::string what) = 0;

  /// @brief Rejects the present access with a bus fault.
  virtual void refuse(std::string id, std::string what) = 0;

  /// @brief Resets the microcontroller, or stops the run with a finding if resets are findings.
  virtual void requestReset(Reset cause, std::string id, std::string what) = 0;

  /// @brief Reports an event.
  virtual void tell(Event::Kind kind, std::uint32_t number, std::uint32_t value) = 0;

 protected:
  Microcontroller() = default;
  ~Microcontroller() = default;
};

/// @brief A block of registers, and the behaviour of these registers.
class Peripheral {
 public:
  Peripheral(const Peripheral&) = delete;
  Peripheral& operator=(const Peripheral&) = delete;
  virtual ~Peripheral() = default;

  /// @brief Sets the state after a reset.
  virtual void reset(Reset cause) = 0;

  /// @brief Reads a register.
  /// @param offset offset from the base address of the block
  /// @param size 1, 2 or 4 bytes
  virtual std::uint32_t read(std::uint32_t offset, unsigned size) = 0;

  /// @brief Returns true if reading a register has a side effect. A debugger must not read such a
  /// register.
  /// @param offset offset from the base address of the block
  [[nodiscard]] virtual bool readHasEffect(std::uint32_t offset) const {
    static_cast<void>(offset);
    return false;
  }

  /// @brief Writes a register.
  virtual void write(std::uint32_t offset, unsigned size, std::uint32_t value) = 0;

  /// @brief Returns the time of the next event that occurs without an access. Returns kNever when
  /// there is no such event.
  [[nodiscard]] virtual Time nextEvent() const { return kNever; }

  /// @brief Updates the state to the present time.
  virtual void advance() {}

  /// @brief Returns the result of nextEvent() at the last call of renewDue().
  [[nodiscard]] Time due() const { return due_; }

  /// @brief Updates due(). The board calls this function after each change that may affect the next
  /// event.
  void renewDue() { due_ = nextEvent(); }

 protected:
  explicit Peripheral(Microcontroller& board) : board_(board) {}

  /// @brief Reports an access to a register that the model does not have.
  void unmodelled(std::string_view block, std::uint32_t offset);

  /// @brief Reports an access whose size differs from the size of the register.
  /// @return true when the size is right.
  bool hasSize(std::string_view block, std::uint32_t offset, unsigned size, unsigned right);

  /// @brief Reports a use that the manual forbids.
  void misuse(std::string what) { board_.report("register-misuse", std::move(what)); }

  Microcontroller& board_;

 private:
  Time due_ = kNever;
};

}  // namespace wr::emulator
