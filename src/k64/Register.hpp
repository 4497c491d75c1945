#pragma once

#include <cstdint>

namespace wr {

/// @brief Accesses that the firmware may make to a register.
/// @datatype
enum class Access : std::uint8_t {
  Read,       ///< read only
  Write,      ///< write only
  ReadWrite,  ///< a read returns the bits that were written; single bits can be changed
  Flags       ///< reads and writes have different meanings; single bits cannot be changed
};

/// @brief Register of the microcontroller.
/// @tparam Value integer type that has the width of the register
/// @tparam kAddress address of the register, or of the first register of an array
/// @tparam kAccess permitted access
/// @datatype
template <class Value, std::uint32_t kAddress, Access kAccess = Access::ReadWrite>
class Register {
 public:
  /// @brief Bits of this register. Each register has its own type, so that bits of different
  /// registers cannot be combined.
  /// @datatype
  struct Bits {
    Value value = 0;  ///< the bits as a number

    /// @brief Returns whether any bit is set.
    /// @return true when at least one bit is set
    [[nodiscard]] constexpr bool any() const { return value != 0; }

    /// @brief Returns the bits that are set in at least one of the two values.
    friend constexpr Bits operator|(Bits a, Bits b) {
      return {static_cast<Value>(a.value | b.value)};
    }

    /// @brief Returns the bits that are set in both values.
    friend constexpr Bits operator&(Bits a, Bits b) {
      return {static_cast<Value>(a.value & b.value)};
    }

    /// @brief Returns whether the same bits are set in both values.
    friend constexpr bool operator==(Bits, Bits) = default;
  };

  /// @brief Returns the bits that store a number in a field of the register.
  /// @param value number to store in the field
  /// @param lowest number of the lowest bit of the field
  /// @return the bits
  [[nodiscard]] static constexpr Bits field(std::uint32_t value, unsigned lowest) {
    return {static_cast<Value>(value << lowest)};
  }

  /// @brief Returns a value in which only one bit is set.
  /// @param number number of the bit
  /// @return the bit
  [[nodiscard]] static constexpr Bits bit(unsigned number) { return field(1, number); }

  /// @brief Returns another register of the array that begins with this register.
  /// @param offset distance between the two registers [byte]
  /// @return the register
  [[nodiscard]] constexpr Register at(std::uint32_t offset) const {
    Register other;
    other.offset_ = offset;
    return other;
  }

  /// @brief Reads the register.
  /// @return all bits of the register
  [[nodiscard]] Bits read() const
    requires(kAccess != Access::Write)
  {
    return {*place()};  // NOLINT(clang-analyzer-core.FixedAddressDereference): a register
  }

  /// @brief Writes the register.
  /// @param bits new values of all bits of the register
  void write(Bits bits) const
    requires(kAccess != Access::Read)
  {
    *place() = bits.value;  // NOLINT(clang-analyzer-core.FixedAddressDereference): a register
  }

  /// @brief Sets bits of the register to 1. The other bits do not change.
  /// @param bits bits to set
  void set(Bits bits) const
    requires(kAccess == Access::ReadWrite)
  {
    write(read() | bits);
  }

  /// @brief Sets bits of the register to 0. The other bits do not change.
  /// @param bits bits to clear
  void clear(Bits bits) const
    requires(kAccess == Access::ReadWrite)
  {
    write(read() & Bits{static_cast<Value>(~bits.value)});
  }

 private:
  // Registers have fixed addresses. Only this function converts a number to an address.
  [[nodiscard]] volatile Value* place() const {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): a register has a fixed address
    return reinterpret_cast<volatile Value*>(kAddress + offset_);
  }

  std::uint32_t offset_ = 0;
};

}  // namespace wr
