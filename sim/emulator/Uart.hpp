#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief A UART, and the serial line at its pins. See K64P144M120SF5RM, chapter Universal
/// Asynchronous Receiver/Transmitter (UART).
///
/// The FIFOs follow the descriptions of PFIFO, CFIFO, SFIFO, TWFIFO, TCFIFO, RWFIFO and RCFIFO. The
/// program may write PFIFO only while receiver and transmitter are off. S1[RDRF] is set when at
/// least RWFIFO bytes wait. To clear RDRF, the program reads S1 and then D. RDRF stays set if at
/// least RWFIFO bytes still wait. S1[TDRE] is set while at most TWFIFO bytes wait. S1[OR] is set
/// when a byte does not fit into the FIFO. OR and FE stop the receiver until they are cleared.
/// UART0 has FIFOs of 8 bytes. UART4 has buffers of 1 byte (chapter Chip Configuration, UART).
///
/// The model has no noise on the serial line (S1[NF], ED), parity, 9 bits, loops, wake-up, LIN
/// break, infrared, smart cards, DMA, or flag for an idle line.
class Uart final : public Peripheral {
 public:
  /// @brief Properties in which the UARTs differ (K64P144M120SF5RM, Chip Configuration, UART).
  struct Kind {
    unsigned number;
    bool coreClock;     ///< true: the UART has the core clock; false: the bus clock
    std::uint8_t fifo;  ///< PFIFO after a reset: 0x22 for FIFOs of 8 bytes, 0 for 1 byte
    unsigned line;      ///< interrupt line for bytes; the next interrupt line is for errors
  };

  Uart(Microcontroller& board, const Kind& kind);

  /// @brief Sets the functions that return true if the pins are connected to the UART.
  void connectPins(std::function<bool()> receives, std::function<bool()> sends);

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  [[nodiscard]] bool readHasEffect(std::uint32_t offset) const override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;
  [[nodiscard]] Time nextEvent() const override;
  void advance() override;

  /// @brief Receives a byte from outside.
  /// @param notBefore earliest time at which the byte begins; the byte waits for earlier bytes
  /// @param stopBit true if the stop bit is correct
  void arrive(Time notBefore, std::uint8_t byte, bool stopBit = true);

  /// @brief Returns the bytes that the UART has sent since the last call.
  [[nodiscard]] std::vector<std::uint8_t> takeSent();

  [[nodiscard]] bool lineIdle() const { return arriving_.empty() && !sending_; }

  void setLineBaud(std::uint32_t baud) { lineBaud_ = baud; }

 private:
  struct Arriving {
    Time end;
    std::uint8_t byte;
    bool stopBit;
  };

  [[nodiscard]] double baud() const;
  [[nodiscard]] bool baudFits();
  [[nodiscard]] Time frameTime() const;
  [[nodiscard]] std::size_t depth(std::uint32_t on) const {
    return kind_.fifo != 0 && (fifo_ & on) != 0 ? 8 : 1;
  }
  [[nodiscard]] std::size_t receiveDepth() const { return depth(0x08); }
  [[nodiscard]] std::size_t sendDepth() const { return depth(0x80); }
  [[nodiscard]] std::uint32_t status() const;
  [[nodiscard]] std::uint32_t readData();
  void received(const Arriving& arriving);
  void send(std::uint8_t byte);
  void startSending();
  void sent();
  void control2(std::uint32_t value);
  void fifo(std::uint32_t value);
  void updateLines();

  Kind kind_;
  std::string name_;
  std::function<bool()> receives_;
  std::function<bool()> sends_;
  std::uint32_t lineBaud_ = 115'200;
  std::deque<Arriving> arriving_;
  Time lineFree_{0};
  std::vector<std::uint8_t> sent_;

  std::uint32_t bdh_ = 0;
  std::uint32_t bdl_ = 0;
  std::uint32_t c1_ = 0;
  std::uint32_t c2_ = 0;
  std::uint32_t c3_ = 0;
  std::uint32_t c4_ = 0;
  std::uint32_t fifo_ = 0;
  std::uint32_t fifoControl_ = 0;
  std::uint32_t fifoFlags_ = 0;
  std::uint32_t sendMark_ = 0;
  std::uint32_t receiveMark_ = 1;
  std::uint32_t errors_ = 0;  ///< OR, NF, FE, PF of S1
  bool dataReady_ = false;    ///< RDRF
  std::uint32_t seen_ = 0;    ///< value of S1 at its last read
  std::deque<std::uint8_t> receivedBytes_;
  std::deque<std::uint8_t> toSend_;
  bool sending_ = false;
  std::uint8_t inShifter_ = 0;
  Time sentAt_ = kNever;
};

}  // namespace wr::emulator
