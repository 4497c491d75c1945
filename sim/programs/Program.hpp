#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>

#include "sim/scenario/RobotSession.hpp"

namespace wr::programs {

/// @brief Exit codes of the simulators.
enum class Exit { Done = 0, Failed = 1, Usage = 2, Found = 4 };

/// @brief A symbolic link that exists as long as the object. It replaces an old symbolic link, but
/// no other file.
class SymbolicLink {
 public:
  /// @brief Creates the link.
  /// @param path path of the link; empty for no link
  /// @param target target of the link
  SymbolicLink(std::filesystem::path path, std::filesystem::path target);
  SymbolicLink(const SymbolicLink&) = delete;
  SymbolicLink& operator=(const SymbolicLink&) = delete;
  ~SymbolicLink();

 private:
  std::filesystem::path path_;
  std::filesystem::path target_;
};

/// @brief Registers handlers for Ctrl-C and SIGTERM. Both signals request the end of the program.
void catchEndRequests();

/// @brief Checks whether the end of the program was requested.
[[nodiscard]] bool endRequested();

/// @brief Plays a scenario and prints its result.
/// @param file the scenario
/// @param reports file for the reports; empty to write no file
/// @param robot a robot that was just switched on
/// @return exit code of the program
[[nodiscard]] Exit playScenario(const std::string& file, const std::string& reports,
                                scenario::RobotSession& robot);

/// @brief Returns a validator for an option whose number must be greater than 0.
[[nodiscard]] CLI::Validator greaterThanZero();

/// @brief Reads the command line, runs a program, and turns errors into an exit code and a text.
/// @param app options of the program
/// @param count number of arguments, including the name of the program
/// @param arguments the arguments
/// @param body the program; it throws CLI::ParseError for options that cannot be combined
/// @return exit code for main()
int runProgram(CLI::App& app, int count, char** arguments, const std::function<Exit()>& body);

}  // namespace wr::programs
