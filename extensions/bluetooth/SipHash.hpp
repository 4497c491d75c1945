#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace wr {

/// @brief A keyed check value of 64 bits: SipHash-2-4.
///
/// @function Computes a tag over bytes with a secret key. Without the key nobody can compute the
/// tag of other bytes.
///
/// @secret The algorithm of the tag. Source: J.-P. Aumasson and D. J. Bernstein, SipHash: a fast
/// short-input PRF, 2012.
class SipHash final {
 public:
  /// @brief A key of 128 bits.
  using Key = std::array<std::uint8_t, 16>;

  /// @brief Begins a tag.
  /// @param key secret key
  explicit SipHash(const Key& key);

  /// @brief Adds bytes to the tag.
  /// @param bytes bytes in the same sequence as at the other side
  /// @isr{no}
  /// @satisfies FR-261
  void add(std::span<const std::uint8_t> bytes);

  /// @brief Computes the tag of all added bytes.
  /// @return the tag, 64 bits without meaning as a number
  /// @post A second call returns another value.
  /// @isr{no}
  /// @satisfies FR-261
  [[nodiscard]] std::uint64_t tag();

 private:
  void round();
  void compress(std::uint64_t word);

  std::array<std::uint64_t, 4> v_{};
  std::uint64_t word_ = 0;   // bytes of the incomplete word, the first byte in the lowest bits
  std::uint64_t count_ = 0;  // number of added bytes
};

}  // namespace wr
