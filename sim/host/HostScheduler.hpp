#pragma once

#include <functional>
#include <vector>

namespace wr::host {

class HostThread;

/// @brief A scheduler that runs threads on the host. Their sequence is the same as on a
/// microcontroller, whose interrupt controller starts them.
///
/// If a thread has a higher priority than the running thread, it runs immediately, before
/// HostThread::pend() returns. The other threads run when the running thread ends. No thread starts
/// while an interrupt is served.
class HostScheduler {
 public:
  HostScheduler() = default;
  HostScheduler(const HostScheduler&) = delete;
  HostScheduler& operator=(const HostScheduler&) = delete;

  /// @brief Registers a thread.
  /// @param thread the thread; it must outlive the scheduler
  void add(HostThread& thread);

  /// @brief Sets the callback that runs directly before each thread.
  void beforeThread(std::function<void(const HostThread& thread)> call);

  /// @brief Runs every triggered thread that has a higher priority than the running thread.
  void dispatch();

  /// @brief Executes an interrupt. Then runs every triggered thread that has a higher priority than
  /// the running thread.
  /// @param vector function that the interrupt calls
  void interrupt(const std::function<void()>& vector);

 private:
  [[nodiscard]] HostThread* next() const;

  std::vector<HostThread*> threads_;
  std::function<void(const HostThread&)> beforeThread_;
  int runningPriority_ = 0;
  int interrupts_ = 0;
};

}  // namespace wr::host
