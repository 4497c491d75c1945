#pragma once

#include "services/Command.hpp"

namespace wr::test {

/// @brief A command that counts its executions.
class CountingCommand final : public Command {
 public:
  void execute() override { ++executions; }

  int executions = 0;
};

}  // namespace wr::test
