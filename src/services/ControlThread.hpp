#pragma once

#include <atomic>
#include <cstdint>

#include "services/Command.hpp"

namespace wr {

/// @brief A body that runs to its end each time the thread is posted.
/// @function Moves work out of interrupts: an interrupt posts the thread, and the platform runs the
/// body at the priority of the thread. Counts activations that came too early.
/// @secret How an activation is stored until the body has run, and how activations that overlap are
/// counted.
class ControlThread {
 public:
  ControlThread(const ControlThread&) = delete;
  ControlThread& operator=(const ControlThread&) = delete;

  /// @brief Sets the body of the thread. From now on the thread can be posted.
  /// @param body command that each activation executes
  /// @pre The thread has no body yet.
  /// @errors Assertion ThreadStartedTwice when the thread has a body.
  /// @isr{no}
  /// @satisfies FR-172
  /// @satisfies FR-176
  void start(Command& body);

  /// @brief Requests one activation of the body. When the previous activation has not ended, an
  /// overrun is counted; the new activation follows it, unless another activation is already
  /// pending.
  /// @return false when the thread has no body: nothing happens
  /// @isr{yes}
  /// @satisfies FR-4
  /// @satisfies FR-172
  bool post();

  /// @brief Returns the number of times that the thread was posted before the last activation had
  /// ended.
  /// @return number of overruns since start, at most 65535
  /// @isr{yes}
  [[nodiscard]] std::uint16_t overruns() const;

 protected:
  ControlThread() = default;
  ~ControlThread() = default;

  /// @brief Runs one activation, and triggers the thread again when another activation is pending.
  /// The platform calls this function at the priority of the thread, after a call of pend().
  /// Without a pending activation it does nothing.
  void run();

 private:
  /// @brief Requests that the platform calls run() as soon as the priority of the thread permits.
  /// @isr{yes}
  virtual void pend() = 0;

  std::atomic<Command*> body_{nullptr};
  std::atomic<std::uint32_t> accepted_{0};  // number of activations, incremented only by posts
  std::atomic<std::uint32_t> ended_{0};     // number of activations, incremented only by run()
  std::atomic<std::uint32_t> overruns_{0};

  static_assert(std::atomic<std::uint32_t>::is_always_lock_free,
                "an interrupt cannot wait for a lock");
};

}  // namespace wr
