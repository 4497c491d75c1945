#pragma once

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"
#include "sim/emulator/Image.hpp"
#include "sim/emulator/VirtualBoard.hpp"

namespace wr::test {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// The program of program/drivers.cpp on the virtual K64. This program uses each driver separately.
/// A finding of the board fails the test.
class DriverBoard {
 public:
  explicit DriverBoard(emulator::Options options = {})
      : board(emulator::readImage(WR_DRIVERS_PROGRAM), std::move(options)) {}
  DriverBoard(const DriverBoard&) = delete;
  DriverBoard& operator=(const DriverBoard&) = delete;
  ~DriverBoard() { EXPECT_FALSE(board.finding()) << text(); }

  /// Runs the board for a duration.
  void run(nanoseconds duration) { ASSERT_TRUE(board.runUntil(board.now() + duration)) << text(); }

  /// Runs the start of the program.
  void startUp() { run(milliseconds(15)); }

  /// Sends an order, and reads the numbers of the answer.
  std::vector<std::uint16_t> ask(char order, std::uint8_t first = 0, std::int16_t second = 0) {
    const auto number = static_cast<std::uint16_t>(second);
    std::vector<std::uint8_t> line{static_cast<std::uint8_t>(order)};
    for (const unsigned byte : {unsigned{first}, number & 0xFFU, unsigned{number} >> 8U}) {
      line.push_back(static_cast<std::uint8_t>('A' + (byte >> 4U)));
      line.push_back(static_cast<std::uint8_t>('A' + (byte & 0xFU)));
    }
    board.receive(line);
    run(milliseconds(6));
    const std::vector<std::uint8_t> bytes = board.takeSent();
    std::vector<std::uint16_t> numbers;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
      numbers.push_back(static_cast<std::uint16_t>(bytes[i] | bytes[i + 1] << 8U));
    }
    return numbers;
  }

  emulator::VirtualBoard board;

 private:
  [[nodiscard]] std::string text() const {
    return board.finding() ? board.finding()->id + ": " + board.finding()->what : "";
  }
};

}  // namespace wr::test
