#include "sim/programs/SerialLine.hpp"

#include <charconv>
#include <cstdio>
#include <optional>
#include <string_view>

#include "sim/programs/PseudoTerminal.hpp"
#include "sim/programs/TcpLine.hpp"

namespace wr::programs {

namespace {

constexpr std::string_view kTcp = "tcp:";

std::optional<std::uint16_t> tcpPortOf(std::string_view kind) {
  std::uint16_t port = 0;
  if (!kind.starts_with(kTcp)) {
    return std::nullopt;
  }
  kind.remove_prefix(kTcp.size());
  const auto [end, error] = std::from_chars(kind.data(), kind.data() + kind.size(), port);
  return error == std::errc() && end == kind.data() + kind.size() ? std::optional(port)
                                                                  : std::nullopt;
}

/// @brief A serial line that sends to the standard output of the program. It receives nothing.
class StandardOutput final : public SerialLine {
 public:
  [[nodiscard]] const std::string& name() const override { return name_; }
  std::size_t read(std::span<std::uint8_t> /*bytes*/) override { return 0; }
  bool write(std::span<const std::uint8_t> bytes) override {
    const std::size_t written = std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    return std::fflush(stdout) == 0 && written == bytes.size();
  }

 private:
  std::string name_ = "stdout";
};

}  // namespace

std::unique_ptr<SerialLine> openLine(const std::string& kind) {
  if (const auto port = tcpPortOf(kind)) {
    return std::make_unique<TcpLine>(*port);
  }
  if (kind == "stdout") {
    return std::make_unique<StandardOutput>();
  }
  return std::make_unique<PseudoTerminal>();
}

bool isLineKind(const std::string& kind) {
  return kind == "pty" || kind == "stdout" || tcpPortOf(kind).has_value();
}

}  // namespace wr::programs
