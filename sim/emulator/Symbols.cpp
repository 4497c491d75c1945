#include "sim/emulator/Symbols.hpp"

#include <cxxabi.h>
#include <elf.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

namespace wr::emulator {

namespace {

// Returns the part of the file that begins at an offset, as an object of type Part.
template <typename Part>
Part partAt(const std::vector<char>& file, std::size_t offset) {
  Part part{};
  if (offset + sizeof part > file.size()) {
    throw std::runtime_error("the ELF file is incomplete; build it again");
  }
  std::memcpy(&part, file.data() + offset, sizeof part);
  return part;
}

std::string readable(const std::string& name) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(
      abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status), &std::free);
  return status == 0 && text ? text.get() : name;
}

}  // namespace

Symbols::Symbols(const std::filesystem::path& elf) : elf_(elf) {
  std::ifstream stream(elf, std::ios::binary);
  const std::vector<char> file{std::istreambuf_iterator<char>(stream), {}};
  if (file.size() < sizeof(Elf32_Ehdr) || std::memcmp(file.data(), ELFMAG, SELFMAG) != 0 ||
      file[EI_CLASS] != ELFCLASS32) {
    throw std::runtime_error(
        elf.string() + " is not an ELF file of 32 bits; use the ELF file of the firmware image");
  }
  const auto header = partAt<Elf32_Ehdr>(file, 0);
  for (std::size_t i = 0; i < header.e_shnum; ++i) {
    const auto section = partAt<Elf32_Shdr>(file, header.e_shoff + i * header.e_shentsize);
    if (section.sh_type != SHT_SYMTAB) {
      continue;
    }
    const auto names =
        partAt<Elf32_Shdr>(file, header.e_shoff + section.sh_link * header.e_shentsize);
    for (std::size_t at = 0; at + sizeof(Elf32_Sym) <= section.sh_size; at += sizeof(Elf32_Sym)) {
      const auto symbol = partAt<Elf32_Sym>(file, section.sh_offset + at);
      const std::size_t name = names.sh_offset + symbol.st_name;
      if (symbol.st_shndx == SHN_UNDEF || symbol.st_name == 0 || name >= file.size()) {
        continue;
      }
      const bool function = ELF32_ST_TYPE(symbol.st_info) == STT_FUNC;
      (function ? functions_ : objects_)
          .push_back({function ? symbol.st_value & ~1U : symbol.st_value, symbol.st_size,
                      file.data() + name});
    }
  }
  std::ranges::sort(functions_, {}, &Function::address);
}

std::string Symbols::nameAt(std::uint32_t address) const {
  const auto after = std::ranges::upper_bound(functions_, address, {}, &Function::address);
  if (after == functions_.begin()) {
    return {};
  }
  const Function& function = *std::prev(after);
  const bool inside = address - function.address < std::max(function.size, 2U);
  return inside ? readable(function.name) : std::string{};
}

std::uint32_t Symbols::addressOf(const std::string& name) const {
  for (const auto* symbols : {&functions_, &objects_}) {
    const auto found = std::ranges::find(*symbols, name, &Function::name);
    if (found != symbols->end()) {
      return found->address;
    }
  }
  return 0;
}

std::string Symbols::placeOf(std::uint32_t address) const {
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), "0x%x", static_cast<unsigned>(address));
  const std::string command =
      "arm-none-eabi-addr2line -i -e '" + elf_.string() + "' " + number.data() + " 2>/dev/null";
  // The command runs a program of the toolchain. Its arguments are the path of the ELF file and an
  // address.
  // NOLINTNEXTLINE(bugprone-command-processor,cert-env33-c): runs a tool of the toolchain
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  // The last line of the output is the position in the function itself. The earlier lines are
  // positions in inlined functions.
  std::array<char, 1024> line{};
  while (pipe && std::fgets(line.data(), line.size(), pipe.get()) != nullptr) {
  }
  std::string place = line.data();
  place.erase(std::min(place.find('\n'), place.size()));
  place.erase(std::min(place.find(" (discriminator"), place.size()));
  return place.starts_with('?') ? std::string{} : place;
}

}  // namespace wr::emulator
