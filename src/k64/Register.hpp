#pragma once

#include <cstdint>

namespace wr {

/// @brief Access of a program to a register.
/// @datatype
enum class Access : std::uint8_t {
  Read,       ///< read only
  Write,      ///< write only
  ReadWrite,  ///< a read returns the written bits, so single bits can be changed
  Flags       ///< reads and writes have different meanings: it is only written as a whole
};

/// @brief Register of the microcontroller.
/// @tparam Value type of the number in the register
/// @tparam kAddress address of the register, or of the first register of an array
/// @tparam kAccess permitted access
/// @datatype
template <class Value, std::uint32_t kAddress, Access kAccess = Access::ReadWrite>
class Register {
 public:
  /// @brief Bits of this register; they cannot be combined with bits of another register.
  /// @datatype
  struct Bits {
    Value value = 0;  ///< the bits as a number

    /// @brief Returns whether any bit is set.
    /// @return true when at least one bit is set
    [[nodiscard]] constexpr bool any() const { return value != 0; }

    /// @brief Joins bits.
    friend constexpr Bits operator|(Bits a, Bits b) {
      return {static_cast<Value>(a.value | b.value)};
    }

    /// @brief Returns the bits that are set in both.
    friend constexpr Bits operator&(Bits a, Bits b) {
      return {static_cast<Value>(a.value & b.value)};
    }

    /// @brief Returns whether the bits are equal.
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
  /// @param offset distance from the first register [byte]
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
    return {*place()};  // NOLINT(clang-analyzer-core.FixedAddressDereference): the address is a
                        // register
  }

  /// @brief Writes the register.
  /// @param bits all its bits
  void write(Bits bits) const
    requires(kAccess != Access::Read)
  {
    *place() = bits.value;  // NOLINT(clang-analyzer-core.FixedAddressDereference): as above
  }

  /// @brief Sets bits, and does not change the other bits.
  /// @param bits bits to set
  void set(Bits bits) const
    requires(kAccess == Access::ReadWrite)
  {
    write(read() | bits);
  }

  /// @brief Clears bits, and does not change the other bits.
  /// @param bits bits to clear
  void clear(Bits bits) const
    requires(kAccess == Access::ReadWrite)
  {
    write(read() & Bits{static_cast<Value>(~bits.value)});
  }

 private:
  // The only place where a number is converted to an address: registers have fixed addresses.
  [[nodiscard]] volatile Value* place() const {
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    return reinterpret_cast<volatile Value*>(kAddress + offset_);
  }

  std::uint32_t offset_ = 0;
};

}  // namespace wr
