#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "communication/framing/FrameDecoder.hpp"
#include "communication/framing/FrameEncoder.hpp"
#include "communication/pc_connection/ConnectionState.hpp"
#include "communication/serialization/ReportData.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "communication/serialization/SerialWriter.hpp"
#include "communication/serialization/Serializable.hpp"
#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"
#include "services/StartRecord.hpp"

namespace wr {

/// @brief The link with the PC.
/// @function Receives and sends the frames of the PC link, lets the state of the connection answer
/// them, and counts what goes wrong.
/// @secret How the frames of one cycle are taken from the line and given to the state of the
/// connection.
/// @hides{communication/pc_connection/FirmwareIdentity.hpp}
/// @role{pc-mcu-connection, Context}
class PcConnection final {
 public:
  /// @brief Makes a connection.
  /// @param port serial line to the PC
  /// @param clock tells how long the PC is silent
  /// @param orders takes the orders of the PC
  /// @param initial state after start
  /// @param start why the firmware started; each Welcome tells it
  PcConnection(SerialPort& port, const Timebase& clock, SerialReader& orders,
               ConnectionState& initial, const StartRecord& start);

  PcConnection(const PcConnection&) = delete;
  PcConnection& operator=(const PcConnection&) = delete;

  /// @brief Serves the link: takes all received bytes, but at most 4096, lets the state answer each
  /// frame, and then look at the time. It is called once in each cycle.
  /// @isr{no}
  /// @satisfies FR-35
  /// @satisfies FR-37
  /// @satisfies FR-49
  void service();

  /// @brief Tells whether the PC is connected.
  /// @return true when the PC is connected
  /// @isr{no}
  /// @satisfies FR-36
  [[nodiscard]] bool connected() const;

  /// @brief Sends a report. Without a connection nothing is sent. A report for which the port has no
  /// room is dropped whole and counted.
  /// @param report the report
  /// @return true when the whole report was given to the port
  /// @isr{no}
  /// @satisfies FR-60
  /// @satisfies FR-64
  bool sendReport(const Serializable& report);

  /// @brief Tells what went wrong on the link since start.
  /// @return the counts, as they were at the end of the last service or report
  /// @isr{no}
  /// @satisfies FR-63
  [[nodiscard]] const LinkCounts& counts() const;

  /// @brief Sets the state of the connection. States call it.
  /// @param next the new state
  /// @isr{no}
  void changeState(ConnectionState& next);

  /// @brief Offers a new session to the PC, and tells it what it must know. States call it. When the
  /// port has no room, the Welcome is not sent, and the PC must ask again.
  /// @isr{no}
  /// @satisfies FR-30
  /// @satisfies FR-76
  void welcome();

  /// @brief Tells whether a session is the one that was offered last. States call it.
  /// @param session number of a session
  /// @return true when it is the one
  /// @isr{no}
  [[nodiscard]] bool offered(std::uint8_t session) const;

  /// @brief Takes an order as the newest one, or counts it as out of range. States call it.
  /// @param payload the bytes of the order
  /// @return false when the order was dropped
  /// @isr{no}
  /// @satisfies FR-46
  bool takeOrder(std::span<const std::uint8_t, SerialReader::kOrderLength> payload);

  /// @brief Drops the newest order. States call it.
  /// @isr{no}
  void dropOrder();

  /// @brief Counts a frame that a state did not expect. States call it.
  /// @isr{no}
  /// @satisfies FR-47
  void countUnexpected();

  /// @brief Tells how long no frame was accepted. States call it.
  /// @return time since the last accepted frame [us]
  /// @isr{no}
  [[nodiscard]] Microseconds silence() const;

 private:
  /// @brief Takes one byte, and handles the frame that it ends.
  void receive(std::uint8_t byte);

  /// @brief Drops and counts a frame of unknown type or wrong length; the state answers any other.
  /// @satisfies FR-44
  /// @satisfies FR-45
  /// @satisfies FR-48
  void handle(const Frame& frame);

  /// @brief Lets the state answer a frame.
  /// @return false when the frame was dropped
  bool answer(const Frame& frame);

  /// @brief Notes that a frame was accepted, and counts a gap before it.
  /// @satisfies FR-49
  void noteAccepted(const Frame& frame);

  /// @brief Writes the identity of the firmware.
  void writeIdentity();

  /// @brief Writes why the firmware started, and what ended it before.
  /// @satisfies FR-76
  void writeStart();

  /// @brief Sends the payload that the writer holds.
  /// @return false when the port has no room: nothing is sent
  bool send(FrameType type);

  static constexpr std::size_t kChunk = 64;

  SerialPort& port_;
  const Timebase& clock_;
  SerialReader& orders_;
  ConnectionState* state_;
  const StartRecord& start_;
  std::array<std::uint8_t, kChunk> chunk_{};  // what the port gave last
  FrameDecoder decoder_;
  FrameEncoder encoder_;
  SerialWriter writer_;
  LinkCounts counts_{};
  Instant lastAccepted_{};
  std::uint8_t session_ = 0;
  std::uint8_t nextReceived_ = 0;  // sequence number that the next accepted frame should have
  std::uint8_t nextSent_ = 0;      // sequence number of the next frame that is sent
};

}  // namespace wr
