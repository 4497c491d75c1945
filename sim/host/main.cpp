#include <cstdint>
#include <cstdio>
#include <optional>

#include "sim/host/HostRobot.hpp"
#include "sim/host/HostTimebase.hpp"
#include "sim/host/PtySerialPort.hpp"
#include "sim/program/Program.hpp"
#include "sim/scenario/HostLine.hpp"

namespace {

constexpr const char* kUsage =
    "usage: weeding_robot_host [options]\n"
    "\n"
    "Runs the firmware on this machine in real time. The PC link is a pseudo-terminal.\n"
    "\n"
    "  --link PATH      make PATH a symbolic link to the pseudo-terminal\n"
    "  --cycles N       stop after N control cycles\n"
    "  --scenario FILE  play a scenario in stepped time, without link\n"
    "  --reports FILE   write each report of the scenario to FILE, as comma-separated values\n"
    "  --help           show this text\n"
    "\n"
    "Exit codes: 0 done, 1 an expectation of the scenario failed, 2 wrong usage.\n";

void runInRealTime(const wr::CommandLine& options) {
  wr::catchEndRequests();
  wr::PtySerialPort port;
  const wr::SymbolicLink link(options.value("--link").value_or(""), port.path());
  const std::optional<std::uint64_t> cycles = options.count("--cycles");
  std::printf("PC link: %s\n", port.path().c_str());
  std::fflush(stdout);
  const wr::RealTimebase timebase;
  wr::HostRobot robot(timebase, port);
  robot.start();
  wr::Instant pulse = timebase.now();
  for (std::uint64_t cycle = 0; !cycles || cycle < *cycles; ++cycle) {
    pulse = pulse + robot.period();
    while (!wr::endRequested() && timebase.now() < pulse) {
      timebase.sleepUntil(pulse);
    }
    if (wr::endRequested()) {
      return;
    }
    robot.clockPulse();
  }
}

wr::Exit run(int count, char** arguments) {
  const wr::CommandLine options(count, arguments, {"--link", "--cycles", "--scenario", "--reports"},
                                {"--help"});
  if (options.has("--help")) {
    std::fputs(kUsage, stdout);
    return wr::Exit::Done;
  }
  if (const auto scenario = options.value("--scenario")) {
    wr::HostLine robot;
    robot.start();
    return wr::playScenario(*scenario, options.value("--reports"), robot);
  }
  runInRealTime(options);
  return wr::Exit::Done;
}

}  // namespace

int main(int count, char** arguments) {
  return wr::runProgram(kUsage, run, count, arguments);
}
