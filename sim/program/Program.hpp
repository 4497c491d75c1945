#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "sim/scenario/RobotLine.hpp"

namespace wr {

/// @brief Exit codes of the simulators.
enum class Exit { Done = 0, Failed = 1, Usage = 2, Found = 4 };

/// @brief The options of a command line.
class CommandLine {
 public:
  /// @brief Reads a command line. Throws std::invalid_argument for what is not known.
  /// @param count number of arguments, with the name of the program
  /// @param arguments the arguments
  /// @param withValue options that are followed by a value
  /// @param flags options that stand alone
  CommandLine(int count, char** arguments, std::initializer_list<std::string_view> withValue,
              std::initializer_list<std::string_view> flags);

  /// @brief Tells whether an option is there.
  [[nodiscard]] bool has(const std::string& option) const { return values_.contains(option); }

  /// @brief The value of an option; nothing when the option is not there.
  [[nodiscard]] std::optional<std::string> value(const std::string& option) const;

  /// @brief The value of an option that is a count. Throws std::invalid_argument when it is none.
  [[nodiscard]] std::optional<std::uint64_t> count(const std::string& option) const;

 private:
  std::map<std::string, std::string> values_;
};

/// @brief A symbolic link that lasts as long as the object. A file of another kind is not replaced.
class SymbolicLink {
 public:
  /// @brief Makes the link.
  /// @param path where; empty for no link
  /// @param target where it leads
  SymbolicLink(std::filesystem::path path, const std::filesystem::path& target);
  SymbolicLink(const SymbolicLink&) = delete;
  SymbolicLink& operator=(const SymbolicLink&) = delete;
  ~SymbolicLink();

 private:
  std::filesystem::path path_;
};

/// @brief Lets Ctrl-C and SIGTERM ask for the end of the program.
void catchEndRequests();

/// @brief Tells whether the end was asked for.
[[nodiscard]] bool endRequested();

/// @brief Plays a scenario and prints how it ended.
/// @param file the scenario
/// @param reports file that gets the reports; nothing for none
/// @param robot a robot that was just switched on
/// @return exit code of the program
[[nodiscard]] Exit playScenario(const std::string& file, const std::optional<std::string>& reports,
                                RobotLine& robot);

/// @brief Runs a program and turns what it throws into an exit code and a text.
/// @param usage text for a wrong command line
/// @param body the program
/// @return exit code for main()
int runProgram(const char* usage, Exit (*body)(int count, char** arguments), int count,
               char** arguments);

}  // namespace wr
