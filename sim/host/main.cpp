#include <cstdint>
#include <cstdio>
#include <optional>

#include "sim/host/HostTimebase.hpp"
#include "sim/host/HostWorld.hpp"
#include "sim/host/PtySerialPort.hpp"
#include "sim/program/Program.hpp"
#include "sim/scenario/HostLine.hpp"

namespace {

constexpr const char* kUsage =
    "usage: weeding_robot_host [options]\n"
    "\n"
    "Runs the firmware in a simulated robot on this machine in real time. The PC link is a\n"
    "pseudo-terminal.\n"
    "\n"
    "  --paper         run the paper's design, without the safety functions\n"
    "  --link PATH      make PATH a symbolic link to the pseudo-terminal\n"
    "  --cycles N       stop after N control cycles\n"
    "  --scenario FILE  play a scenario in stepped time, without link\n"
    "  --reports FILE   write each report of the scenario to FILE, as comma-separated values\n"
    "  --help           show this text\n"
    "\n"
    "Exit codes: 0 done, 1 an expectation of the scenario failed, 2 wrong usage.\n";

// Time that the robot runs without a look at the clock of the machine.
constexpr wr::Microseconds kSlice = wr::milliseconds(1);

wr::HostEquipment equipmentOf(const wr::CommandLine& options) {
  return options.has("--paper") ? wr::HostEquipment::Whole : wr::HostEquipment::Safe;
}

bool hasRun(const wr::HostWorld& world, const std::optional<std::uint64_t>& cycles,
            wr::Microseconds period) {
  return cycles && world.nextPulse() > wr::Instant() + period * static_cast<std::int64_t>(*cycles);
}

void runInRealTime(const wr::CommandLine& options) {
  wr::catchEndRequests();
  wr::PtySerialPort port;
  const wr::SymbolicLink link(options.value("--link").value_or(""), port.path());
  const std::optional<std::uint64_t> cycles = options.count("--cycles");
  std::printf("PC link: %s\n", port.path().c_str());
  std::fflush(stdout);
  const wr::RealTimebase clock;
  wr::HostWorld world(port, equipmentOf(options));
  world.start();
  const wr::Microseconds period = world.robot.period();
  for (wr::Instant now; !hasRun(world, cycles, period) && !wr::endRequested();) {
    now = now + kSlice;
    while (!wr::endRequested() && clock.now() < now) {
      clock.sleepUntil(now);
    }
    world.runUntil(now);
  }
}

wr::Exit run(int count, char** arguments) {
  const wr::CommandLine options(count, arguments, {"--link", "--cycles", "--scenario", "--reports"},
                                {"--help", "--paper"});
  if (options.has("--help")) {
    std::fputs(kUsage, stdout);
    return wr::Exit::Done;
  }
  if (const auto scenario = options.value("--scenario")) {
    wr::HostLine robot(equipmentOf(options));
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
