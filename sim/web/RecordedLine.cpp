#include "sim/web/RecordedLine.hpp"

#include <utility>

namespace wr::web {

void RecordedLine::send(std::span<const std::uint8_t> bytes) {
  note(true, bytes);
  robot_.send(bytes);
}

void RecordedLine::sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) {
  note(true, bytes);
  robot_.sendBeforePulse(bytes, before);
}

std::vector<std::uint8_t> RecordedLine::takeSent() {
  std::vector<std::uint8_t> bytes = robot_.takeSent();
  note(false, bytes);
  return bytes;
}

std::vector<RecordedLine::Piece> RecordedLine::takePieces() {
  return std::exchange(pieces_, {});
}

void RecordedLine::note(bool fromPc, std::span<const std::uint8_t> bytes) {
  if (!bytes.empty()) {
    pieces_.push_back(
        {.at = robot_.now(), .fromPc = fromPc, .bytes = {bytes.begin(), bytes.end()}});
  }
}

}  // namespace wr::web
