#include "torture/Qemu.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace wr::torture {
namespace {

constexpr char kOptions[] =
    " -M mps2-an386 -nographic -monitor none -serial none"
    " -semihosting-config enable=on,target=native -kernel ";

/// @brief A temporary file, which is removed with its object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const Image& content)
      : path_(std::filesystem::temp_directory_path() /
              ("torture-" + std::to_string(::getpid()) + ".bin")) {
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(content.data()),
               static_cast<std::streamsize>(content.size()));
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] std::string name() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace

bool Qemu::installed() {
  return std::system("command -v qemu-system-arm > /dev/null") == 0;
}

Records Qemu::run(const Image& image) {
  const TemporaryFile file(image);
  std::FILE* const output =
      ::popen(("timeout 60 qemu-system-arm" + std::string(kOptions) + file.name()).c_str(), "r");
  if (output == nullptr) {
    throw std::runtime_error("QEMU does not start");
  }
  std::vector<std::uint8_t> bytes;
  std::array<std::uint8_t, 65536> part{};
  for (std::size_t size = 1; size > 0;) {
    size = std::fread(part.data(), 1, part.size(), output);
    bytes.insert(bytes.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(size));
  }
  if (::pclose(output) != 0) {
    throw std::runtime_error("the torture program does not end on QEMU");
  }
  return recordsIn(bytes);
}

}  // namespace wr::torture
