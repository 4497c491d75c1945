#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"

namespace wr {

/// @brief A serial port whose line is a pseudo-terminal of the host.
///
/// The port keeps the far end open itself, so a client may leave and another may come. Bytes that
/// the pseudo-terminal does not take at once wait in bounded storage.
class PtySerialPort final : public SerialPort {
 public:
  /// @brief Bytes that can wait to be sent.
  static constexpr std::size_t kCapacity = 512;

  /// @brief Opens a pseudo-terminal in raw mode. Throws std::system_error when it cannot.
  PtySerialPort();
  ~PtySerialPort();

  /// @brief Sets the clock that gives the time of received bytes. Without one the time is always 0.
  /// @param clock the clock
  void setClock(const Timebase& clock) { clock_ = &clock; }

  /// @brief The far end, which a client opens.
  /// @return path of the device
  [[nodiscard]] const std::string& path() const;

  std::size_t read(std::span<std::uint8_t> bytes) override;
  /// @brief Returns when the pseudo-terminal gave the last byte: the time at which the byte came is unknown.
  [[nodiscard]] Instant receivedAt() const override { return receivedAt_; }
  [[nodiscard]] std::size_t free() const override;
  bool write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] std::uint16_t lostBytes() const override;

 private:
  void receive();
  void send();

  int line_ = -1;
  int farEnd_ = -1;
  std::string path_;
  const Timebase* clock_ = nullptr;
  Instant receivedAt_;
  std::vector<std::uint8_t> received_;
  std::vector<std::uint8_t> waiting_;
};

}  // namespace wr
