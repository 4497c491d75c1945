#pragma once

#include "services/ControlThread.hpp"

namespace wr::host {

class HostScheduler;

/// @brief A control thread on the host.
class HostThread final : public ControlThread {
 public:
  /// @brief Adds the thread to the scheduler.
  /// @param scheduler runs the thread
  /// @param priority priority of the thread; 1 is the lowest priority
  HostThread(HostScheduler& scheduler, int priority);

  /// @brief Returns true if an activation is pending.
  /// @return true from post() to runPended().
  [[nodiscard]] bool pended() const;

  /// @brief Returns the priority of the thread.
  /// @return priority; 1 is the lowest priority.
  [[nodiscard]] int priority() const;

  /// @brief Runs one activation. The scheduler calls this function.
  void runPended();

 private:
  void pend() override;

  HostScheduler& scheduler_;
  int priority_;
  bool pended_ = false;
};

}  // namespace wr::host
