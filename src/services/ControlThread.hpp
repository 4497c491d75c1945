#pragma once

#include <atomic>
#include <cstdint>

#include "services/Command.hpp"

namespace wr {

/// @brief Thread that executes its command after a post. Each execution runs to its end. Meanwhile,
/// at most one further execution waits.
/// @function Moves work out of interrupt handlers: a handler posts the thread, and the platform
/// then executes the command at the priority of the thread. Counts the posts that occur before the
/// previous activation has ended.
/// @secret The form in which an activation is stored until it has run, and the rule by which
/// overlapping activations are counted.
class ControlThread {
 public:
  ControlThread(const ControlThread&) = delete;
  ControlThread& operator=(const ControlThread&) = delete;

  /// @brief Sets the command of the thread. From now on the thread can be posted.
  /// @param body command that each activation executes
  /// @pre The thread has no command yet.
  /// @errors If the thread already has a command, the assertion ThreadStartedTwice ends the
  /// program.
  /// @isr{no}
  /// @satisfies FR-172
  /// @satisfies FR-176
  void start(Command& body);

  /// @brief Requests one activation of the thread. If the previous activation has not ended, an
  /// overrun is counted, and the new activation runs after the previous activation. If another
  /// activation is already waiting, only the overrun is counted.
  /// @return false when the thread has no command: then nothing happens; otherwise true
  /// @isr{yes}
  /// @satisfies FR-4
  /// @satisfies FR-172
  bool post();

  /// @brief Returns the number of posts that occurred before the previous activation had ended.
  /// @return number of overruns since start, modulo 2^32
  /// @isr{yes}
  [[nodiscard]] std::uint32_t overruns() const;

 protected:
  ControlThread() = default;
  ~ControlThread() = default;

  /// @brief Runs one activation if an activation is waiting. If another activation is waiting after
  /// that, calls pend() again. The platform calls this function at the priority of the thread,
  /// after a call of pend().
  void run();

 private:
  /// @brief Requests a call of run(). The platform calls run() as soon as the priority of the
  /// thread permits.
  /// @isr{yes}
  virtual void pend() = 0;

  std::atomic<Command*> body_{nullptr};
  std::atomic<std::uint32_t> accepted_{0};  // number of accepted posts; only post() increments it
  std::atomic<std::uint32_t> ended_{0};     // number of ended activations; only run() increments it
  std::atomic<std::uint32_t> overruns_{0};

  static_assert(std::atomic<std::uint32_t>::is_always_lock_free,
                "an interrupt must not wait for a lock");
};

}  // namespace wr
