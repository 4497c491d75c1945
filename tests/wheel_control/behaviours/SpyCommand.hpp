#pragma once

#include <string>
#include <utility>
#include <vector>

#include "wheel_control/commands/WheelCommand.hpp"

namespace wr::test {

/// The executions of several commands, in sequence. An entry has the name of the command and its
/// voltage.
using CommandLog = std::vector<std::pair<std::string, int>>;

/// A command that records its executions.
class SpyCommand final : public WheelCommand {
 public:
  SpyCommand(std::string name, CommandLog& log) : name_(std::move(name)), log_(log) {}

  void execute(Tension tension) override { log_.emplace_back(name_, tension.count()); }

 private:
  std::string name_;
  CommandLog& log_;
};

/// The three commands of a wheel, which record their executions.
class SpiedCommands {
 public:
  CommandLog log;
  SpyCommand setTension{"tension", log};
  SpyCommand stopWheel{"stop", log};
  SpyCommand setOrientation{"orientation", log};
};

}  // namespace wr::test
