#pragma once

#include <filesystem>
#include <string>

#include "sim/scenario/RobotSession.hpp"

namespace wr::scenario {

/// @brief A datagram socket that accepts actions of a scenario while the robot runs in real time.
///
/// Each datagram is one action of a scenario without its time, for example "rc off", "fault hall 0"
/// or "expect true_velocity0 between 5 3000". The answer is "ok" or the error message. A sender
/// gets no answer if it has not bound its socket to a path. Actions of the PC are rejected, because
/// the PC link is in use. Actions that need a scenario, for example 'mark', are also rejected.
class ControlChannel {
 public:
  /// @brief Opens the socket. Throws std::system_error when this fails.
  /// @param path path of the socket. An old socket with this path is replaced. If the path is
  /// empty, no socket is opened
  /// @param robot robot on which the actions are executed
  ControlChannel(std::filesystem::path path, RobotSession& robot);
  ControlChannel(const ControlChannel&) = delete;
  ControlChannel& operator=(const ControlChannel&) = delete;
  ~ControlChannel();

  /// @brief Executes the actions that have arrived, and answers them.
  void serve();

  /// @brief Executes one action.
  /// @param words the action
  /// @return "ok" or the error message
  [[nodiscard]] std::string perform(const std::string& words);

 private:
  std::filesystem::path path_;
  RobotSession& robot_;
  int socket_ = -1;
};

}  // namespace wr::scenario
