#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "communication/framing/FrameDecoder.hpp"
#include "communication/framing/FrameEncoder.hpp"
#include "communication/pc_connection/ConnectionState.hpp"
#include "communication/serialization/ReportData.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "communication/serialization/SerialWriter.hpp"
#include "communication/serialization/Serializable.hpp"
#include "devices/SerialPort.hpp"
#include "services/StartRecord.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The serial link with the PC.
/// @function Receives frames from the PC, lets the state of the connection handle them, sends
/// frames to the PC, and counts errors.
/// @secret The steps by which the frames of one cycle are read from the serial line and passed to
/// the state of the connection.
/// @hides{communication/pc_connection/FirmwareIdentity.hpp}
/// @role{pc-mcu-connection, Context}
class PcConnection final {
 public:
  /// @param port serial line to the PC
  /// @param orders stores the newest order of the PC
  /// @param initial state of the connection at the start of the firmware
  /// @param start cause of the start of the firmware, which each Welcome reports
  PcConnection(SerialPort& port, SerialReader& orders, ConnectionState& initial,
               const StartRecord& start);

  PcConnection(const PcConnection&) = delete;
  PcConnection& operator=(const PcConnection&) = delete;

  /// @brief Sets the time of the clock pulse of the cycle. The age of an order is measured up to
  /// this time. After the last frame of the cycle, the silence of the PC is measured up to this
  /// time too.
  /// @param clockPulse clock pulse of the cycle
  /// @isr{no}
  /// @satisfies FR-20
  /// @satisfies FR-33
  void beginCycle(Instant clockPulse);

  /// @brief Serves the link: reads at most 1216 received bytes, and lets the state of the
  /// connection handle each frame. Then checks the time limits, measured up to the clock pulse, and
  /// sends a Welcome if a Hello requested a Welcome. The caller calls this function once in each
  /// cycle.
  /// @isr{no}
  /// @satisfies FR-35
  /// @satisfies FR-37
  /// @satisfies FR-49
  /// @satisfies FR-244
  /// @satisfies FR-245
  void service();

  /// @brief Returns whether the PC is connected.
  /// @return true when the PC is connected
  /// @isr{no}
  /// @satisfies FR-36
  [[nodiscard]] bool connected() const;

  /// @brief Sends a report if the PC is connected. If the serial port has no space for the whole
  /// report, drops and counts the report.
  /// @param report the report
  /// @return true when the whole report was passed to the port
  /// @isr{no}
  /// @satisfies FR-60
  /// @satisfies FR-64
  bool sendReport(const Serializable& report);

  /// @brief Returns the counts of the errors on the PC link since the start of the firmware.
  /// @return the counts; service() and sendReport() update them
  /// @isr{no}
  /// @satisfies FR-63
  [[nodiscard]] const LinkCounts& counts() const;

  /// @brief Sets the state of the connection. The states call this function.
  /// @param next the new state
  /// @isr{no}
  void changeState(ConnectionState& next);

  /// @brief Requests a Welcome. The last step of service() sends this Welcome. The session of the
  /// previous Welcome becomes invalid. The states call this function.
  /// @isr{no}
  /// @satisfies FR-30
  /// @satisfies FR-245
  void welcome();

  /// @brief Checks whether a session is the session of the newest Welcome. The states call this
  /// function.
  /// @param session number of a session
  /// @return true when the newest Welcome offered this session
  /// @isr{no}
  [[nodiscard]] bool offered(std::uint8_t session) const;

  /// @brief Stores an order as the newest order. If the order is stale or has a field out of range,
  /// drops and counts this order instead. The states call this function.
  /// @param frame frame that contains the order
  /// @return false when the order was dropped
  /// @isr{no}
  /// @satisfies FR-46
  /// @satisfies FR-243
  bool takeOrder(const Frame& frame);

  /// @brief Drops the newest order. The states call this function.
  /// @isr{no}
  void dropOrder();

  /// @brief Counts a frame that the state of the connection did not expect. The states call this
  /// function.
  /// @isr{no}
  /// @satisfies FR-47
  void countUnexpected();

  /// @brief Returns the time since the last accepted frame. The states call this function.
  /// @return time since the last byte of the last accepted frame [us]. While a frame is handled,
  /// this time is measured up to the last byte of the frame. After the last frame of a cycle, it is
  /// measured up to the clock pulse.
  /// @isr{no}
  /// @satisfies FR-33
  [[nodiscard]] Microseconds silence() const;

  /// @brief Returns the age of the newest Welcome. The states call this function.
  /// @return time since the clock pulse of the cycle that sent the Welcome [us], measured up to the
  /// same time as silence(); 0 while a requested Welcome is not yet sent
  /// @isr{no}
  /// @satisfies FR-32
  [[nodiscard]] Microseconds sinceWelcome() const;

 private:
  /// @brief Decodes received bytes. If they end a frame, handles the frame or counts its error.
  /// @param number number of bytes that were read into the storage of the decoder
  /// @satisfies FR-246
  /// @satisfies FR-251
  void receive(std::size_t number);

  /// @brief Handles a frame of another protocol version: answers a Hello, and counts any other
  /// frame.
  /// @satisfies FR-43
  /// @satisfies FR-246
  void handleUnknownVersion(const Frame& frame);

  /// @brief Drops and counts a frame if its type is unknown or its payload is too short. Otherwise
  /// lets the state of the connection handle the frame.
  /// @satisfies FR-248
  /// @satisfies FR-251
  /// @satisfies FR-44
  /// @satisfies FR-45
  /// @satisfies FR-48
  void handle(const Frame& frame);

  /// @brief Lets the state of the connection handle a frame. If the frame is an order that contains
  /// a stop, first latches the stop, in any state.
  /// @return false when the frame was dropped
  bool answer(const Frame& frame);

  /// @brief Records that a frame was accepted, and counts a gap in the sequence numbers before this
  /// frame.
  /// @satisfies FR-49
  /// @satisfies FR-243
  void noteAccepted(const Frame& frame);

  /// @brief Checks whether a sequence number is newer than the newest accepted number, that is,
  /// greater by 1 to 127, modulo 256.
  /// @satisfies FR-243
  [[nodiscard]] bool isNewer(std::uint8_t sequence) const;

  /// @brief Sends the Welcome that a Hello requested, and offers a new session. If the serial port
  /// has no space, sends nothing and offers no session.
  /// @satisfies FR-30
  /// @satisfies FR-76
  /// @satisfies FR-245
  void sendWelcome();

  /// @brief Returns the number of the session that the next Welcome offers.
  [[nodiscard]] std::uint8_t nextSession() const;

  /// @brief Writes the version and the build id of the firmware to the payload of the Welcome.
  void writeIdentity();

  /// @brief Writes three values to the payload of the Welcome: the lowest and the highest accepted
  /// protocol version, and the hash of the payload layouts.
  /// @satisfies FR-246
  void writeProtocol();

  /// @brief Writes two values to the payload of the Welcome: the cause of the last reset, and the
  /// fault that was recorded before this reset.
  /// @satisfies FR-76
  void writeStart();

  /// @brief Sends a frame with the payload that the writer contains. Before the first frame, also
  /// sends a zero byte, which ends a frame that the last reset may have interrupted.
  /// @return false when the serial port has no space for the frame; then the frame is not sent
  /// @satisfies FR-247
  /// @satisfies FR-252
  bool send(FrameType type);

  SerialPort& port_;
  SerialReader& orders_;
  ConnectionState* state_;
  const StartRecord& start_;
  FrameDecoder decoder_;
  FrameEncoder encoder_;
  SerialWriter writer_;
  LinkCounts counts_{};
  Instant clockPulse_{};    // clock pulse of this cycle
  Instant at_{};            // time up to which silence() and sinceWelcome() measure
  Instant lastAccepted_{};  // time at which the last accepted frame was received
  Instant welcomed_{};      // clock pulse of the cycle that sent the newest Welcome
  bool welcomeDue_ = false;
  std::uint8_t session_ = 0;  // session number of the newest Welcome
  std::optional<std::uint8_t> offered_;
  std::uint8_t newest_ = 0;    // sequence number of the newest accepted frame
  bool begun_ = false;         // the zero byte that precedes the first frame was sent
  std::uint8_t nextSent_ = 0;  // sequence number of the next frame to send
};

}  // namespace wr
