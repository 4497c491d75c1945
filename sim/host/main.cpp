#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>

#include "sim/host/HostTimebase.hpp"
#include "sim/host/PtySerialPort.hpp"
#include "sim/program/ControlChannel.hpp"
#include "sim/program/Program.hpp"
#include "sim/scenario/HostLine.hpp"

namespace {

constexpr const char* kUsage =
    "usage: weeding_robot_host [options]\n"
    "\n"
    "Runs the firmware in a simulated robot on this machine in real time. The PC link is a\n"
    "pseudo-terminal.\n"
    "\n"
    "  --paper          run the paper's design, without the safety functions\n"
    "  --link PATH      make PATH a symbolic link to the pseudo-terminal\n"
    "  --control PATH   accept actions of a scenario at a datagram socket\n"
    "  --cycles N       stop after N control cycles\n"
    "  --scenario FILE  play a scenario in stepped time, without link\n"
    "  --reports FILE   write each report of the scenario to FILE, as comma-separated values\n"
    "  --help           show this text\n"
    "\n"
    "Exit codes: 0 done, 1 an expectation of the scenario failed, 2 wrong usage.\n";

// Time that the robot runs without a look at the clock of the machine.
constexpr wr::Microseconds kSlice = wr::milliseconds(1);
// Bytes that the line brings in a look at the pseudo-terminal; more bytes wait there.
constexpr std::size_t kBytes = 64;

wr::HostEquipment equipmentOf(const wr::CommandLine& options) {
  return options.has("--paper") ? wr::HostEquipment::Whole : wr::HostEquipment::Safe;
}

bool hasRun(const wr::HostLine& robot, const std::optional<std::uint64_t>& cycles) {
  const wr::Microseconds period = robot.world.robot.period();
  return cycles &&
         robot.world.nextPulse() > wr::Instant() + period * static_cast<std::int64_t>(*cycles);
}

// Brings the bytes of the pseudo-terminal to the robot.
void listen(wr::PtySerialPort& port, wr::HostLine& robot) {
  std::array<std::uint8_t, kBytes> bytes{};
  for (std::size_t count = port.read(bytes); count != 0; count = port.read(bytes)) {
    robot.send(std::span(bytes).first(count));
  }
}

void runInRealTime(const wr::CommandLine& options) {
  wr::catchEndRequests();
  wr::PtySerialPort port;
  const wr::SymbolicLink link(options.value("--link").value_or(""), port.path());
  const std::optional<std::uint64_t> cycles = options.count("--cycles");
  std::printf("PC link: %s\n", port.path().c_str());
  std::fflush(stdout);
  const wr::RealTimebase clock;
  wr::HostLine robot(equipmentOf(options));
  wr::ControlChannel control(options.value("--control").value_or(""), robot);
  robot.start();
  for (wr::Instant now; !hasRun(robot, cycles) && !wr::endRequested();) {
    now = now + kSlice;
    while (!wr::endRequested() && clock.now() < now) {
      clock.sleepUntil(now);
    }
    listen(port, robot);
    control.serve();
    robot.world.runUntil(now);
    port.write(robot.takeSent());  // bytes that nobody reads are lost, as on a line
  }
}

wr::Exit run(int count, char** arguments) {
  const wr::CommandLine options(count, arguments,
                                {"--link", "--control", "--cycles", "--scenario", "--reports"},
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
