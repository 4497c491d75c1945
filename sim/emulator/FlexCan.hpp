#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "sim/emulator/CanFrame.hpp"
#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief The CAN controller 0, and a bus with one other node that acknowledges each frame. See
/// K64P144M120SF5RM, chapter CAN (FlexCAN). The registers and codes are the same as in the driver
/// of Linux (drivers/net/can/flexcan).
///
/// The model has three modes (disabled, freeze and normal), the bit timing, the global mask, and
/// the flags with their interrupt. Its message buffers send and receive data frames with standard
/// identifiers. The duration of a frame is one bit time for each bit that ISO 11898-1 defines.
/// Stuff bits take no time.
///
/// If a buffer contains a received frame, the buffer is locked when the program reads its control
/// word. A frame for a locked buffer waits until the buffer is unlocked. A newer frame replaces the
/// frame that waits. The program must clear the flag of the buffer before it unlocks the buffer. If
/// it unlocks the buffer first, it could later clear the flag of the frame that waited. Therefore
/// this sequence causes a finding. A frame moves into its buffer in no time. Therefore the code
/// BUSY never occurs.
///
/// The model has no receive FIFO, individual masks, remote and extended frames, errors on the bus,
/// loop-back, listen-only mode, wake-up or time stamps. If the program selects one of these
/// functions, the write causes a finding.
///
/// Erratum 5829 of the controller: if a buffer is activated in a certain clock of the arbitration,
/// it is not sent. The workaround reserves buffer 0. After each activation, the program must write
/// the code INACTIVE to buffer 0 twice. If one of these writes is missing when a frame is sent,
/// this causes a finding.
class FlexCan final : public Peripheral {
 public:
  explicit FlexCan(Microcontroller& board) : Peripheral(board) { reset(Reset::PowerOn); }

  /// @brief Sets the function that returns true if both pins are connected to the controller.
  void connectPins(std::function<bool()> connected) { connected_ = std::move(connected); }

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  [[nodiscard]] bool readHasEffect(std::uint32_t offset) const override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;
  [[nodiscard]] Time nextEvent() const override { return busy_ ? end_ : kNever; }
  void advance() override;

  /// @brief Makes the other node send a frame as soon as the bus is free.
  void arrive(CanFrame frame);

  /// @brief Returns the frames that the controller has sent since the last call.
  [[nodiscard]] std::vector<CanFrame> takeSent();

  /// @brief Returns true when no frame is on the bus and no frame waits for the bus.
  [[nodiscard]] bool idle() const { return !busy_ && arriving_.empty(); }

 private:
  static constexpr std::size_t kBuffers = 16;

  struct Buffer {
    std::uint32_t control = 0;  // CODE, SRR, IDE, RTR, DLC, TIME STAMP
    std::uint32_t identifier = 0;
    std::array<std::uint32_t, 2> data{};
    bool served = false;  // the program has read the buffer since the last frame was received
  };

  [[nodiscard]] bool enabled() const;
  [[nodiscard]] bool frozen() const;
  [[nodiscard]] std::uint32_t mode() const;
  [[nodiscard]] Time endOf(const CanFrame& frame, Time begin) const;
  void setMode(std::uint32_t value);
  void writeBuffer(std::uint32_t offset, std::uint32_t value);
  void nextFrame(Time from);
  void sent();
  void received(const CanFrame& frame);
  void store(std::size_t number, const CanFrame& frame);
  void lock(std::size_t number);
  void unlock();
  void updateLine();

  std::function<bool()> connected_ = [] { return false; };
  std::uint32_t mcr_ = 0;
  std::uint32_t timing_ = 0;
  std::uint32_t mask_ = 0;
  std::uint32_t flags_ = 0;
  std::uint32_t enabledFlags_ = 0;
  std::array<Buffer, kBuffers> buffers_{};
  int inactiveWrites_ = 0;             // writes of INACTIVE to buffer 0 since the last activation
  std::optional<std::size_t> locked_;  // number of the locked buffer
  std::optional<CanFrame> waiting_;    // frame for the locked buffer
  std::deque<CanFrame> arriving_;
  std::vector<CanFrame> sent_;
  bool busy_ = false;
  bool sends_ = false;      // true if the frame on the bus is a frame of the controller
  std::size_t sender_ = 0;  // number of the buffer whose frame is sent
  Time end_ = kNever;
};

}  // namespace wr::emulator
