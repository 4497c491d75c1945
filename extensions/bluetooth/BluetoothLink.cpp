#include "bluetooth/BluetoothLink.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace wr {

namespace {

constexpr std::size_t kChunk = 64;
constexpr std::size_t kMostBytes = 2048;

}  // namespace

BluetoothLink::BluetoothLink(SerialPort& port, SerialReader& orders, const Timebase& clock)
    : port_(port), orders_(orders), clock_(clock) {}

void BluetoothLink::receive() {
  std::array<std::uint8_t, kChunk> chunk{};
  orders_.beginCycle(clock_.now());
  std::size_t left = kMostBytes;
  std::size_t received = chunk.size();
  while (left != 0 && received != 0) {
    received = port_.read(std::span(chunk).first(std::min(left, chunk.size())));
    left -= received;
    for (const std::uint8_t byte : std::span(chunk).first(received)) {
      if (decoder_.push(byte) == Decoded::Whole) {
        take(decoder_.frame());
      }
    }
  }
}

void BluetoothLink::take(const Frame& frame) {
  if (frame.type == FrameType::Order && frame.payload.size() >= SerialReader::kOrderLength) {
    const auto payload = frame.payload.first<SerialReader::kOrderLength>();
    orders_.heedStop(payload);
    orders_.offer(payload, port_.receivedAt());
  }
}

}  // namespace wr
