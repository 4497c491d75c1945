#pragma once

#include <cstdint>

namespace wr {

class PcConnection;
struct Frame;

/// @brief A state of the connection with the PC.
/// @function Handles the frames of the PC and checks the time limits, by the rules of one
/// connection state.
/// @secret The rules that differ between the states of the connection. If a state has no rule for a
/// frame, it counts this frame as unexpected.
/// @role{pc-mcu-connection, State}
///
/// @patternapp{pc-mcu-connection, State, PC-MCU connection}
/// @why The communication of the PC and the MCU depends on the state of the connection between
/// them. Because each state is a separate module, all rules of one state are in one place.
/// @changes A new state of the connection. A different behaviour of an existing state.
class ConnectionState {
 public:
  ConnectionState(const ConnectionState&) = delete;
  ConnectionState& operator=(const ConnectionState&) = delete;

  /// @brief Answers a Hello. There is no default implementation, because every state
  /// answers a Hello.
  /// @param connection the connection that received the frame
  /// @isr{no}
  virtual void hello(PcConnection& connection) = 0;

  /// @brief Handles a Confirm. The default drops the Confirm and counts it as unexpected.
  /// @param connection the connection that received the frame
  /// @param session number of the session that the PC accepts
  /// @return false when the frame was dropped
  /// @isr{no}
  /// @satisfies FR-47
  virtual bool confirm(PcConnection& connection, std::uint8_t session);

  /// @brief Handles a KeepAlive. The default drops the KeepAlive and counts it as unexpected.
  /// @param connection the connection that received the frame
  /// @return false when the frame was dropped
  /// @isr{no}
  /// @satisfies FR-47
  virtual bool keepAlive(PcConnection& connection);

  /// @brief Handles an order. The default drops the order and counts it as unexpected.
  /// @param connection the connection that received the frame
  /// @param frame frame that contains the order
  /// @return false when the frame was dropped
  /// @isr{no}
  /// @satisfies FR-47
  virtual bool order(PcConnection& connection, const Frame& frame);

  /// @brief Checks the time limits of the state. PcConnection calls this function before it handles
  /// a frame, and once in each cycle after the last frame. The default does nothing.
  /// @param connection the connection whose time limits are checked
  /// @isr{no}
  virtual void checkTime(PcConnection& connection);

  /// @brief Returns whether the PC is connected. The default returns false.
  /// @return true when the PC is connected
  /// @isr{no}
  [[nodiscard]] virtual bool connected() const;

 protected:
  ConnectionState() = default;
  ~ConnectionState() = default;
};

}  // namespace wr
