#include "sim/programs/Program.hpp"

#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"

namespace wr::programs {

namespace {

volatile std::sig_atomic_t requested = 0;

void request(int /*signal*/) {
  requested = 1;
}

}  // namespace

SymbolicLink::SymbolicLink(std::filesystem::path path, std::filesystem::path target)
    : path_(std::move(path)), target_(std::move(target)) {
  if (path_.empty()) {
    return;
  }
  if (std::filesystem::is_symlink(path_)) {
    std::filesystem::remove(path_);
  }
  std::filesystem::create_symlink(target_, path_);
}

SymbolicLink::~SymbolicLink() {
  std::error_code error;
  // Another program may have replaced the link.
  if (!path_.empty() && std::filesystem::read_symlink(path_, error) == target_) {
    std::filesystem::remove(path_, error);
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

Exit playScenario(const std::string& file, const std::string& reports,
                  scenario::RobotSession& robot) {
  const scenario::Scenario scenario = scenario::Scenario::load(file);
  std::ofstream table;
  const auto checkTable = [&] {
    if (!reports.empty() && !table) {
      throw std::runtime_error("cannot write " + reports);
    }
  };
  if (!reports.empty()) {
    table.open(reports);
    checkTable();
  }
  const scenario::ScenarioPlayer::Outcome outcome =
      scenario::ScenarioPlayer(scenario, robot, reports.empty() ? nullptr : &table).play();
  table.flush();
  checkTable();
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

CLI::Validator greaterThanZero() {
  return {[](const std::string& text) {
            double number = 0;
            return CLI::detail::lexical_cast(text, number) && number > 0
                       ? std::string()
                       : "'" + text + "' is not a number greater than 0";
          },
          ""};
}

int runProgram(CLI::App& app, int count, char** arguments, const std::function<Exit()>& body) {
  app.footer(
      "Exit codes: 0 done, 1 an expectation failed or a file cannot be used, 2 wrong usage or a "
      "scenario that\ncannot be read, 4 the virtual board stopped with a finding.");
  Exit exit = Exit::Failed;
  try {
    app.parse(count, arguments);
    exit = body();
  } catch (const CLI::Success& shown) {
    app.exit(shown);
    exit = Exit::Done;
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "%s: %s\n%s --help explains the options.\n", app.get_name().c_str(),
                 error.what(), app.get_name().c_str());
    exit = Exit::Usage;
  } catch (const scenario::Scenario::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    exit = Exit::Usage;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    exit = Exit::Usage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return static_cast<int>(exit);
}

}  // namespace wr::programs
