#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ports/mps2/tests/UnixLine.hpp"
#include "sim/gdb/PacketStream.hpp"

namespace wr::mps2 {

/// @brief The board MPS2 with the FPGA image AN386, as QEMU emulates it. The time of the board
/// passes only while QEMU runs. The tests control QEMU by the protocol of GDB. The first serial
/// port of the board is a socket.
class Emulator {
 public:
  /// @brief Length of a short instruction [byte].
  static constexpr std::uint32_t kShort = 2;

  /// @brief Starts QEMU. The program is stopped at its first instruction.
  /// @param elf path of the ELF file of the program
  explicit Emulator(const std::filesystem::path& elf);
  ~Emulator();
  Emulator(const Emulator&) = delete;
  Emulator& operator=(const Emulator&) = delete;

  /// @brief Runs the program until it reaches one of the given instructions. The program must not
  /// be at one of these instructions now.
  /// @param places addresses of the instructions
  /// @return address of the instruction at which the program stopped
  std::uint32_t runTo(std::initializer_list<std::uint32_t> places);

  /// @brief Sends bytes to the serial port of the board, one by one. The program reads each byte
  /// before the next byte is sent. The program must be at rest, and is at rest again when this
  /// function returns.
  /// @param bytes bytes to send
  /// @param rest address of the instruction at which the program is at rest
  void send(std::span<const std::uint8_t> bytes, std::uint32_t rest);

  /// @brief Replaces an instruction of two bytes by an instruction that does nothing.
  /// @param place address of the instruction
  void replaceByNothing(std::uint32_t place);

  /// @brief Reads a word of the memory, or a register of a device.
  [[nodiscard]] std::uint32_t word(std::uint32_t address);

  /// @brief Returns the bytes that the program has sent since the last call.
  [[nodiscard]] std::vector<std::uint8_t> takeSent();

 private:
  std::string ask(std::string_view command);
  std::string answer();

  std::filesystem::path folder_;
  pid_t process_ = 0;
  std::unique_ptr<UnixLine> control_;
  std::unique_ptr<gdb::PacketStream> packets_;
  std::unique_ptr<UnixLine> serial_;
};

}  // namespace wr::mps2
