#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace wr::emulator {

/// @brief A recorder of the entries and exits of the functions of a firmware image. If an interrupt
/// makes the same calls as an earlier interrupt, the later calls are not recorded.
///
/// write() creates a file with one little-endian 64-bit number for each entry and each exit. The
/// number is the address of the function. For an exit, bit 63 is also set. The traces of the tests
/// on the host have the same format, and also contain numbers with bit 62 for repeated calls.
class CallRecorder {
 public:
  /// @brief Records the calls of all functions in an ELF file.
  /// @param elf ELF file of the firmware image, with its symbols
  /// @param most maximum number of recorded events
  explicit CallRecorder(const std::filesystem::path& elf, std::size_t most = 30000);

  /// @brief Records the calls of the given functions.
  /// @param functions addresses of the functions
  /// @param most maximum number of recorded events
  CallRecorder(std::vector<std::uint32_t> functions, std::size_t most);

  /// @brief Reports the beginning of a block of instructions.
  void block(std::uint32_t address, std::uint32_t stack, std::uint32_t link);

  /// @brief Reports that an exception was entered, and that its handler begins.
  void exceptionEntered(std::uint32_t handler, std::uint32_t stack);

  /// @brief Reports that an exception was left.
  void exceptionLeft();

  /// @brief Reports that the processor was reset. No function is active after a reset.
  void reset();

  /// @brief Clears the events. A function stays active if it was entered, but not left.
  void clear();

  /// @brief Sets the callback for each function that is entered or left. The callback also receives
  /// the events that are not recorded.
  void onCall(std::function<void(std::uint32_t function, bool left)> call) {
    call_ = std::move(call);
  }

  /// @brief Returns the events, oldest first.
  [[nodiscard]] const std::vector<std::uint64_t>& events() const { return events_; }

  /// @brief Returns true if some events were not recorded because the maximum number was reached.
  [[nodiscard]] bool truncated() const { return truncated_; }

  /// @brief Writes the events to a file.
  void write(const std::filesystem::path& file) const;

 private:
  struct Call {
    std::uint32_t function = 0;
    std::uint32_t returnsTo = 0;  ///< return address; 0 for the handler of an exception
    std::uint32_t stack = 0;
    std::size_t begin = 0;  ///< number of events before the call
  };

  void enter(const Call& call);
  void leave();
  void forgetRepeated(std::size_t begin);
  void note(std::uint64_t event);

  std::function<void(std::uint32_t, bool)> call_;
  std::vector<std::uint32_t> functions_;  ///< sorted addresses
  std::vector<Call> calls_;
  std::vector<std::uint64_t> events_;
  std::set<std::vector<std::uint64_t>> handled_;  ///< sequences of calls in interrupts
  std::size_t most_;
  bool truncated_ = false;
};

}  // namespace wr::emulator
