#include "torture/Image.hpp"

#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace wr::torture {

Image image(std::uint32_t seed, std::uint32_t actions) {
  std::ifstream file(WR_TORTURE_PROGRAM, std::ios::binary);
  Image bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (bytes.size() <= kActionsAddress + sizeof actions) {
    throw std::runtime_error(
        "there is no torture program; build the target torture_program: " WR_TORTURE_PROGRAM);
  }
  std::memcpy(bytes.data() + kSeedAddress, &seed, sizeof seed);
  std::memcpy(bytes.data() + kActionsAddress, &actions, sizeof actions);
  return bytes;
}

Records recordsIn(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() % sizeof(Record) != 0) {
    throw std::runtime_error("the torture program ended within a record");
  }
  Records records(bytes.size() / sizeof(Record));
  std::memcpy(static_cast<void*>(records.data()), bytes.data(), bytes.size());
  return records;
}

}  // namespace wr::torture
