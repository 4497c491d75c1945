#pragma once

#include "services/Command.hpp"

namespace wr::test {

/// @brief Command that counts how often it was executed.
class CountingCommand final : public Command {
 public:
  void execute() override { ++executions; }

  int executions = 0;
};

}  // namespace wr::test
