#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace wr {

/// @brief Finds a bit of the program that has changed.
///
/// @function Compares the sum of the program in RAM with the sum of its original, a few words at a
/// time, while the processor is idle. When they differ, it ends the program, and the next start
/// copies the original again.
///
/// @secret How a change of the program is found, and how long the search may last.
class ProgramCheck final {
 public:
  /// @brief Words that are added together: the core loads four words with one instruction.
  using Words = std::array<std::uint32_t, 4>;

  /// @brief A part of the program.
  /// @datatype
  struct Part {
    std::span<const Words> original;  ///< words in flash
    std::span<const Words> copy;      ///< words in RAM, as many as in the original
  };

  /// @brief Binds the check to the parts of the program.
  /// @param parts parts of the program, at least one; each is not empty and exists as long as the check
  explicit ProgramCheck(std::span<const Part> parts) : parts_(parts) {}

  ProgramCheck(const ProgramCheck&) = delete;
  ProgramCheck& operator=(const ProgramCheck&) = delete;

  /// @brief Permits one step. Each tick calls this function.
  /// @satisfies FR-309
  /// @isr{yes}
  void tick() { due_.store(true, std::memory_order_relaxed); }

  /// @brief Once in a tick, adds up the next words of the copies. In the first pass, also adds up
  /// the words of the originals. The loop that waits for interrupts calls this function after each
  /// interrupt.
  /// @errors Copies that differ from their originals end the program with the assertion
  /// ProgramChanged.
  /// @satisfies FR-309
  /// @isr{no}
  void step();

 private:
  static_assert(std::atomic<bool>::is_always_lock_free, "an interrupt cannot wait for a lock");

  std::span<const Part> parts_;
  std::atomic<bool> due_{false};
  bool originalKnown_ = false;
  std::uint32_t original_ = 0;  // sum of the originals
  std::uint32_t sum_ = 0;       // sum of the copies up to now
  std::size_t part_ = 0;
  std::size_t next_ = 0;  // index of the next word in its part
};

}  // namespace wr
