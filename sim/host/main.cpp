#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "sim/host/HostRobot.hpp"
#include "sim/host/HostTimebase.hpp"
#include "sim/host/PtySerialPort.hpp"

namespace {

constexpr const char* kUsage =
    "usage: weeding_robot_host [options]\n"
    "\n"
    "Runs the firmware on this machine in real time. The PC link is a pseudo-terminal.\n"
    "\n"
    "  --link PATH   make PATH a symbolic link to the pseudo-terminal\n"
    "  --cycles N    stop after N control cycles\n"
    "  --help        show this text\n";

struct Options {
  std::string link;
  std::optional<std::uint64_t> cycles;
};

volatile std::sig_atomic_t endRequested = 0;

void requestEnd(int /*signal*/) {
  endRequested = 1;
}

std::uint64_t parseCount(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) {
    throw std::invalid_argument("not a number of cycles: " + text);
  }
  return std::stoull(text);
}

// Empty when only the help was asked for.
std::optional<Options> parse(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string_view argument = arguments[i];
    if (argument == "--help") {
      return std::nullopt;
    }
    if (i + 1 == count || (argument != "--link" && argument != "--cycles")) {
      throw std::invalid_argument("unknown option, or option without value: " +
                                  std::string(argument));
    }
    ++i;
    if (argument == "--link") {
      options.link = arguments[i];
    } else {
      options.cycles = parseCount(arguments[i]);
    }
  }
  return options;
}

// A symbolic link that lasts as long as the object. A file of another kind is not replaced.
class Link {
 public:
  Link(std::string path, const std::string& target) : path_(std::move(path)) {
    if (!path_.empty()) {
      if (std::filesystem::is_symlink(path_)) {
        std::filesystem::remove(path_);
      }
      std::filesystem::create_symlink(target, path_);
    }
  }
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  ~Link() {
    std::error_code ignored;
    if (!path_.empty()) {
      std::filesystem::remove(path_, ignored);
    }
  }

 private:
  std::string path_;
};

void catchSignals() {
  struct sigaction action {};
  action.sa_handler = requestEnd;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void run(const Options& options) {
  catchSignals();
  wr::PtySerialPort port;
  const Link link(options.link, port.path());
  std::printf("PC link: %s\n", port.path().c_str());
  std::fflush(stdout);
  const wr::RealTimebase timebase;
  wr::HostRobot robot(timebase, port);
  robot.start();
  wr::Instant pulse = timebase.now();
  for (std::uint64_t cycle = 0; !options.cycles || cycle < *options.cycles; ++cycle) {
    pulse = pulse + robot.period();
    while (endRequested == 0 && timebase.now() < pulse) {
      timebase.sleepUntil(pulse);
    }
    if (endRequested != 0) {
      return;
    }
    robot.clockPulse();
  }
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const std::optional<Options> options = parse(count, arguments);
    if (options) {
      run(*options);
    } else {
      std::fputs(kUsage, stdout);
    }
    return EXIT_SUCCESS;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n%s", error.what(), kUsage);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
