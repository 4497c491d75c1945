#include "sim/emulator/processor/Memory.hpp"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

namespace wr::emulator {

namespace {

// Allocates memory whose bytes are 0. The operating system provides physical memory only for the
// pages that are accessed.
template <typename Item>
std::unique_ptr<Item, Memory::Release> zeros(std::size_t count) {
  std::unique_ptr<Item, Memory::Release> items(
      static_cast<Item*>(std::calloc(count, sizeof(Item))));
  if (items == nullptr) {
    throw std::bad_alloc();
  }
  return items;
}

}  // namespace

void Memory::add(Area area) {
  const Area& added = all_.emplace_back(std::move(area));
  const Direct direct = directOf(added);
  const std::uint32_t last = added.address + (added.size - 1);
  for (std::uint32_t i = added.address / kMegabyte; i <= last / kMegabyte; ++i) {
    if (areas_[i] == nullptr) {
      areas_[i] = &added;
      directs_[i] = direct;
    }
  }
}

Memory::Direct Memory::directOf(const Area& area) const {
  if (observer_) {
    return {};
  }
  const bool loads = area.bytes != nullptr && (area.mayWrite || readsFlashDirectly_);
  return {.bytes = area.bytes.get(),
          .address = area.address,
          .loads = loads ? area.size : 0,
          .stores = area.mayWrite ? area.size : 0};
}

void Memory::observe(std::function<void(std::uint32_t, std::uint32_t, bool)> call) {
  observer_ = std::move(call);
  // Clears the decoded instructions. Stores can then be direct again.
  for (const Area& area : all_) {
    forget(area, area.address, area.size);
  }
  for (std::size_t i = 0; i < kMegabytes; ++i) {
    directs_[i] = areas_[i] == nullptr ? Direct{} : directOf(*areas_[i]);
  }
}

void Memory::map(std::uint32_t address, std::uint32_t size, Access access) {
  Area area{.address = address,
            .size = size,
            .mayWrite = access != Access::ReadExecute,
            .mayExecute = access != Access::ReadWrite,
            .bytes = zeros<std::uint8_t>(size)};
  if (area.mayExecute) {
    area.instructions =
        zeros<Instruction>(size / 2 + 2);  // the two entries after the last instruction stay empty
  }
  add(std::move(area));
}

void Memory::map(std::uint32_t address, std::uint32_t size, Read read, Write write) {
  add({.address = address, .size = size, .read = std::move(read), .write = std::move(write)});
}

void Memory::decoded(std::uint32_t address) {
  Direct& near = directs_[address / kMegabyte];
  if (address - near.address < near.stores) {
    near.stores = address - near.address;
  }
}

void Memory::forget(const Area& area, std::uint32_t address, std::uint32_t size) {
  if (area.instructions == nullptr) {
    return;
  }
  // A changed half-word may be the second half of an instruction that begins one half-word earlier.
  const std::uint32_t first = (address - area.address) / 2;
  const std::uint32_t last = (address - area.address + size - 1) / 2;
  for (std::uint32_t half = first == 0 ? 0 : first - 1; half <= last; ++half) {
    area.instructions.get()[half] = Instruction{};
  }
}

const Memory::Area* Memory::find(std::uint32_t address) const {
  if (const Area* area = areas_[address / kMegabyte]; area != nullptr && area->holds(address)) {
    return area;
  }
  const auto found =
      std::ranges::find_if(all_, [address](const Area& area) { return area.holds(address); });
  return found == all_.end() ? nullptr : &*found;
}

void Memory::load(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  const Area* area = find(address);
  if (area == nullptr || area->bytes == nullptr ||
      !area->holds(address, static_cast<std::uint32_t>(bytes.size()))) {
    throw std::invalid_argument("there is no memory at the loaded addresses");
  }
  std::ranges::copy(bytes, area->at(address));
  forget(*area, address, static_cast<std::uint32_t>(bytes.size()));
}

std::uint8_t* Memory::stack(std::uint32_t address, std::uint32_t size) const {
  const Area* area = find(address);
  return area != nullptr && area->mayWrite && area->holds(address, size) ? area->at(address)
                                                                         : nullptr;
}

}  // namespace wr::emulator
