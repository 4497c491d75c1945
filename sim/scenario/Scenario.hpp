#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "sim/scenario/FrameFields.hpp"
#include "sim/scenario/PcFrames.hpp"

namespace wr {

/// @brief What a PC does on its line to the robot at which time, and what it expects.
///
/// A scenario is a text of lines. Times are in ms since the robot was switched on, values are in
/// the units of the PC protocol. '#' begins a comment.
///
///     at 0 connect
///     from 300 to 60000 every 100 order velocity 500 steering -200
///     at 900 expect state Working
///     at 61000 end
///
/// Actions: connect (Hello, and Confirm as soon as the Welcome comes); hello; confirm; keepalive;
/// order with any of 'steering N', 'velocity N', 'tension N', 'current N' (for all wheels, or four
/// numbers, one for each wheel) and 'stop'; bytes with pairs of hexadecimal digits; expect FIELD
/// VALUE, which looks at the last Report or Welcome; expect-silence MS (no report came for so
/// long); expect-finding ID (the simulated board stops before with this finding); end. Orders are
/// numbered from 1. The last line is 'end'.
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
  struct Expect {
    const FrameField* field;
    std::int64_t value;
    std::string word;  ///< the value as it was written
  };
  struct ExpectSilence {
    Time duration;
  };
  struct ExpectFinding {
    std::string id;
  };
  using Action = std::variant<Connect, Hello, Confirm, KeepAlive, Order, Raw, Expect, ExpectSilence,
                              ExpectFinding>;

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

  /// @brief Name of the text.
  /// @return the name
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::vector<Step> steps_;
  Time end_{};
};

}  // namespace wr
