// The functions of the WebAssembly module that the page calls. Texts and bytes are in the memory of
// the module.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/GroundTruth.hpp"
#include "sim/web/LiveRobot.hpp"
#include "sim/web/module/thrown.hpp"

namespace {

using wr::web::LiveRobot;
using Bytes = std::vector<std::uint8_t>;

enum class Text { Thrown, Failures, Finding, Names, Reports };

struct Module {
  std::unique_ptr<LiveRobot> robot;
  std::vector<double> numbers;
  Bytes bytes;  // result of the last call that returns bytes
};

Module& module() {
  static Module instance;
  return instance;
}

constexpr std::string_view kNames =
    "time_ms,instructions,resets,pulses,reports,failures,cycle_us,awake_us,clock_hz";

std::string namesOfNumbers() {
  std::string names(kNames);
  for (const wr::scenario::TruthField& field : wr::scenario::truthFields()) {
    names += ',' + std::string(field.name);
  }
  return names;
}

std::string textOf(Text which) {
  const LiveRobot* robot = module().robot.get();
  switch (which) {
    case Text::Thrown:
      return std::string(wr::web::thrownText());
    case Text::Names:
      return namesOfNumbers();
    case Text::Reports:
      return robot->reports();
    case Text::Finding: {
      const auto finding = robot->session().finding();
      return finding ? finding->text : std::string();
    }
    case Text::Failures: {
      std::string lines;
      for (const std::string& failure : robot->player().outcome().failures) {
        lines += failure + '\n';
      }
      return lines;
    }
  }
  return {};
}

template <typename Number>
void append(Bytes& bytes, Number number) {
  for (std::size_t byte = 0; byte < sizeof number; ++byte) {
    bytes.push_back(static_cast<std::uint8_t>(number >> (8 * byte)));
  }
}

}  // namespace

extern "C" {

/// Returns new memory for an argument of a later call.
std::uint8_t* liveAlloc(std::size_t size) {
  return static_cast<std::uint8_t*>(std::malloc(size));
}

void liveFree(std::uint8_t* memory) {
  std::free(memory);
}

/// Switches a robot on. If bit 0 of the options is set, the run continues after a reset. If bit 1
/// is set, all events and reports are recorded.
void liveStart(const std::uint8_t* image, std::size_t imageSize, const std::uint32_t* functions,
               std::size_t functionCount, const char* scenario, std::size_t scenarioSize,
               unsigned options) {
  module().robot.reset();
  LiveRobot::Setup setup{.image = Bytes(image, image + imageSize),
                         .functions = {functions, functions + functionCount},
                         .scenario = std::string(scenario, scenarioSize),
                         .name = "scenario",
                         .resetsAreFindings = (options & 1U) == 0,
                         .verifies = (options & 2U) != 0};
  module().robot = std::make_unique<LiveRobot>(std::move(setup));
}

/// Runs until a control cycle has ended. The run ends earlier at the end of the scenario, at a
/// finding, or after 200 ms without a clock pulse. Returns 0 if the run continues, 1 if the
/// scenario has ended, 2 if a finding has stopped the run.
int liveCycle() {
  return static_cast<int>(module().robot->runCycle());
}

/// Runs to the end of the scenario, or until a finding stops the board.
int liveRunToEnd() {
  return static_cast<int>(module().robot->runToEnd());
}

void livePerform(const char* action, std::size_t size) {
  module().robot->perform(std::string(action, size));
}

void liveRepeat(const char* order, std::size_t size) {
  module().robot->repeat(std::string(order, size));
}

/// Returns the present values. Text::Names contains their names.
const double* liveNumbers() {
  LiveRobot& robot = *module().robot;
  const wr::emulator::VirtualBoard& board = robot.session().board;
  const double microsecond = static_cast<double>(board.clockHz()) / 1e6;
  const LiveRobot::Cycle& cycle = robot.cycle();
  std::vector<double>& numbers = module().numbers;
  numbers = {static_cast<double>(board.now().count()) / 1e6,
             static_cast<double>(board.instructions()),
             static_cast<double>(board.resets()),
             static_cast<double>(robot.session().pulses().size()),
             static_cast<double>(robot.player().outcome().reports),
             static_cast<double>(robot.player().outcome().failures.size()),
             microsecond > 0 ? static_cast<double>(cycle.cycles) / microsecond : 0,
             microsecond > 0 ? static_cast<double>(cycle.awake) / microsecond : 0,
             static_cast<double>(board.clockHz())};
  for (const double value : robot.truth()) {
    numbers.push_back(value);
  }
  return numbers.data();
}

/// Stores a text. liveBytes() and liveSize() return the text and its length.
void liveText(int which) {
  const std::string text = textOf(static_cast<Text>(which));
  module().bytes.assign(text.begin(), text.end());
}

/// Stores the last report.
void liveReport() {
  module().bytes = module().robot->player().report().value_or(Bytes());
}

/// Stores the bytes that the PC and the robot have sent since the last call of this function. Each
/// piece has its time in us (8 bytes), its sender (1: the PC), its length (4 bytes) and its bytes.
void liveLine() {
  Bytes& bytes = module().bytes;
  bytes.clear();
  for (const auto& piece : module().robot->takePieces()) {
    append(bytes, static_cast<std::uint64_t>(piece.at.count()));
    append(bytes, static_cast<std::uint8_t>(piece.fromPc ? 1 : 0));
    append(bytes, static_cast<std::uint32_t>(piece.bytes.size()));
    bytes.insert(bytes.end(), piece.bytes.begin(), piece.bytes.end());
  }
}

const std::uint8_t* liveBytes() {
  return module().bytes.data();
}

std::size_t liveSize() {
  return module().bytes.size();
}

/// Returns the calls of the last control cycle.
const std::uint32_t* liveCalls() {
  return module().robot->cycle().calls.data();
}

std::size_t liveCallCount() {
  return module().robot->cycle().calls.size();
}

/// Stores the entries and exits of interrupts and threads in the last control cycle. Each item has
/// three numbers: the exception (2 bytes), 1 for an entry or 0 for an exit (1 byte), and the time
/// since the start of the cycle in ns (4 bytes).
void liveSwitches() {
  Bytes& bytes = module().bytes;
  bytes.clear();
  for (const LiveRobot::Switch& one : module().robot->cycle().switches) {
    append(bytes, static_cast<std::uint16_t>(one.exception));
    append(bytes, static_cast<std::uint8_t>(one.entered ? 1 : 0));
    append(bytes, one.at);
  }
}

std::uint32_t liveCallsHash() {
  return module().robot->cycle().hash;
}

/// Returns the number of calls of each function since the start.
const std::uint32_t* liveEntries() {
  return module().robot->entries().data();
}

/// Stores the last call of each function. Each item has the time of the call in ns (8 bytes; -1:
/// not called yet) and the core registers 0 to 3 at the beginning of the call (4 bytes each).
void liveLastCalls() {
  Bytes& bytes = module().bytes;
  bytes.clear();
  for (const LiveRobot::LastCall& call : module().robot->cycle().lastCalls) {
    append(bytes, static_cast<std::uint64_t>(call.at.count()));
    for (const std::uint32_t value : call.registers) {
      append(bytes, value);
    }
  }
}

/// Returns the hash of the events of the board. liveEventCount() returns the number of events.
std::uint64_t liveEventHash() {
  return module().robot->events().hash();
}

double liveEventCount() {
  return static_cast<double>(module().robot->events().events());
}
}
