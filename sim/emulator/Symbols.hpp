#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace wr::emulator {

/// @brief The functions of a firmware image, read from the symbol table of its ELF file.
class Symbols {
 public:
  struct Function {
    std::uint32_t address;  ///< address without the bit that marks Thumb code
    std::uint32_t size;
    std::string name;  ///< name as the linker wrote it
  };

  /// @brief Reads a little-endian 32-bit ELF file. Throws std::runtime_error when this fails.
  explicit Symbols(const std::filesystem::path& elf);

  /// @brief Returns all functions, in the order of their addresses.
  [[nodiscard]] const std::vector<Function>& functions() const { return functions_; }

  /// @brief Returns the demangled name of the function at an address; empty when there is no
  /// function.
  [[nodiscard]] std::string nameAt(std::uint32_t address) const;

  /// @brief Returns the address of a symbol of any kind; 0 when there is no such symbol.
  [[nodiscard]] std::uint32_t addressOf(const std::string& name) const;

  /// @brief Returns the source file and line of an instruction. Calls the program
  /// arm-none-eabi-addr2line. The result is empty when this program is not installed, or when the
  /// source line is unknown.
  [[nodiscard]] std::string placeOf(std::uint32_t address) const;

 private:
  std::filesystem::path elf_;
  std::vector<Function> functions_;
  std::vector<Function> objects_;
};

}  // namespace wr::emulator
