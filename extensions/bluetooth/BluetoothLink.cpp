#include "bluetooth/BluetoothLink.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace wr {

namespace {

constexpr std::size_t kChunk = 64;
constexpr std::size_t kMostChunks = 32;

}  // namespace

BluetoothLink::BluetoothLink(SerialPort& port, SerialReader& orders)
    : port_(port), orders_(orders) {}

void BluetoothLink::receive() {
  std::array<std::uint8_t, kChunk> chunk{};
  std::size_t received = chunk.size();
  for (std::size_t i = 0; i < kMostChunks && received == chunk.size(); ++i) {
    received = port_.read(chunk);
    for (const std::uint8_t byte : std::span(chunk).first(received)) {
      if (decoder_.push(byte) == Decoded::Whole) {
        take(decoder_.frame());
      }
    }
  }
}

void BluetoothLink::take(const Frame& frame) {
  if (frame.type == FrameType::Order && frame.payload.size() == SerialReader::kOrderLength) {
    orders_.offer(frame.payload.first<SerialReader::kOrderLength>());
  }
}

}  // namespace wr
