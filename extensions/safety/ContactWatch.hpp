#pragma once

#include <atomic>
#include <cstdint>

#include "devices/EdgeInput.hpp"

namespace wr {

/// @brief A detector of the openings of a contact. It also detects openings that are shorter than a
/// control cycle.
///
/// @function Samples the contact at each tick. Records an opening that lasts for three successive
/// ticks, unless a control cycle has already found the contact open. The record remains until a
/// control cycle reads it.
///
/// @secret The time for which a contact must be open until the opening counts, and the form in
/// which an opening is recorded.
class ContactWatch final {
 public:
  /// @param contact input that is high while the contact is open
  explicit ContactWatch(const EdgeInput& contact);

  ContactWatch(const ContactWatch&) = delete;
  ContactWatch& operator=(const ContactWatch&) = delete;

  /// @brief Reads the contact. Records an opening if the contact was open at three successive
  /// ticks. If the last call of opened() reported an opening, the tick does not record the same
  /// opening again. The handler of each tick calls this function.
  /// @satisfies FR-271
  /// @isr{yes}
  void sample();

  /// @brief Checks whether the contact is open now, or whether an opening was recorded since the
  /// last call of this method. Two openings with less than 2 ms between them can count as one.
  /// @return true if the contact is open now, or if an opening was recorded.
  /// @satisfies FR-271
  /// @satisfies FR-291
  /// @isr{no}
  [[nodiscard]] bool opened();

 private:
  const EdgeInput& contact_;
  std::uint8_t openTicks_ = 0;  // number of successive ticks with an open contact, at most 3
  std::atomic<bool> latched_{false};
  std::atomic<bool> closed_{true};  // the contact was closed at or after the last call of opened()

  static_assert(std::atomic<bool>::is_always_lock_free, "an interrupt must not wait for a lock");
};

}  // namespace wr
