#include "sim/emulator/Image.hpp"

#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace wr::emulator {

namespace {

struct Format {
  std::string_view begin;
  std::string_view name;
};

// A raw image begins with the initial stack pointer, least significant byte first. This pointer is
// a multiple of 4. Therefore the first byte of a raw image is also a multiple of 4. The first bytes
// of the following formats are not multiples of 4.
constexpr std::array<Format, 3> kOtherFormats{{{"\x7f"
                                                "ELF",
                                                "an ELF file"},
                                               {":", "an Intel HEX file"},
                                               {"S0", "a Motorola S-record file"}}};

}  // namespace

std::vector<std::uint8_t> readImage(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(input),
                            std::istreambuf_iterator<char>()};
  if (content.empty()) {
    throw std::runtime_error("no firmware image at " + file.string() +
                             ": build it first, or check the path");
  }
  for (const Format& format : kOtherFormats) {
    if (content.starts_with(format.begin)) {
      throw std::runtime_error(
          file.string() + " is " + std::string(format.name) +
          ", not a raw firmware image: convert it with arm-none-eabi-objcopy -O binary");
    }
  }
  return {content.begin(), content.end()};
}

}  // namespace wr::emulator
