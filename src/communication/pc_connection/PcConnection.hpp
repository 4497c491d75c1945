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

/// @brief The link with the PC.
/// @function Receives and sends the frames of the PC link, lets the state of the connection handle
/// them, and counts errors.
/// @secret How the frames of one cycle are read from the line and passed to the state of the
/// connection.
/// @hides{communication/pc_connection/FirmwareIdentity.hpp}
/// @role{pc-mcu-connection, Context}
class PcConnection final {
 public:
  /// @brief Constructs a connection.
  /// @param port serial line to the PC
  /// @param orders receives the orders of the PC
  /// @param initial state after start
  /// @param start cause of the start of the firmware; each Welcome contains it
  PcConnection(SerialPort& port, SerialReader& orders, ConnectionState& initial,
               const StartRecord& start);

  PcConnection(const PcConnection&) = delete;
  PcConnection& operator=(const PcConnection&) = delete;

  /// @brief Sets the instant at which ages and silence are measured in this cycle.
  /// @param clockPulse clock pulse of the cycle
  /// @isr{no}
  /// @satisfies FR-20
  /// @satisfies FR-33
  void beginCycle(Instant clockPulse);

  /// @brief Serves the link. Reads at most 1216 received bytes, lets the state handle each frame,
  /// and checks the silence at the clock pulse. Sends a Welcome if a Hello requests it. The caller
  /// calls this function once in each cycle.
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

  /// @brief Sends a report. Without a connection nothing is sent. If the port has no space for the
  /// whole report, drops and counts the report.
  /// @param report the report
  /// @return true when the whole report was passed to the port
  /// @isr{no}
  /// @satisfies FR-60
  /// @satisfies FR-64
  bool sendReport(const Serializable& report);

  /// @brief Returns the counts of the faults on the link since start.
  /// @return the counts at the end of the last service or report
  /// @isr{no}
  /// @satisfies FR-63
  [[nodiscard]] const LinkCounts& counts() const;

  /// @brief Sets the state of the connection. States call it.
  /// @param next the new state
  /// @isr{no}
  void changeState(ConnectionState& next);

  /// @brief Requests a Welcome at the end of this service, and makes the session of the previous
  /// Welcome invalid. States call it.
  /// @isr{no}
  /// @satisfies FR-30
  /// @satisfies FR-245
  void welcome();

  /// @brief Checks whether a session is the session of the newest Welcome. States
  /// call it.
  /// @param session number of a session
  /// @return true when it is this session
  /// @isr{no}
  [[nodiscard]] bool offered(std::uint8_t session) const;

  /// @brief Stores an order as the newest order, or counts it as stale or out of range. States call
  /// it.
  /// @param frame the frame of the order
  /// @return false when the order was dropped
  /// @isr{no}
  /// @satisfies FR-46
  /// @satisfies FR-243
  bool takeOrder(const Frame& frame);

  /// @brief Drops the newest order. States call it.
  /// @isr{no}
  void dropOrder();

  /// @brief Counts a frame that a state did not expect. States call it.
  /// @isr{no}
  /// @satisfies FR-47
  void countUnexpected();

  /// @brief Returns the time without an accepted frame. States call it.
  /// @return time since the last byte of the last accepted frame [us]. It ends at the last byte of
  /// the present frame, or at the clock pulse after the frames of a cycle.
  /// @isr{no}
  /// @satisfies FR-33
  [[nodiscard]] Microseconds silence() const;

  /// @brief Returns the age of the newest Welcome. States call it.
  /// @return time since the clock pulse of the cycle that sent it [us], with the same end as
  /// silence(); 0 until a Welcome is sent
  /// @isr{no}
  /// @satisfies FR-32
  [[nodiscard]] Microseconds sinceWelcome() const;

 private:
  /// @brief Decodes bytes of a frame, and handles the frame when it has ended.
  /// @param number number of bytes that were read into the storage of the decoder
  /// @satisfies FR-246
  /// @satisfies FR-251
  void receive(std::size_t number);

  /// @brief Handles a frame of another version: answers a Hello, and counts any other frame.
  /// @satisfies FR-43
  /// @satisfies FR-246
  void handleUnknownVersion(const Frame& frame);

  /// @brief Drops and counts a frame of unknown type or with a payload that is too short. The state
  /// handles any other frame.
  /// @satisfies FR-248
  /// @satisfies FR-251
  /// @satisfies FR-44
  /// @satisfies FR-45
  /// @satisfies FR-48
  void handle(const Frame& frame);

  /// @brief Lets the state handle a frame.
  /// @return false when the frame was dropped
  bool answer(const Frame& frame);

  /// @brief Records that a frame was accepted, and counts a gap before it.
  /// @satisfies FR-49
  /// @satisfies FR-243
  void noteAccepted(const Frame& frame);

  /// @brief Checks whether a sequence number is 1 to 127 after the newest accepted number.
  /// @satisfies FR-243
  [[nodiscard]] bool isNewer(std::uint8_t sequence) const;

  /// @brief Sends the Welcome that a Hello requested, and offers its session. Without space in the
  /// port nothing is sent and no session is offered.
  /// @satisfies FR-30
  /// @satisfies FR-76
  /// @satisfies FR-245
  void sendWelcome();

  /// @brief Returns the session that the next Welcome offers.
  [[nodiscard]] std::uint8_t nextSession() const;

  /// @brief Writes the identity of the firmware.
  void writeIdentity();

  /// @brief Writes the versions of the protocol that are accepted, and the hash of the layout.
  /// @satisfies FR-246
  void writeProtocol();

  /// @brief Writes the cause of the start and the fault before it.
  /// @satisfies FR-76
  void writeStart();

  /// @brief Sends the payload in the writer. Before the first frame it sends a zero byte, which
  /// ends an unfinished frame of the firmware before this start.
  /// @return false when the port has no space: nothing is sent
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
  Instant at_{};            // time at which the present frame was received, or the time of the
                            // clock pulse
  Instant lastAccepted_{};  // time at which the last accepted frame was received
  Instant welcomed_{};      // clock pulse of the cycle that sent the newest Welcome
  bool welcomeDue_ = false;
  std::uint8_t session_ = 0;  // session number of the newest Welcome
  std::optional<std::uint8_t> offered_;
  std::uint8_t newest_ = 0;    // sequence number of the newest accepted frame
  bool begun_ = false;         // a frame was sent since start
  std::uint8_t nextSent_ = 0;  // sequence number of the next frame that is sent
};

}  // namespace wr
