#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "sim/robot/RemoteControl.hpp"
#include "sim/robot/Robot.hpp"
#include "sim/scenario/FrameFields.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "sim/scenario/Truth.hpp"

namespace wr {

/// @brief What happens to a robot at which time, and what is expected of it: what a PC does on its
/// line, what the remote control says, how the ground is and what breaks.
///
/// A scenario is a text of lines. Times are in ms since the robot was switched on, values are in
/// the units of the PC protocol. '#' begins a comment.
///
///     seed 7
///     at 0 connect
///     from 300 to 60000 every 100 order velocity 500 steering -200
///     at 900 expect state Working
///     at 900 expect velocity0 between 490 510
///     at 61000 end
///
/// Actions of the PC: connect (Hello, and Confirm as soon as the Welcome comes); hello; confirm;
/// keepalive; order with any of 'steering N', 'velocity N', 'tension N', 'current N' (for all
/// wheels, or four numbers, one for each wheel) and 'stop'; bytes with pairs of hexadecimal digits.
/// Orders are numbered from 1.
///
/// Actions of the world: rc velocity N steering N (the remote control sends this from now on); rc
/// off; slope PERCENT; noise on or off; fault and mend with one of 'hall WHEEL', 'hall-b WHEEL',
/// 'current WHEEL', 'angle', 'stall', 'block WHEEL'; mark (the field 'way' counts from here). 'seed
/// N' chooses the noise; it has no time and stands before all lines that have one.
///
/// Expectations: expect FIELD VALUE and expect FIELD between LOW HIGH look at the last Report or
/// Welcome, or at the robot itself (the fields of Truth.hpp); expect-silence MS (no report came for
/// so long); expect-finding ID (the simulated board stops before with this finding). The last line
/// is 'end'.
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
  struct RemoteControl {
    std::optional<sim::Sticks> sticks;
  };
  struct Slope {
    double percent;
  };
  struct Noise {
    bool on;
  };
  struct Fault {
    sim::Fault fault;
    std::size_t wheel;
    bool present;
  };
  struct Mark {};
  struct Expect {
    std::variant<const FrameField*, const TruthField*> field;
    std::int64_t low;
    std::int64_t high;
    std::string words;  ///< what is expected as it was written
  };
  struct ExpectSilence {
    Time duration;
  };
  struct ExpectFinding {
    std::string id;
  };
  using Action = std::variant<Connect, Hello, Confirm, KeepAlive, Order, Raw, RemoteControl, Slope,
                              Noise, Fault, Mark, Expect, ExpectSilence, ExpectFinding>;

  struct Step {
    Time at;
    int line;  ///< of the text
    Action action;
  };

  /// @brief A text that is no scenario: 'file:line: what is wrong'.
  class Error : public std::runtime_error {
   public:
    using std::runtime_error::runtime_error;
  };

  /// @brief Reads a scenario. Throws Error.
  /// @param text the lines
  /// @param name name of the text in errors
  Scenario(std::istream& text, std::string name);

  /// @brief Reads the scenario in a file. Throws Error.
  /// @param file the file
  [[nodiscard]] static Scenario load(const std::filesystem::path& file);

  /// @brief What happens, in the order of time.
  /// @return each step; those of one time in the order of their lines
  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }

  /// @brief Time at which the scenario ends.
  /// @return the time
  [[nodiscard]] Time end() const { return end_; }

  /// @brief Seed of the noise.
  /// @return the seed; nothing if the text has none
  [[nodiscard]] const std::optional<std::uint32_t>& seed() const { return seed_; }

  /// @brief Name of the text.
  /// @return the name
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  void readLine(const std::string& line, int number, bool& ended);

  std::string name_;
  std::vector<Step> steps_;
  Time end_{};
  std::optional<std::uint32_t> seed_;
};

}  // namespace wr
