#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <span>

#include "sim/emulator/processor/Instruction.hpp"

namespace wr::emulator {

static_assert(std::endian::native == std::endian::little,
              "the host must be little-endian, like the simulated processor");

/// @brief The memory map of the processor, with its memories and windows.
class Memory {
 public:
  /// @brief The accesses that a program may make to a memory.
  enum class Access { ReadWrite, ReadExecute, ReadWriteExecute };

  using Read = std::function<std::uint32_t(std::uint32_t address, unsigned size)>;
  using Write = std::function<void(std::uint32_t address, unsigned size, std::uint32_t value)>;

  /// @brief Frees memory that was allocated with calloc.
  struct Release {
    void operator()(void* memory) const { std::free(memory); }
  };

  /// @brief A memory or a window. A window is a range of addresses in which each access calls a
  /// function.
  struct Area {
    std::uint32_t address = 0;
    std::uint32_t size = 0;
    bool mayWrite = false;
    bool mayExecute = false;
    std::unique_ptr<std::uint8_t, Release> bytes{};  ///< null for a window
    std::unique_ptr<Instruction, Release>
        instructions{};  ///< decoded instructions, one for each half-word; null if the memory
                         ///< cannot be executed
    Read read{};
    Write write{};

    [[nodiscard]] bool holds(std::uint32_t place, std::uint32_t count = 1) const {
      const std::uint32_t offset = place - address;
      return offset < size && size - offset >= count;
    }
    [[nodiscard]] std::uint8_t* at(std::uint32_t place) const {
      return bytes.get() + (place - address);
    }
    /// @brief Returns true if the area is flash, which a program cannot write.
    [[nodiscard]] bool isFlash() const { return bytes != nullptr && !mayWrite; }
  };

  /// @brief A part of memory in which aligned loads and stores need no function call.
  struct Direct {
    std::uint8_t* bytes = nullptr;
    std::uint32_t address = 0;  ///< address of the first byte
    std::uint32_t loads = 0;    ///< number of bytes that can be loaded
    std::uint32_t stores = 0;   ///< number of bytes that can be stored

    /// @brief Returns true if an access is aligned and within the first `count` bytes.
    [[nodiscard]] bool holds(std::uint32_t count, std::uint32_t place, std::uint32_t wanted) const {
      const std::uint32_t offset = place - address;
      return offset < count && count - offset >= wanted && (place & 3U) == 0;
    }
  };

  /// @brief Constructs an empty memory.
  /// @param readsFlashDirectly false: each load from flash is a function call
  explicit Memory(bool readsFlashDirectly) : readsFlashDirectly_(readsFlashDirectly) {}

  /// @brief Adds memory.
  void map(std::uint32_t address, std::uint32_t size, Access access);

  /// @brief Adds a window.
  void map(std::uint32_t address, std::uint32_t size, Read read, Write write);

  /// @brief Searches the megabyte that contains an address. Returns the direct part of the first
  /// area in this megabyte. In most cases, this part contains the address.
  [[nodiscard]] const Direct& direct(std::uint32_t address) const {
    return directs_[address / kMegabyte];
  }

  /// @brief Returns a pointer to the bytes at an address if the program can load from this pointer
  /// without a function call; otherwise nullptr.
  [[nodiscard]] const std::uint8_t* loadable(std::uint32_t address, std::uint32_t size) const {
    const Direct& near = direct(address);
    return near.holds(near.loads, address, size) ? near.bytes + (address - near.address) : nullptr;
  }

  /// @brief Returns a pointer to the bytes at an address if the program can store to this pointer
  /// without a function call; otherwise nullptr.
  [[nodiscard]] std::uint8_t* storable(std::uint32_t address, std::uint32_t size) const {
    const Direct& near = direct(address);
    return near.holds(near.stores, address, size) ? near.bytes + (address - near.address) : nullptr;
  }

  /// @brief Reports a decoded instruction. After this report, each store at or above the
  /// instruction's address calls a function that clears decoded instructions. Stores below this
  /// address, such as stores to a stack, stay fast.
  void decoded(std::uint32_t address);

  /// @brief Clears the decoded instructions that a store has changed.
  static void forget(const Area& area, std::uint32_t address, std::uint32_t size);

  /// @brief Sets the callback that runs after each load and store of the program. While there is a
  /// callback, no access is direct.
  /// @param call the callback; an empty function removes the callback
  void observe(std::function<void(std::uint32_t address, std::uint32_t size, bool store)> call);

  /// @brief Calls the callback of observe(), if there is one.
  void accessed(std::uint32_t address, std::uint32_t size, bool store) const {
    if (observer_) [[unlikely]] {
      observer_(address, size, store);
    }
  }

  /// @brief Returns the area of an address; nullptr if there is no memory.
  [[nodiscard]] const Area* find(std::uint32_t address) const;

  /// @brief Writes memory for the caller, even memory that the program must not write.
  void load(std::uint32_t address, std::span<const std::uint8_t> bytes);

  /// @brief Reads memory for the caller. Returns 0 if there is no memory.
  template <typename Value>
  [[nodiscard]] Value read(std::uint32_t address) const {
    Value value = 0;
    if (const Area* area = find(address);
        area != nullptr && area->bytes != nullptr && area->holds(address, sizeof value)) {
      std::memcpy(&value, area->at(address), sizeof value);
    }
    return value;
  }

  /// @brief Returns the bytes of a stack frame; nullptr when a part of the stack frame cannot be
  /// written.
  [[nodiscard]] std::uint8_t* stack(std::uint32_t address, std::uint32_t size) const;

 private:
  static constexpr std::uint32_t kMegabyte = 0x100000;

  static constexpr std::size_t kMegabytes = 4096;

  void add(Area area);
  [[nodiscard]] Direct directOf(const Area& area) const;

  bool readsFlashDirectly_;
  std::deque<Area> all_;
  std::array<const Area*, kMegabytes> areas_{};  ///< the first area of each megabyte
  std::array<Direct, kMegabytes> directs_{};
  std::function<void(std::uint32_t, std::uint32_t, bool)> observer_;
};

}  // namespace wr::emulator
