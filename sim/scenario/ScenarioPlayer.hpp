#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "sim/scenario/FrameFields.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "sim/scenario/RobotSession.hpp"
#include "sim/scenario/Scenario.hpp"

namespace wr::scenario {

/// @brief A player of scenarios. It plays two roles: the PC at the serial line of a robot, and the
/// surroundings of this robot.
class ScenarioPlayer {
 public:
  /// @brief Result of a scenario.
  struct Outcome {
    std::vector<std::string> failures;      ///< the failed expectations, each as 'file:line: text'
    std::optional<SessionFinding> finding;  ///< an unexpected finding
    std::uint64_t reports = 0;              ///< number of received reports
  };

  /// @brief Connects a PC to the serial line of a robot that was just switched on.
  /// @param scenario the scenario; it must outlive the player
  /// @param robot the robot
  /// @param reports receives each report as a text line of comma-separated values. The values are
  /// all fields of the report, the time [ms] at which the PC received the report, and the true
  /// values at this time. If the pointer is null, nothing is written
  ScenarioPlayer(const Scenario& scenario, RobotSession& robot, std::ostream* reports = nullptr);

  /// @brief Plays the scenario to its end, or until a finding stops the robot.
  [[nodiscard]] Outcome play();

  /// @brief Executes the next action if it is due. Otherwise, runs until the PC reads its serial
  /// line, or until an action is due.
  /// @return false when the scenario has ended or a finding has stopped the robot
  bool step();

  /// @brief Executes an action now, in addition to the steps of the scenario.
  void perform(const Scenario::Action& action);

  /// @brief Returns the last report without its CRC; nothing before the first report.
  [[nodiscard]] const std::optional<Bytes>& report() const { return report_; }

  /// @brief Returns the outcome up to now.
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }

 private:
  using Time = RobotSession::Time;

  /// An expectation that can still be met.
  struct Pending {
    Scenario::Expect expect;
    int line;
    Time since;
    double from;  ///< distance, m
  };

  bool glance(Time instant);
  void end();
  void listen();
  void take(const Bytes& body);
  void writeReport(const Bytes& body);
  [[nodiscard]] std::optional<double> valueOf(const Scenario::Expect& expect) const;
  [[nodiscard]] std::string mismatch(const Scenario::Expect& expect) const;
  void checkPending();
  [[nodiscard]] bool isLate(const Pending& pending) const;
  void fail(const std::string& what);
  [[nodiscard]] bool expectsFinding(const std::string& id, Time since) const;

  void act(const Scenario::Connect& action);
  void act(const Scenario::Hello& action);
  void act(const Scenario::Confirm& action);
  void act(const Scenario::KeepAlive& action);
  void act(const Scenario::Order& action);
  void act(const Scenario::Raw& action);
  void act(const Scenario::Replay& action);
  void act(const WorldAction& action);
  void act(const Scenario::Mark& action);
  void act(const Scenario::Expect& action);
  void act(const Scenario::ExpectSilence& action);
  void act(const Scenario::ExpectFinding& action);

  const Scenario& scenario_;
  RobotSession& robot_;
  std::ostream* reports_;
  PcSender pc_;
  Bytes line_;  // bytes of an incomplete frame
  std::optional<Bytes> welcome_;
  std::optional<Bytes> report_;
  Time reportAt_{};
  std::uint16_t orders_ = 0;
  double mark_ = 0;  // distance from which `way` is measured, m
  Bytes order_;      // the last order, as sent
  std::vector<Pending> pending_;
  bool confirms_ = false;  // true: the PC answers the next Welcome with Confirm
  int at_ = 0;             // number of the line in the text of the scenario
  std::size_t next_ = 0;   // next step of the scenario
  bool ended_ = false;
  Outcome outcome_;
};

}  // namespace wr::scenario
