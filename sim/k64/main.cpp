#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>

#include "sim/host/PtySerialPort.hpp"
#include "sim/program/ControlChannel.hpp"
#include "sim/program/Program.hpp"
#include "sim/scenario/BoardLine.hpp"
#include "sim/scenario/CycleMeter.hpp"
#include "sim/scenario/EventTrace.hpp"
#include "sim/scenario/Scenario.hpp"

namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr const char* kUsage =
    "usage: weeding_robot_board --image BIN [options]\n"
    "\n"
    "Runs the image of the firmware on a virtual K64 in a simulated robot in real time. The PC\n"
    "link is a pseudo-terminal.\n"
    "\n"
    "  --image BIN      what flash holds from address 0\n"
    "  --elf ELF        names the functions in findings\n"
    "  --link PATH      make PATH a symbolic link to the pseudo-terminal\n"
    "  --control PATH   accept actions of a scenario at a datagram socket\n"
    "  --cycles N       stop after N control cycles\n"
    "  --fast           run as fast as possible, without link; needs --cycles\n"
    "  --scenario FILE  play a scenario in stepped time, without link\n"
    "  --reports FILE   write each report of the scenario to FILE, as comma-separated values\n"
    "  --bench FILE     with --scenario: measure its last 1000 cycles, write them to FILE as JSON\n"
    "  --timing MODEL   what instructions cost: no-wait-states or slow-flash\n"
    "  --profile        with --bench: count also how often each instruction is executed\n"
    "  --stack          tell how much of the stack was used\n"
    "  --trace FILE     write interrupts, resets, pins and sent bytes to FILE, with their times\n"
    "  --help           show this text\n"
    "\n"
    "Exit codes: 0 done, 1 an expectation of the scenario failed, 2 wrong usage, 4 finding.\n";

// Time between two looks at the pseudo-terminal.
constexpr milliseconds kSlice{2};
// Bytes that the line brings in a slice; what is more waits in the pseudo-terminal.
constexpr std::size_t kBytes = 23;
constexpr milliseconds kPeriod{100};

wr::Exit ended(const wr::BoardLine& robot) {
  if (const auto found = robot.finding()) {
    std::printf("finding: %s\n", found->text.c_str());
    return wr::Exit::Found;
  }
  return wr::Exit::Done;
}

// Whether so many cycles have begun, and had time to end, before the next one in the slice to come.
bool hasRun(const wr::BoardLine& robot, std::uint64_t cycles) {
  const auto& pulses = robot.pulses();
  return cycles == 0 ||
         (pulses.size() >= cycles &&
          robot.board.now() >= pulses[cycles - 1] + kPeriod - milliseconds(1) - kSlice);
}

wr::Exit runFast(wr::BoardLine& robot, std::uint64_t cycles) {
  wr::catchEndRequests();
  while (!wr::endRequested() && !hasRun(robot, cycles)) {
    if (!robot.board.runUntil(robot.board.now() + kSlice)) {
      break;
    }
  }
  return ended(robot);
}

wr::Exit runInRealTime(wr::BoardLine& robot, const wr::CommandLine& options) {
  wr::catchEndRequests();
  wr::PtySerialPort port;
  const wr::SymbolicLink link(options.value("--link").value_or(""), port.path());
  wr::ControlChannel control(options.value("--control").value_or(""), robot);
  const std::optional<std::uint64_t> cycles = options.count("--cycles");
  std::printf("PC link: %s\n", port.path().c_str());
  std::fflush(stdout);
  const auto start = std::chrono::steady_clock::now();
  std::array<std::uint8_t, kBytes> bytes{};
  while (!wr::endRequested() && !(cycles && hasRun(robot, *cycles))) {
    for (std::size_t count = port.read(bytes); count != 0; count = port.read(bytes)) {
      robot.send(std::span(bytes).first(count));
    }
    if (!robot.board.runUntil(robot.board.now() + kSlice)) {
      break;
    }
    control.serve();
    port.write(robot.takeSent());  // what nobody reads is lost, as on a line
    std::this_thread::sleep_until(start + robot.board.now());
  }
  return ended(robot);
}

// Plays the scenario and measures its last cycles; one more than these must have begun.
wr::Exit runBench(wr::BoardLine& robot, const std::string& scenario, const std::string& file,
                  bool profiled) {
  const auto end = wr::Scenario::load(scenario).end();
  const auto measured = kPeriod * (wr::CycleMeter::kCycles + 1);
  if (end < measured) {
    throw std::invalid_argument(scenario + " is shorter than what is measured");
  }
  const auto meter = std::make_unique<wr::CycleMeter>(robot, end - measured, profiled);
  const wr::Exit exit = wr::playScenario(scenario, std::nullopt, robot);
  std::ofstream output;
  output.exceptions(std::ios::failbit | std::ios::badbit);
  output.open(file);
  meter->write(output);
  return exit;
}

wr::Exit runAsAsked(wr::BoardLine& robot, const wr::CommandLine& options) {
  if (const auto file = options.value("--bench")) {
    return runBench(robot, options.value("--scenario").value(), *file, options.has("--profile"));
  }
  if (const auto scenario = options.value("--scenario")) {
    return wr::playScenario(*scenario, options.value("--reports"), robot);
  }
  if (options.has("--fast")) {
    return runFast(robot, options.count("--cycles").value());
  }
  return runInRealTime(robot, options);
}

wr::k64::Timing timingOf(const wr::CommandLine& options) {
  const std::string name = options.value("--timing").value_or("no-wait-states");
  if (name == "slow-flash") {
    return wr::k64::Timing::SlowFlash;
  }
  if (name != "no-wait-states") {
    throw std::invalid_argument("there is no timing " + name);
  }
  return wr::k64::Timing::NoWaitStates;
}

wr::Exit run(int count, char** arguments) {
  const wr::CommandLine options(count, arguments,
                                {"--image", "--elf", "--link", "--control", "--cycles",
                                 "--scenario", "--reports", "--trace", "--bench", "--timing"},
                                {"--fast", "--profile", "--stack", "--help"});
  if (options.has("--help")) {
    std::fputs(kUsage, stdout);
    return wr::Exit::Done;
  }
  if (!options.has("--image")) {
    throw std::invalid_argument("--image is missing");
  }
  if (options.has("--fast") && !options.count("--cycles")) {
    throw std::invalid_argument("--fast needs --cycles");
  }
  if (options.has("--bench") && (!options.has("--scenario") || options.has("--trace"))) {
    throw std::invalid_argument("--bench needs --scenario, and goes without --trace");
  }
  std::ofstream file;
  std::optional<wr::EventTrace> trace;
  if (const auto path = options.value("--trace")) {
    file.exceptions(std::ios::failbit | std::ios::badbit);
    file.open(*path);
    trace.emplace(&file);
  }
  wr::BoardLine robot(wr::readImage(*options.value("--image")),
                      {.elf = options.value("--elf").value_or(""), .timing = timingOf(options)});
  if (trace) {
    robot.onEvent([&](const wr::k64::Event& event) { trace->add(event); });
  }
  const std::uint32_t top = robot.board.word(0);  // the first vector: the stack begins there
  std::uint32_t lowest = top;
  if (options.has("--stack")) {
    robot.board.noteStack(lowest);
  }
  const wr::Exit exit = runAsAsked(robot, options);
  if (options.has("--stack")) {
    std::printf("stack: %u bytes\n", static_cast<unsigned>(top - lowest));
  }
  if (trace) {
    std::printf("trace: %llu events, hash %016llx\n",
                static_cast<unsigned long long>(trace->events()),
                static_cast<unsigned long long>(trace->hash()));
  }
  return exit;
}

}  // namespace

int main(int count, char** arguments) {
  return wr::runProgram(kUsage, run, count, arguments);
}
