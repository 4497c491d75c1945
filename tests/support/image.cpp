// Switches on virtual boards with the firmware image under test. With WR_GDB=PORT, the firmware
// waits for GDB at this TCP port each time a test switches a board on. If the firmware image is
// built for recordings, the calls of the firmware are recorded in the same way as on the host. Each
// test writes one file in the folder WR_TRACE_DIR (see trace.cpp). The file <suite>.<test>.bits in
// the same folder contains the executed instructions. These are the bits of ExecutedCode::bits(),
// up to the last bit that is set.

#include "support/image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/emulator/CallRecorder.hpp"
#include "sim/emulator/DebugPort.hpp"
#include "sim/emulator/ExecutedCode.hpp"
#include "sim/emulator/Image.hpp"
#include "sim/gdb/Commands.hpp"
#include "sim/programs/SerialLine.hpp"
#include "support/onlyWith.hpp"

namespace wr::test {

namespace {

emulator::CallRecorder& recorder() {
  static emulator::CallRecorder instance(elfFile());
  return instance;
}

emulator::ExecutedCode& executed() {
  static emulator::ExecutedCode instance;
  return instance;
}

/// A connection between GDB and the firmware. GDB cannot run the firmware backwards, because a
/// running test cannot be restarted.
class Debug {
 public:
  explicit Debug(const std::string& port) : line_(programs::openLine("tcp:" + port)) {}
  void begin(emulator::VirtualBoard& board) { commands_.debugger().begin(board.debugPort()); }

 private:
  std::unique_ptr<programs::SerialLine> line_;
  gdb::Commands commands_{*line_, [] { return false; }, false};
};

void debugIfAsked(emulator::VirtualBoard& board) {
  if (const char* const port = std::getenv("WR_GDB"); port != nullptr) {
    static Debug debug(port);
    debug.begin(board);
  }
}

// All recordings must belong to the same firmware image, because recordings contain addresses.
bool isRecorded() {
  return imageFile() == WR_RECORDED_IMAGE;
}

// Writes the name of the firmware image to the results of the test.
void nameInResults(const std::filesystem::path& image) {
  const std::string recorded = image == WR_RECORDED_IMAGE ? "_calls" : "";
  testing::Test::RecordProperty("image", image.stem().string() + recorded);
}

void writeBits(const std::filesystem::path& path) {
  const auto bits = executed().bits();
  const auto last =
      std::ranges::find_if(bits.rbegin(), bits.rend(), [](std::uint8_t byte) { return byte != 0; });
  std::ofstream file(path, std::ios::binary);
  std::for_each(bits.begin(), last.base(),
                [&file](std::uint8_t byte) { file.put(static_cast<char>(byte)); });
}

class Recording final : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& /*test*/) override {
    if (isRecorded() && std::filesystem::exists(elfFile())) {
      recorder().clear();
      executed().clear();
    }
  }

  void OnTestEnd(const testing::TestInfo& test) override {
    if (!isRecorded() || !std::filesystem::exists(elfFile()) || recorder().events().empty()) {
      return;
    }
    std::string name = std::string(test.test_suite_name()) + "." + test.name();
    std::ranges::replace(name, '/', '_');
    const std::filesystem::path folder = WR_TRACE_DIR;
    std::filesystem::create_directories(folder);
    recorder().write(folder / (name + ".bin"));
    writeBits(folder / (name + ".bits"));
    std::filesystem::remove(folder / (name + ".truncated"));
    if (recorder().truncated()) {
      std::ofstream(folder / (name + ".truncated"))
          << "The record ends after " << recorder().events().size() << " events.\n";
    }
  }
};

const bool registered = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new Recording);
  return true;
}();

}  // namespace

std::filesystem::path imageFile() {
  const char* const given = std::getenv("WR_IMAGE");
  return given != nullptr ? given : WR_IMAGE;
}

std::filesystem::path elfFile() {
  return imageFile().replace_extension(".elf");
}

std::unique_ptr<board_robot::BoardSession> switchBoardOn(emulator::Options options) {
  return switchBoardOn(emulator::readImage(imageFile()), std::move(options));
}

std::unique_ptr<board_robot::BoardSession> switchBoardOn(std::vector<std::uint8_t> image,
                                                         emulator::Options options) {
  options.elf = elfFile();
  // A test may change a few instructions of the firmware image to cause a fault. The size of the
  // image is then the same, and the image still counts as the image under test.
  const bool asLinked = image.size() == emulator::readImage(imageFile()).size();
  auto robot = std::make_unique<board_robot::BoardSession>(std::move(image), std::move(options));
  nameInResults(imageFile());
  debugIfAsked(robot->board);
  if (!isRecorded()) {
    return robot;
  }
  if (asLinked) {
    robot->board.noteExecuted(executed());
  }
  recorder().reset();
  robot->board.record(recorder());
  return robot;
}

std::filesystem::path imageOf(const std::string& product) {
  return imageFile().replace_filename(product + ".bin");
}

std::unique_ptr<board_robot::BoardSession> switchProductOn(const std::string& product,
                                                           std::vector<std::uint8_t> image,
                                                           emulator::Options options) {
  options.elf = imageOf(product).replace_extension(".elf");
  nameInResults(imageOf(product));
  onlyWith(product);
  auto robot = std::make_unique<board_robot::BoardSession>(std::move(image), std::move(options));
  if (!robot->board.runToSleep(std::chrono::milliseconds(50))) {
    throw std::runtime_error(product + " does not start");
  }
  return robot;
}

}  // namespace wr::test
