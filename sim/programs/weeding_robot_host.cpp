#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>
#include <string>

#include "sim/host_robot/HostSession.hpp"
#include "sim/programs/Pace.hpp"
#include "sim/programs/Program.hpp"
#include "sim/programs/PseudoTerminal.hpp"
#include "sim/scenario/ControlChannel.hpp"

namespace wr::programs {

namespace {

// Time that the robot runs between two reads of the computer's clock.
constexpr Microseconds kSlice = milliseconds(1);
// Size of the buffer for one read of the pseudo-terminal. The program reads until no bytes wait.
constexpr std::size_t kBytes = 64;

struct Settings {
  bool paper = false;
  std::string link;
  std::string control;
  std::uint64_t cycles = 0;
  std::string scenario;
  std::string reports;
};

void addOptions(CLI::App& app, Settings& settings) {
  app.add_flag("--paper", settings.paper,
               "run the paper's design, without the safety functions [off]");
  auto* const link =
      app.add_option("--link", settings.link,
                     "create this symbolic link to the pseudo-terminal of the PC link [none]");
  auto* const control = app.add_option(
      "--control", settings.control,
      "accept actions of a scenario at this datagram socket while the robot runs [none]");
  auto* const cycles =
      app.add_option("--cycles", settings.cycles,
                     "end after this number of control cycles of 100 ms [until Ctrl-C]");
  auto* const scenario = app.add_option(
      "--scenario", settings.scenario,
      "play this scenario as fast as possible, not in real time, without PC link [none]");
  auto* const reports =
      app.add_option("--reports", settings.reports,
                     "write each report of the scenario to this file, as comma-separated values "
                     "[none]");
  for (CLI::Option* const option : {link, control, scenario, reports}) {
    option->type_name("PATH");
  }
  cycles->type_name("NUMBER")->check(greaterThanZero());
  for (CLI::Option* const option : {link, control, cycles}) {
    option->excludes(scenario);
  }
  reports->needs(scenario);
}

host::HostEquipment equipmentOf(const Settings& settings) {
  return settings.paper ? host::HostEquipment::Whole : host::HostEquipment::Safe;
}

bool hasRun(const host_robot::HostSession& robot, std::uint64_t cycles) {
  const Microseconds period = robot.world.robot.period();
  return cycles != 0 &&
         robot.world.nextPulse() > Instant() + period * static_cast<std::int64_t>(cycles);
}

// Passes the bytes of the pseudo-terminal to the robot.
void listen(SerialLine& line, host_robot::HostSession& robot) {
  std::array<std::uint8_t, kBytes> bytes{};
  for (std::size_t count = line.read(bytes); count != 0; count = line.read(bytes)) {
    robot.send(std::span(bytes).first(count));
  }
}

void runInRealTime(const Settings& settings) {
  catchEndRequests();
  PseudoTerminal line;
  host_robot::HostSession robot(equipmentOf(settings));
  scenario::ControlChannel control(settings.control, robot);
  robot.start();
  const SymbolicLink link(settings.link,
                          line.name());  // created last; everything else exists before it
  std::printf("PC link: %s\n", line.name().c_str());
  std::fflush(stdout);
  Pace pace;
  for (Instant now; !hasRun(robot, settings.cycles) && !endRequested();) {
    now = now + kSlice;
    pace.waitFor(std::chrono::microseconds(now.sinceStart()));
    listen(line, robot);
    control.serve();
    robot.world.runUntil(now);
    line.write(robot.takeSent());  // bytes are lost if no client reads them, as on a real robot
  }
  printLost(pace, stdout);
}

Exit run(const Settings& settings) {
  if (!settings.scenario.empty()) {
    host_robot::HostSession robot(equipmentOf(settings));
    robot.start();
    return playScenario(settings.scenario, settings.reports, robot);
  }
  runInRealTime(settings);
  return Exit::Done;
}

}  // namespace

}  // namespace wr::programs

int main(int count, char** arguments) try {
  wr::programs::Settings settings;
  CLI::App app(
      "Runs the firmware in the simulated robot on this computer, in real time. The PC link is a\n"
      "pseudo-terminal.",
      "weeding_robot_host");
  wr::programs::addOptions(app, settings);
  return wr::programs::runProgram(app, count, arguments,
                                  [&settings] { return wr::programs::run(settings); });
} catch (const std::exception& error) {
  std::fprintf(stderr, "weeding_robot_host: %s\n", error.what());
  return EXIT_FAILURE;
} catch (...) {
  return EXIT_FAILURE;
}
