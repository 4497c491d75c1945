#include "sim/program/Program.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"

namespace wr {

namespace {

volatile std::sig_atomic_t requested = 0;

void request(int /*signal*/) {
  requested = 1;
}

}  // namespace

CommandLine::CommandLine(int count, char** arguments,
                         std::initializer_list<std::string_view> withValue,
                         std::initializer_list<std::string_view> flags) {
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    if (std::ranges::find(flags, argument) != flags.end()) {
      values_[argument] = "";
    } else if (std::ranges::find(withValue, argument) != withValue.end() && i + 1 < count) {
      ++i;
      values_[argument] = arguments[i];
    } else {
      throw std::invalid_argument("unknown option, or option without value: " + argument);
    }
  }
}

std::optional<std::string> CommandLine::value(const std::string& option) const {
  const auto found = values_.find(option);
  return found != values_.end() ? std::optional(found->second) : std::nullopt;
}

std::optional<std::uint64_t> CommandLine::count(const std::string& option) const {
  const std::optional<std::string> text = value(option);
  if (!text) {
    return std::nullopt;
  }
  if (text->empty() || text->find_first_not_of("0123456789") != std::string::npos) {
    throw std::invalid_argument(option + " needs a number: " + *text);
  }
  return std::stoull(*text);
}

SymbolicLink::SymbolicLink(std::filesystem::path path, const std::filesystem::path& target)
    : path_(std::move(path)) {
  if (path_.empty()) {
    return;
  }
  if (std::filesystem::is_symlink(path_)) {
    std::filesystem::remove(path_);
  }
  std::filesystem::create_symlink(target, path_);
}

SymbolicLink::~SymbolicLink() {
  std::error_code ignored;
  if (!path_.empty()) {
    std::filesystem::remove(path_, ignored);
  }
}

void catchEndRequests() {
  struct sigaction action {};
  action.sa_handler = request;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool endRequested() {
  return requested != 0;
}

Exit playScenario(const std::string& file, const std::optional<std::string>& reports,
                  RobotLine& robot) {
  const Scenario scenario = Scenario::load(file);
  std::ofstream table;
  if (reports) {
    table.exceptions(std::ios::failbit | std::ios::badbit);
    table.open(*reports);
  }
  const ScenarioPlayer::Outcome outcome =
      ScenarioPlayer(scenario, robot, reports ? &table : nullptr).play();
  for (const std::string& failure : outcome.failures) {
    std::fprintf(stderr, "%s\n", failure.c_str());
  }
  std::printf("%s: %llu reports, %zu failures\n", file.c_str(),
              static_cast<unsigned long long>(outcome.reports), outcome.failures.size());
  if (outcome.finding) {
    std::printf("finding: %s\n", outcome.finding->text.c_str());
    return Exit::Found;
  }
  return outcome.failures.empty() ? Exit::Done : Exit::Failed;
}

int runProgram(const char* usage, Exit (*body)(int count, char** arguments), int count,
               char** arguments) {
  const auto code = [](Exit exit) { return static_cast<int>(exit); };
  try {
    return code(body(count, arguments));
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n%s", error.what(), usage);
    return code(Exit::Usage);
  } catch (const Scenario::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return code(Exit::Usage);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return code(Exit::Failed);
  }
}

}  // namespace wr
