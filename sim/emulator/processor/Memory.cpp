#include "sim/emulator/processor/Memory.hpp"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

namespace wr::emulator {

namespace {

// The system gives zeros, and takes memory only for those that are touched.
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
  const bool loads = added.bytes != nullptr && (added.mayWrite || readsFlashDirectly_);
  const Direct direct{.bytes = added.bytes.get(),
                      .address = added.address,
                      .loads = loads ? added.size : 0,
                      .stores = added.mayWrite ? added.size : 0};
  const std::uint32_t last = added.address + (added.size - 1);
  for (std::uint32_t i = added.address / kMegabyte; i <= last / kMegabyte; ++i) {
    if (areas_[i] == nullptr) {
      areas_[i] = &added;
      directs_[i] = direct;
    }
  }
}

void Memory::map(std::uint32_t address, std::uint32_t size, Access access) {
  Area area{.address = address,
            .size = size,
            .mayWrite = access != Access::ReadExecute,
            .mayExecute = access != Access::ReadWrite,
            .bytes = zeros<std::uint8_t>(size)};
  if (area.isFlash()) {
    area.instructions = zeros<Instruction>(size / 2 + 2);  // behind the last one there is none
  }
  add(std::move(area));
}

void Memory::map(std::uint32_t address, std::uint32_t size, Read read, Write write) {
  add({.address = address, .size = size, .read = std::move(read), .write = std::move(write)});
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
    throw std::invalid_argument("there is no memory for the loaded image");
  }
  std::ranges::copy(bytes, area->at(address));
  if (area->instructions != nullptr) {
    // The instruction before the first byte may reach into it.
    const std::uint32_t offset = address - area->address;
    const std::uint32_t first = offset / 2 - (offset >= 2 ? 1 : 0);
    const auto end = static_cast<std::uint32_t>((offset + bytes.size() + 1) / 2);
    std::fill(area->instructions.get() + first, area->instructions.get() + end, Instruction{});
  }
}

std::uint8_t* Memory::stack(std::uint32_t address, std::uint32_t size) const {
  const Area* area = find(address);
  return area != nullptr && area->mayWrite && area->holds(address, size) ? area->at(address)
                                                                         : nullptr;
}

}  // namespace wr::emulator
