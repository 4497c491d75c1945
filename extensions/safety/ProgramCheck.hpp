#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace wr {

/// @brief A check that finds a changed bit of the program in RAM.
///
/// @function While the processor is idle, adds up the words of the program in RAM, a few words at a
/// time. Compares the sum with the sum of the original words in flash. Ends the program if the two
/// sums differ. The next start then copies the original to RAM again.
///
/// @secret The method by which a change of the program is found, and the longest duration of the
/// search.
class ProgramCheck final {
 public:
  /// @brief Four words. The size of each section of the program is a multiple of this size.
  using Words = std::array<std::uint32_t, 4>;

  /// @brief A section of the program, and its original.
  /// @datatype
  struct Part {
    std::span<const Words> original;  ///< words in flash
    std::span<const Words> copy;      ///< words in RAM; the same number as in flash
  };

  /// @param parts sections of the program: at least one section, and no empty section. This array
  /// must exist as long as the check
  explicit ProgramCheck(std::span<const Part> parts) : parts_(parts) {}

  ProgramCheck(const ProgramCheck&) = delete;
  ProgramCheck& operator=(const ProgramCheck&) = delete;

  /// @brief Permits the next call of step() to add words to the sum. The handler of each tick calls
  /// this function.
  /// @satisfies FR-309
  /// @isr{yes}
  void tick() { due_.store(true, std::memory_order_relaxed); }

  /// @brief Adds the next words in RAM to the sum, at most once in each tick. In the first pass,
  /// also adds up the original words in the flash. Compares the two sums at the end of each pass.
  /// The idle program calls this function after each interrupt.
  /// @errors If the two sums differ, the program ends with the assertion ProgramChanged.
  /// @satisfies FR-309
  /// @isr{no}
  void step();

 private:
  static_assert(std::atomic<bool>::is_always_lock_free, "an interrupt must not wait for a lock");

  std::span<const Part> parts_;
  std::atomic<bool> due_{false};
  bool originalKnown_ = false;
  std::uint32_t original_ = 0;  // sum of the words in flash
  std::uint32_t sum_ = 0;       // sum of the words in RAM that this pass has read
  std::size_t part_ = 0;
  std::size_t next_ = 0;  // index of the next four words in their section
};

}  // namespace wr
