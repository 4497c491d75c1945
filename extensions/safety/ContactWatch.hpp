#pragma once

#include <atomic>
#include <cstdint>

#include "devices/EdgeInput.hpp"

namespace wr {

/// @brief Detects a contact that opens for less than a control cycle.
///
/// @function Samples the contact at each tick. Latches an opening that lasts three successive
/// ticks, until the control cycle reads it.
///
/// @secret How long a contact must be open until the opening counts, and how an opening is latched.
class ContactWatch final {
 public:
  /// @brief Binds the watch to its contact.
  /// @param contact the contact; a high level means that it is open
  explicit ContactWatch(const EdgeInput& contact);

  ContactWatch(const ContactWatch&) = delete;
  ContactWatch& operator=(const ContactWatch&) = delete;

  /// @brief Samples the contact. Each tick calls this function.
  /// @satisfies FR-271
  /// @isr{yes}
  void sample();

  /// @brief Checks whether the contact is open, and clears an earlier opening.
  /// @return true if it is open now.
  /// @post The record of an earlier opening is cleared.
  /// @satisfies FR-291
  /// @isr{no}
  [[nodiscard]] bool open();

  /// @brief Checks whether the contact is open now or was open since the last call of this method
  /// or of open().
  /// @return true if it is open, or was open at three successive ticks.
  /// @satisfies FR-271
  /// @isr{no}
  [[nodiscard]] bool opened();

 private:
  const EdgeInput& contact_;
  std::uint8_t openTicks_ = 0;  // successive ticks up to now
  std::atomic<bool> latched_{false};

  static_assert(std::atomic<bool>::is_always_lock_free, "an interrupt cannot wait for a lock");
};

}  // namespace wr
