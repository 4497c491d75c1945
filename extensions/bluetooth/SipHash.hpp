#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace wr {

/// @brief The computation of a tag by the algorithm SipHash-2-4. A tag is a check value of 64 bits
/// that depends on a secret key.
///
/// @function Computes the tag of a sequence of bytes from these bytes and a secret key. Nobody can
/// compute the correct tag without this key.
///
/// @secret The algorithm of the tag. Source: J.-P. Aumasson and D. J. Bernstein, SipHash: a fast
/// short-input PRF, 2012.
class SipHash final {
 public:
  /// @brief A key of 128 bits.
  using Key = std::array<std::uint8_t, 16>;

  /// @brief Starts the computation of a tag.
  /// @param key secret key
  explicit SipHash(const Key& key);

  /// @brief Adds bytes to the sequence whose tag is computed.
  /// @param bytes next bytes; sender and receiver add the same bytes in the same sequence
  /// @isr{no}
  /// @satisfies FR-261
  void add(std::span<const std::uint8_t> bytes);

  /// @brief Computes the tag of all added bytes.
  /// @return the tag, a number of 64 bits
  /// @post The object cannot be used again: a second call returns a wrong tag.
  /// @isr{no}
  /// @satisfies FR-261
  [[nodiscard]] std::uint64_t tag();

 private:
  void round();
  void compress(std::uint64_t word);

  std::array<std::uint64_t, 4> v_{};
  std::uint64_t word_ = 0;   // added bytes of the last, incomplete word
  std::uint64_t count_ = 0;  // number of added bytes
};

}  // namespace wr
