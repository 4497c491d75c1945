#include "sim/k64/processor/Memory.hpp"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

namespace wr::k64 {

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

Memory::Area& Memory::add(std::uint32_t address, std::uint32_t size) {
  Area& area = all_.emplace_back();
  area.address = address;
  area.size = size;
  for (std::uint32_t i = address / kMegabyte; i <= (address + (size - 1)) / kMegabyte; ++i) {
    if (areas_[i] == &nothing_) {
      areas_[i] = &area;
    }
  }
  return area;
}

void Memory::map(std::uint32_t address, std::uint32_t size, Access access) {
  Area& area = add(address, size);
  area.mayWrite = access != Access::ReadExecute;
  area.mayExecute = access != Access::ReadWrite;
  area.direct = area.mayWrite || readsFlashDirectly_ ? size : 0;
  area.writable = area.mayWrite ? size : 0;
  area.bytes = zeros<std::uint8_t>(size);
  if (area.isFlash()) {
    area.instructions = zeros<Instruction>(size / 2);
  }
}

void Memory::map(std::uint32_t address, std::uint32_t size, Read read, Write write) {
  Area& area = add(address, size);
  area.read = std::move(read);
  area.write = std::move(write);
}

const Memory::Area* Memory::find(std::uint32_t address) const {
  if (near(address).holds(address)) {
    return &near(address);
  }
  const auto found =
      std::ranges::find_if(all_, [address](const Area& area) { return area.holds(address); });
  return found == all_.end() ? nullptr : &*found;
}

void Memory::load(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  const Area* area = find(address);
  if (area == nullptr || area->bytes == nullptr ||
      !area->holds(address, static_cast<std::uint32_t>(bytes.size()))) {
    throw std::invalid_argument("there is no memory for what is loaded");
  }
  std::ranges::copy(bytes, area->at(address));
  if (area->instructions != nullptr) {
    std::fill_n(area->instructions.get(), area->size / 2, Instruction{});
  }
}

std::uint8_t* Memory::stack(std::uint32_t address, std::uint32_t size) const {
  const Area* area = find(address);
  return area != nullptr && area->mayWrite && area->holds(address, size) ? area->at(address)
                                                                         : nullptr;
}

}  // namespace wr::k64
