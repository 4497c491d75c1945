#pragma once

#include <cstdint>

namespace wr {

/// @brief Access of a program to a register.
/// @datatype
enum class Access : std::uint8_t {
  Read,       ///< read only
  Write,      ///< write only
  ReadWrite,  ///< a read gives the bits that were written: bits can be changed one by one
  Flags       ///< read and write differ: it is written as a whole only
};

/// @brief Register of the microcontroller.
/// @tparam Value type of the number in the register
/// @tparam kAddress address of the register, or of the first one of a row of equal registers
/// @tparam kAccess permitted access
/// @datatype
template <class Value, std::uint32_t kAddress, Access kAccess = Access::ReadWrite>
class Register {
 public:
  /// @brief Bits for this register; those of another register do not mix with them.
  /// @datatype
  struct Bits {
    Value value = 0;  ///< the number that they form

    /// @brief Returns whether any bit is set.
    /// @return true when at least one is
    [[nodiscard]] constexpr bool any() const { return value != 0; }

    /// @brief Joins bits.
    friend constexpr Bits operator|(Bits a, Bits b) {
      return {static_cast<Value>(a.value | b.value)};
    }

    /// @brief Returns the bits that are set in both.
    friend constexpr Bits operator&(Bits a, Bits b) {
      return {static_cast<Value>(a.value & b.value)};
    }

    /// @brief Returns whether the bits are the same.
    friend constexpr bool operator==(Bits, Bits) = default;
  };

  /// @brief Returns the bits of a field.
  /// @param value number in the field
  /// @param lowest number of the field's lowest bit
  /// @return the bits
  [[nodiscard]] static constexpr Bits field(std::uint32_t value, unsigned lowest) {
    return {static_cast<Value>(value << lowest)};
  }

  /// @brief Returns one bit.
  /// @param number number of the bit
  /// @return the bit
  [[nodiscard]] static constexpr Bits bit(unsigned number) { return field(1, number); }

  /// @brief Returns an element of the register array.
  /// @param offset distance from the first one [byte]
  /// @return the register
  [[nodiscard]] constexpr Register at(std::uint32_t offset) const {
    Register other;
    other.offset_ = offset;
    return other;
  }

  /// @brief Reads the register.
  /// @return all its bits
  [[nodiscard]] Bits read() const
    requires(kAccess != Access::Write)
  {
    return {*place()};  // NOLINT(clang-analyzer-core.FixedAddressDereference): that is a register
  }

  /// @brief Writes the register.
  /// @param bits all its bits
  void write(Bits bits) const
    requires(kAccess != Access::Read)
  {
    *place() = bits.value;  // NOLINT(clang-analyzer-core.FixedAddressDereference): as above
  }

  /// @brief Sets bits, and leaves the others.
  /// @param bits bits to set
  void set(Bits bits) const
    requires(kAccess == Access::ReadWrite)
  {
    write(read() | bits);
  }

  /// @brief Clears bits, and leaves the others.
  /// @param bits bits to clear
  void clear(Bits bits) const
    requires(kAccess == Access::ReadWrite)
  {
    write(read() & Bits{static_cast<Value>(~bits.value)});
  }

 private:
  // The one place where a number becomes an address: registers are at fixed ones.
  [[nodiscard]] volatile Value* place() const {
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    return reinterpret_cast<volatile Value*>(kAddress + offset_);
  }

  std::uint32_t offset_ = 0;
};

}  // namespace wr
