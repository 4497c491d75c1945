#pragma once

#include <array>
#include <cstddef>

namespace wr {

/// @brief A ring buffer from one writer to one reader. Each may preempt the other on the one core.
/// @tparam Element type of an element
/// @tparam kSize greatest number of elements, a power of 2
template <class Element, std::size_t kSize>
class Ring {
 public:
  /// @brief Returns the number of stored elements.
  /// @isr{yes}
  [[nodiscard]] std::size_t count() const { return written_ - read_; }

  /// @brief Returns the number of elements that can be stored.
  /// @isr{yes}
  [[nodiscard]] std::size_t free() const { return kSize - count(); }

  /// @brief Stores an element.
  /// @param element the element
  /// @pre There is space.
  /// @isr{yes}
  void put(const Element& element) {
    elements_[written_ % kSize] = element;
    written_ = written_ + 1;
  }

  /// @brief Returns the oldest element, and removes it.
  /// @pre An element is stored.
  /// @isr{yes}
  Element take() {
    const Element element = elements_[read_ % kSize];
    read_ = read_ + 1;
    return element;
  }

 private:
  static_assert((kSize & (kSize - 1)) == 0, "the counts wrap together with the places");

  std::array<Element, kSize> elements_{};
  volatile std::size_t written_ = 0;
  volatile std::size_t read_ = 0;
};

}  // namespace wr
