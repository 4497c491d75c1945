#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"
#include "sim/board_robot/CallTimeline.hpp"
#include "sim/board_robot/CycleMeter.hpp"
#include "sim/emulator/EventTrace.hpp"
#include "sim/emulator/Image.hpp"
#include "sim/emulator/VirtualBoard.hpp"
#include "sim/gdb/Commands.hpp"
#include "sim/gdb/RepeatedLine.hpp"
#include "sim/programs/Pace.hpp"
#include "sim/programs/Program.hpp"
#include "sim/programs/SerialLine.hpp"
#include "sim/programs/signals.hpp"
#include "sim/scenario/ControlChannel.hpp"
#include "sim/scenario/Scenario.hpp"

namespace wr::programs {

namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// Time between two reads of the serial line of UART0.
constexpr milliseconds kSlice{2};
// Size of the buffer for one read of the serial line. The program reads until no bytes wait.
constexpr std::size_t kBytes = 64;
constexpr milliseconds kPeriod{100};
constexpr double kNanoseconds = 1e9;

struct Settings {
  std::string image;
  std::string elf;
  std::string uart = "pty";
  std::string link;
  double seconds = 0;
  std::uint64_t cycles = 0;
  std::string timing = "no-wait-states";
  std::string unmodelled = "stop";
  std::vector<AnalogSignal> analog;
  std::vector<DigitalSignal> levels;
  std::string control;
  std::string scenario;
  std::string reports;
  std::string trace;
  std::string bench;
  std::string calls;
  std::vector<double> window;
  std::uint32_t baud = 115'200;
  std::uint32_t gdb = 0;
  bool debugs = false;
  bool fast = false;
  bool resets = false;
  bool faults = false;
  bool robot = false;
  bool stack = false;
  bool profile = false;
};

void addImageOptions(CLI::App& app, Settings& settings) {
  const std::string group = "Image";
  app.add_option(
         "--image", settings.image,
         "file with the content of the flash from address 0, as arm-none-eabi-objcopy -O binary "
         "makes it")
      ->required()
      ->type_name("PATH")
      ->group(group);
  app.add_option("--elf", settings.elf,
                 "ELF file with symbols; findings then contain function, file and line [none]")
      ->type_name("PATH")
      ->check(CLI::ExistingFile)
      ->group(group);
  app.add_option(
         "--timing", settings.timing,
         "model of the cycles of an instruction: no-wait-states or slow-flash [no-wait-states]")
      ->type_name("MODEL")
      ->check(CLI::IsMember({"no-wait-states", "slow-flash"}))
      ->group(group);
  app.add_option("--unmodelled", settings.unmodelled,
                 "action at an access that is not modelled: stop with a finding, or warn and "
                 "continue; a load "
                 "then returns 0, a store has no effect [stop]")
      ->type_name("stop|warn")
      ->check(CLI::IsMember({"stop", "warn"}))
      ->group(group);
  app.add_flag("--resets", settings.resets,
               "continue after a reset that the program causes; without this option the "
               "reset is a finding")
      ->group(group);
  app.add_flag("--faults", settings.faults,
               "pass faults to the handlers of the program; without this option a fault is a "
               "finding")
      ->group(group);
}

void addLineOptions(CLI::App& app, Settings& settings) {
  const std::string group = "UART0 and pins";
  app.add_option("--uart0", settings.uart,
                 "connection of UART0: pty, stdout (only sends), or tcp:PORT at 127.0.0.1, with "
                 "PORT 0 for a "
                 "free port [pty]")
      ->type_name("LINE")
      ->check(CLI::Validator(
          [](const std::string& kind) {
            return isLineKind(kind) ? "" : kind + " is not pty, stdout or tcp:PORT";
          },
          ""))
      ->group(group);
  app.add_option("--baud", settings.baud, "baud rate of the connected device [115200 Bd]")
      ->type_name("BAUD")
      ->check(greaterThanZero())
      ->group(group);
  app.add_option("--link", settings.link, "create this symbolic link to the pseudo-terminal [none]")
      ->type_name("PATH")
      ->group(group);
  app.add_option_function<std::vector<std::string>>(
         "--analog",
         [&settings](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             settings.analog.push_back(analogSignalOf(text));
           }
         },
         "voltage at a converter's input, e.g. ADC0_SE12=1.65 for 1.65 V [0 V]; may be repeated")
      ->type_name("INPUT=VOLTS")
      ->group(group);
  app.add_option_function<std::vector<std::string>>(
         "--level",
         [&settings](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             settings.levels.push_back(digitalSignalOf(text));
           }
         },
         "level that is applied to a pin from outside the board, e.g. PTC6=0 [open]; may be "
         "repeated")
      ->type_name("PIN=0|1")
      ->group(group);
}

void addRunOptions(CLI::App& app, Settings& settings) {
  const std::string group = "Run";
  app.add_option("--seconds", settings.seconds,
                 "end after this time of the board in s [until Ctrl-C]")
      ->type_name("S")
      ->check(greaterThanZero())
      ->group(group);
  app.add_flag("--fast", settings.fast,
               "run as fast as possible, not in real time; needs --seconds or --cycles")
      ->group(group);
  app.add_option("--trace", settings.trace,
                 "write interrupts, resets, pins and sent bytes to this file, with times in ns "
                 "[none]")
      ->type_name("PATH")
      ->group(group);
  app.add_flag("--stack", settings.stack, "print the greatest use of the stack in bytes")
      ->group(group);
}

void addRobotOptions(CLI::App& app, Settings& settings) {
  const std::string group =
      "Simulated robot (each of these options connects the board with the robot)";
  app.add_flag("--robot", settings.robot, "connect the pins with the simulated robot [bare board]")
      ->group(group);
  app.add_option("--control", settings.control,
                 "accept actions of a scenario at this datagram socket while the robot runs [none]")
      ->type_name("PATH")
      ->group(group);
  app.add_option("--cycles", settings.cycles,
                 "end after this number of control cycles of 100 ms [until Ctrl-C]")
      ->type_name("NUMBER")
      ->check(greaterThanZero())
      ->group(group);
  CLI::Option* const scenario = app.add_option(
      "--scenario", settings.scenario,
      "play this scenario as fast as possible, not in real time, without PC link [none]");
  CLI::Option* const reports = app.add_option(
      "--reports", settings.reports,
      "write each report of the scenario to this file, as comma-separated values [none]");
  CLI::Option* const bench =
      app.add_option("--bench", settings.bench,
                     "measure the last 1000 control cycles of the scenario, and write the results "
                     "to this file as JSON [none]");
  CLI::Option* const calls = app.add_option(
      "--calls", settings.calls,
      "write the calls, interrupts, bytes and outputs of a part of the scenario to this file, with "
      "times in ns; needs --elf and --between [none]");
  CLI::Option* const window =
      app.add_option("--between", settings.window,
                     "with --calls: begin and end of the part, in ms since power-on")
          ->expected(2)
          ->type_name("MS")
          ->group(group);
  for (CLI::Option* const option : {scenario, reports, bench, calls}) {
    option->type_name("PATH")->group(group);
  }
  for (const char* name : {"--control", "--cycles", "--seconds", "--fast", "--link", "--uart0"}) {
    scenario->excludes(app.get_option(name));
  }
  reports->needs(scenario);
  bench->needs(scenario)->excludes(app.get_option("--trace"));
  window->needs(calls);
  calls->needs(scenario)->needs(window)->needs(app.get_option("--elf"));
  calls->excludes(bench)->excludes(app.get_option("--trace"));
  app.add_flag("--profile", settings.profile,
               "with --bench: count the executions of each instruction")
      ->needs(bench)
      ->group(group);
}

void addDebugOption(CLI::App& app, Settings& settings) {
  CLI::Option* const gdb =
      app.add_option("--gdb", settings.gdb,
                     "wait for GDB at this TCP port of 127.0.0.1, before the first instruction; 0 "
                     "for a free port [none]")
          ->type_name("PORT")
          ->check(CLI::Range(0, 65'535))
          ->each([&settings](const std::string&) { settings.debugs = true; })
          ->group("Debugger");
  for (const char* name : {"--control", "--trace", "--bench", "--calls", "--stack"}) {
    gdb->excludes(app.get_option(name));
  }
}

void checkTogether(const Settings& settings) {
  if (settings.fast && settings.seconds == 0 && settings.cycles == 0) {
    throw CLI::ValidationError("--fast", "needs --seconds or --cycles");
  }
  if (!settings.link.empty() && settings.uart != "pty") {
    throw CLI::ValidationError("--link", "needs --uart0 pty");
  }
}

emulator::Options boardOptions(const Settings& settings) {
  return {.elf = settings.elf,
          .resetsAreFindings = !settings.resets,
          .timing = settings.timing == "slow-flash" ? emulator::Timing::SlowFlash
                                                    : emulator::Timing::NoWaitStates,
          .faultsAreFindings = !settings.faults,
          .unmodelledIsFinding = settings.unmodelled == "stop"};
}

/// @brief The running board, without a robot or connected to the simulated robot.
class Machine {
 public:
  explicit Machine(const Settings& settings) {
    std::vector<std::uint8_t> image = emulator::readImage(settings.image);
    if (settings.robot || !settings.control.empty() || settings.cycles != 0 ||
        !settings.scenario.empty()) {
      robot_.emplace(std::move(image), boardOptions(settings));
    } else {
      alone_.emplace(std::move(image), boardOptions(settings));
    }
    board().setLineBaud(settings.baud);
    for (const AnalogSignal& signal : settings.analog) {
      board().setAnalog(signal.converter, signal.channel, signal.volts);
    }
    for (const DigitalSignal& signal : settings.levels) {
      board().drive(signal.port, signal.pin, signal.level);
    }
  }

  [[nodiscard]] emulator::VirtualBoard& board() { return robot_ ? robot_->board : *alone_; }
  [[nodiscard]] board_robot::BoardSession* robot() { return robot_ ? &*robot_ : nullptr; }

  void onEvent(std::function<void(const emulator::Event&)> call) {
    robot_ ? robot_->onEvent(std::move(call)) : alone_->onEvent(std::move(call));
  }

 private:
  std::optional<board_robot::BoardSession> robot_;
  std::optional<emulator::VirtualBoard> alone_;
};

// Returns true if the run is complete. If the user chose a time, the run is complete when this time
// has passed. If the user chose a number of cycles, the run is complete shortly before the clock
// pulse that ends its last cycle: at most kSlice plus 1 ms earlier.
bool hasRun(Machine& machine, const Settings& settings) {
  const nanoseconds now = machine.board().now();
  if (settings.seconds != 0 &&
      static_cast<double>(now.count()) >= settings.seconds * kNanoseconds) {
    return true;
  }
  if (settings.cycles == 0) {
    return false;
  }
  const auto& pulses = machine.robot()->pulses();
  return pulses.size() >= settings.cycles &&
         now >= pulses[settings.cycles - 1] + kPeriod - milliseconds(1) - kSlice;
}

void printWarnings(emulator::VirtualBoard& board) {
  for (const emulator::Finding& warning : board.takeWarnings()) {
    std::fprintf(stderr, "warning: %s\n", emulator::textOf(warning).c_str());
  }
}

void exchangeBytes(SerialLine& line, emulator::VirtualBoard& board) {
  std::array<std::uint8_t, kBytes> bytes{};
  for (std::size_t count = line.read(bytes); count != 0; count = line.read(bytes)) {
    board.receive(std::span(bytes).first(count));
  }
  line.write(board.takeSent());  // bytes are lost if no client reads them, as on a real board
}

// Returns the stream for messages. Messages must not be mixed with the bytes of UART0.
std::FILE* messagesOf(const Settings& settings) {
  return settings.uart == "stdout" ? stderr : stdout;
}

/// @brief The serial line of UART0, and the pace of a run. When a debugger restarts the run, the
/// new run uses the same serial line and the same pace.
class Outside {
 public:
  explicit Outside(const Settings& settings) {
    // A scenario needs no serial line, because the scenario plays the PC. With --fast, there is no
    // pseudo-terminal, because a client would be too slow for the board.
    if (settings.scenario.empty() && !(settings.fast && settings.uart == "pty")) {
      opened_ = openLine(settings.uart);
    }
    if (opened_ && settings.debugs) {
      repeated_ = std::make_unique<gdb::RepeatedLine>(std::move(opened_));
    }
  }

  [[nodiscard]] SerialLine* line() { return repeated_ ? repeated_.get() : opened_.get(); }

  void beginAgain() {
    if (repeated_) {
      repeated_->beginAgain();
    }
  }

  /// @brief Creates the symbolic link and prints the name of the serial line. Further calls do
  /// nothing.
  void announce(const Settings& settings, bool robot) {
    if (line() == nullptr || link_) {
      return;
    }
    link_.emplace(settings.link, line()->name());
    std::fprintf(messagesOf(settings), "%s: %s\n", robot ? "PC link" : "UART0",
                 line()->name().c_str());
    std::fflush(messagesOf(settings));
  }

  Pace pace;
  gdb::Commands* debugs = nullptr;  ///< null without a debugger

 private:
  std::unique_ptr<SerialLine> opened_;
  std::unique_ptr<gdb::RepeatedLine> repeated_;
  std::optional<SymbolicLink> link_;
};

Exit runBoard(Machine& machine, const Settings& settings, Outside& outside) {
  catchEndRequests();
  emulator::VirtualBoard& board = machine.board();
  SerialLine* const line = outside.line();
  std::optional<scenario::ControlChannel> control;
  if (!settings.control.empty()) {
    control.emplace(settings.control, *machine.robot());
  }
  outside.announce(
      settings,
      machine.robot() !=
          nullptr);  // the symbolic link is created last; everything else exists before it
  Pace& pace = outside.pace;
  bool runs = true;
  while (runs && !endRequested() && !hasRun(machine, settings)) {
    runs = board.runUntil(board.now() + kSlice);
    if (line) {
      exchangeBytes(*line, board);
    }
    if (control) {
      control->serve();
    }
    if (outside.debugs != nullptr) {
      outside.debugs->glance();
    }
    printWarnings(board);
    if (!settings.fast) {
      pace.waitFor(board.now());
    }
  }
  if (!settings.debugs) {
    printLost(pace, messagesOf(settings));
  }
  if (board.finding()) {
    std::fprintf(messagesOf(settings), "finding: %s\n", emulator::textOf(*board.finding()).c_str());
    return Exit::Found;
  }
  return Exit::Done;
}

// Plays the scenario and measures its last cycles. There must be at least one cycle before the
// measured cycles.
Exit runBench(board_robot::BoardSession& robot, const Settings& settings) {
  const auto end = scenario::Scenario::load(settings.scenario).end();
  const auto measured = kPeriod * (board_robot::CycleMeter::kCycles + 1);
  if (end < measured) {
    throw CLI::ValidationError(
        "--bench", settings.scenario + " is shorter than 1001 cycles; use a longer scenario");
  }
  const auto meter =
      std::make_unique<board_robot::CycleMeter>(robot, end - measured, settings.profile);
  const Exit exit = playScenario(settings.scenario, "", robot);
  std::ofstream output;
  output.exceptions(std::ios::failbit | std::ios::badbit);
  output.open(settings.bench);
  meter->write(output);
  return exit;
}

Exit runRecorded(board_robot::BoardSession& robot, const Settings& settings) {
  std::ofstream output;
  output.exceptions(std::ios::failbit | std::ios::badbit);
  output.open(settings.calls);
  const auto instant = [](double ms) {
    return std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double, std::milli>(ms));
  };
  const board_robot::CallTimeline timeline(
      robot, settings.elf,
      {.from = instant(settings.window.front()), .to = instant(settings.window.back())}, output);
  const Exit exit = playScenario(settings.scenario, settings.reports, robot);
  output.flush();
  return exit;
}

Exit runAsAsked(Machine& machine, const Settings& settings, Outside& outside) {
  if (!settings.bench.empty()) {
    return runBench(*machine.robot(), settings);
  }
  if (!settings.calls.empty()) {
    return runRecorded(*machine.robot(), settings);
  }
  if (!settings.scenario.empty()) {
    const Exit exit = playScenario(settings.scenario, settings.reports, *machine.robot());
    printWarnings(machine.board());
    return exit;
  }
  return runBoard(machine, settings, outside);
}

// Runs the board under a debugger. When the debugger steps back in time, starts another run of the
// board from the beginning.
Exit runDebugged(const Settings& settings) {
  catchEndRequests();
  const std::unique_ptr<SerialLine> door = openLine("tcp:" + std::to_string(settings.gdb));
  std::fprintf(messagesOf(settings), "GDB: %s\n", door->name().c_str());
  std::fflush(messagesOf(settings));
  gdb::Commands commands(*door, endRequested);
  Outside outside(settings);
  outside.debugs = &commands;
  while (true) {
    Machine machine(settings);
    outside.beginAgain();
    commands.debugger().begin(machine.board().debugPort());
    try {
      const Exit exit = runAsAsked(machine, settings, outside);
      if (endRequested()) {
        return exit;
      }
      constexpr const char* kFinding = "0b";  // GDB shows a finding as a segmentation fault
      commands.debugger().end(exit == Exit::Found ? kFinding : "05replaylog:end;");
      return exit;
    } catch (const gdb::BeginsAgain&) {
      continue;
    } catch (const gdb::Killed&) {
      return Exit::Done;
    }
  }
}

Exit run(const Settings& settings) {
  checkTogether(settings);
  if (settings.debugs) {
    return runDebugged(settings);
  }
  std::ofstream file;
  std::optional<emulator::EventTrace> trace;
  if (!settings.trace.empty()) {
    file.exceptions(std::ios::failbit | std::ios::badbit);
    file.open(settings.trace);
    trace.emplace(&file);
  }
  Machine machine(settings);
  if (trace) {
    machine.onEvent([&](const emulator::Event& event) { trace->add(event); });
  }
  const std::uint32_t top = machine.board().word(0);  // the first vector is the initial stack
                                                      // pointer
  std::uint32_t lowest = top;
  if (settings.stack) {
    machine.board().noteStack(lowest);
  }
  Outside outside(settings);
  const Exit exit = runAsAsked(machine, settings, outside);
  if (settings.stack) {
    std::fprintf(messagesOf(settings), "stack: %u bytes\n", static_cast<unsigned>(top - lowest));
  }
  if (trace) {
    std::fprintf(messagesOf(settings), "trace: %llu events, hash %016llx\n",
                 static_cast<unsigned long long>(trace->events()),
                 static_cast<unsigned long long>(trace->hash()));
  }
  return exit;
}

}  // namespace

}  // namespace wr::programs

int main(int count, char** arguments) try {
  wr::programs::Settings settings;
  CLI::App app(
      "Runs a raw firmware image for a K64 (MK64FN1M0) on the virtual board, in real time. The\n"
      "board runs without a robot, or connected to the simulated robot. The run stops at the "
      "first\n"
      "finding.",
      "weeding_robot_board");
  wr::programs::addImageOptions(app, settings);
  wr::programs::addLineOptions(app, settings);
  wr::programs::addRunOptions(app, settings);
  wr::programs::addRobotOptions(app, settings);
  wr::programs::addDebugOption(app, settings);
  return wr::programs::runProgram(app, count, arguments,
                                  [&settings] { return wr::programs::run(settings); });
} catch (const std::exception& error) {
  std::fprintf(stderr, "weeding_robot_board: %s\n", error.what());
  return EXIT_FAILURE;
} catch (...) {
  return EXIT_FAILURE;
}
