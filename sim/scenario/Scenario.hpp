#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/scenario/FrameFields.hpp"
#include "sim/scenario/GroundTruth.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "sim/scenario/Words.hpp"
#include "sim/scenario/WorldAction.hpp"

namespace wr::scenario {

/// @brief A list of events and expectations, each with its time. The events are orders of a PC, and
/// changes of the remote control, the ground and the faults.
///
/// A scenario is a text of lines. Times are in ms since the robot was switched on. Values have the
/// units of the PC protocol. The character '#' begins a comment.
///
///     seed 7
///     at 0 connect
///     from 300 to 60000 every 100 order velocity 500 steering -200
///     at 900 expect state Working
///     at 900 expect velocity0 between 490 510
///     at 61000 end
///
/// The actions of the PC are: 'connect' (sends Hello, and Confirm as soon as the Welcome is
/// received); 'arm' (connects, and then sends 13 neutral orders, one in each cycle, to arm the
/// robot); 'hello'; 'confirm'; 'keepalive'; 'order' with any of 'steering N', 'velocity N',
/// 'tension N', 'current N' (one number for all wheels, or four numbers, one for each wheel),
/// 'stop' and 'acknowledge'; 'replay' (sends the bytes of the last order again); 'bytes' with pairs
/// of hexadecimal digits. The first order has the number 1. Each further order has the next number.
///
/// The actions on the robot and its surroundings (actions of the world) are listed at
/// readWorldAction(). The action 'mark' restarts the measurement of the fields 'way' and
/// 'max_velocity'.
///
/// 'seed N' selects the noise. With 'plant varied', the seed also selects the parameters of the
/// robot. 'plant PARAMETER VALUE' sets one parameter. These lines must be before all lines that
/// have a time. 'at T plant PARAMETER VALUE' changes the parameter while the robot runs.
///
/// The expectations 'expect FIELD VALUE' and 'expect FIELD between LOW HIGH' check the last Report
/// or Welcome, or the robot itself (the fields of GroundTruth.hpp). With 'within N ms' or 'within N
/// mm' at the end of the line, the expectation must become true at least once within this time or
/// distance. The time or distance begins at the time of the line. 'expect-silence MS' checks that
/// no report was received for this duration. 'expect-finding ID' checks that the simulated board
/// stops with this finding before the time of the line. The last line is 'at T end'.
class Scenario {
 public:
  using Time = std::chrono::milliseconds;

  struct Connect {};
  struct Hello {};
  struct Confirm {};
  struct KeepAlive {};
  struct Order {
    PcOrder order;
  };
  struct Raw {
    Bytes bytes;
  };
  struct Replay {};
  struct Mark {};
  /// Limit within which an expectation must become true.
  struct Limit {
    double amount;
    bool isWay;  ///< true: distance in mm; false: time in ms
  };
  struct Expect {
    std::variant<const FrameField*, const TruthField*> field;
    std::int64_t low;
    std::int64_t high;
    std::string words;  ///< the value as in the text
    std::optional<Limit> within;
  };
  struct ExpectSilence {
    Time duration;
  };
  struct ExpectFinding {
    std::string id;
  };
  using Action = std::variant<Connect, Hello, Confirm, KeepAlive, Order, Replay, Raw, WorldAction,
                              Mark, Expect, ExpectSilence, ExpectFinding>;

  struct Step {
    Time at;
    int line;  ///< number of the line in the text
    Action action;
  };

  /// @brief The error of a text that is not a valid scenario. Its message is 'file:line: error'.
  using Error = ScenarioError;

  /// @brief Reads a scenario. Throws Error.
  /// @param text the lines of the scenario
  /// @param name name of the text in error messages
  Scenario(std::istream& text, std::string name);

  /// @brief Reads the scenario in a file. Throws Error.
  [[nodiscard]] static Scenario load(const std::filesystem::path& file);

  /// @brief Returns the steps in the order of time.
  /// @return the steps; steps with the same time are in the order of their lines
  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }

  /// @brief Returns the time at which the scenario ends.
  [[nodiscard]] Time end() const { return end_; }

  /// @brief Returns the seed of the noise.
  /// @return the seed; nothing if the text has no seed
  [[nodiscard]] const std::optional<std::uint32_t>& seed() const { return seed_; }

  /// @brief Returns the settings of the robot.
  /// @return actions that are executed before all others
  [[nodiscard]] const std::vector<WorldAction>& plant() const { return plant_; }

  /// @brief Returns the name of the text.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  void readLine(const std::string& line, int number, bool& ended);
  void readHead(Words& words);
  void readTimed(Words& words, int number, bool& ended);
  void addArming(Time at, int number);

  std::string name_;
  std::vector<Step> steps_;
  Time end_{};
  std::optional<std::uint32_t> seed_;
  std::vector<WorldAction> plant_;
};

}  // namespace wr::scenario
