#pragma once

#include <cstdint>

namespace wr {

class PcConnection;
struct Frame;

/// @brief A state of the connection with the PC.
/// @function Handles each frame of the PC and checks the time by the rules of one state.
/// @secret The differences between the states of the connection. By default a frame is unexpected.
/// @role{pc-mcu-connection, State}
///
/// @patternapp{pc-mcu-connection, State, PC-MCU connection}
/// @why The communication of the PC and the MCU depends on the state of the connection between
/// them. Each state is a module, so the rules of one state are in one place.
/// @changes A new state of the connection. Another behaviour of a state.
class ConnectionState {
 public:
  ConnectionState(const ConnectionState&) = delete;
  ConnectionState& operator=(const ConnectionState&) = delete;

  /// @brief Answers a Hello. A Hello is answered in every state.
  /// @param connection the connection that received it
  /// @isr{no}
  virtual void hello(PcConnection& connection) = 0;

  /// @brief Handles a Confirm. By default, counts it as unexpected.
  /// @param connection the connection that received it
  /// @param session number of the session that the PC accepts
  /// @return false when the frame was dropped
  /// @isr{no}
  /// @satisfies FR-47
  virtual bool confirm(PcConnection& connection, std::uint8_t session);

  /// @brief Handles a KeepAlive. By default, counts it as unexpected.
  /// @param connection the connection that received it
  /// @return false when the frame was dropped
  /// @isr{no}
  /// @satisfies FR-47
  virtual bool keepAlive(PcConnection& connection);

  /// @brief Handles an order. By default, counts it as unexpected.
  /// @param connection the connection that received it
  /// @param frame the frame of the order
  /// @return false when the frame was dropped
  /// @isr{no}
  /// @satisfies FR-47
  virtual bool order(PcConnection& connection, const Frame& frame);

  /// @brief Checks how long the PC was silent. It is called for each frame with the time of its
  /// arrival, and once per cycle with the time of the clock pulse. Has no effect unless a state
  /// overrides it.
  /// @param connection the connection whose time is checked
  /// @isr{no}
  virtual void checkTime(PcConnection& connection);

  /// @brief Returns whether the PC is connected. By default, returns false.
  /// @return true when the PC is connected
  /// @isr{no}
  [[nodiscard]] virtual bool connected() const;

 protected:
  ConnectionState() = default;
  ~ConnectionState() = default;
};

}  // namespace wr
