#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/emulator/Symbols.hpp"
#include "sim/emulator/VirtualBoard.hpp"

namespace wr::test {

/// The content of the flash: the programs of the folder guest, and vectors that start one of these
/// programs.
class Guest {
 public:
  /// @param program name of the function that starts at reset
  explicit Guest(const std::string& program) : symbols_(elf()) {
    std::ifstream file(WR_GUEST_PROGRAM, std::ios::binary);
    const std::vector<std::uint8_t> code{std::istreambuf_iterator<char>(file), {}};
    image_.assign(kCode, 0xFF);
    for (unsigned exception = 2; exception < 16 + 86; ++exception) {
      setWord(4 * exception, 0);
    }
    image_.insert(image_.end(), code.begin(), code.end());
    setWord(0, 0x20008000);
    handle(1, program);
  }

  /// Sets the function that handles an exception.
  Guest& handle(unsigned exception, const std::string& function) {
    setWord(4 * exception, addressOf(function) | 1U);
    return *this;
  }

  /// Sets the function that handles an interrupt.
  Guest& handleLine(unsigned line, const std::string& function) {
    return handle(16 + line, function);
  }

  [[nodiscard]] std::uint32_t addressOf(const std::string& function) const {
    const std::uint32_t address = symbols_.addressOf(function);
    if (address == 0) {
      throw std::runtime_error("there is no function " + function);
    }
    return address;
  }

  [[nodiscard]] const std::vector<std::uint8_t>& image() const { return image_; }

  [[nodiscard]] static std::filesystem::path elf() {
    return std::filesystem::path(WR_GUEST_PROGRAM).replace_extension(".elf");
  }

 private:
  static constexpr std::size_t kCode = 0x410;

  void setWord(std::size_t address, std::uint32_t value) {
    for (unsigned i = 0; i < 4; ++i) {
      image_[address + i] = static_cast<std::uint8_t>(value >> 8 * i);
    }
  }

  emulator::Symbols symbols_;
  std::vector<std::uint8_t> image_;
};

/// Returns a result that a program has reported to its test.
inline std::uint32_t reported(const emulator::VirtualBoard& board, unsigned number) {
  return board.word(0x20000000 + 4 * number);
}

/// Returns the numbers that a program has recorded.
inline std::vector<std::uint32_t> notes(const emulator::VirtualBoard& board) {
  std::vector<std::uint32_t> numbers(board.word(0x20000100));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = board.word(static_cast<std::uint32_t>(0x20000104 + 4 * i));
  }
  return numbers;
}

}  // namespace wr::test
