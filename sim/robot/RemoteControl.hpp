#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace wr::sim {

/// @brief What the sticks of the remote control say.
struct Sticks {
  double velocity = 0;  ///< share of full deflection, -1 to 1, positive forwards
  double steering = 0;  ///< share of full deflection, -1 to 1, positive left
};

/// @brief A change of the level of a pin of the remote control's receiver.
struct RcEdge {
  std::chrono::nanoseconds offset;  ///< since the begin of the step, less than 1 ms
  std::size_t channel;              ///< 0 velocity, 1 direction
  bool level;                       ///< from now on
};

/// @brief Remote control and its receiver: 50 pulses in a second on each of two pins, one after the
/// other, 1.0 to 2.0 ms long, 1.5 ms with the stick in the middle.
class RemoteControl {
 public:
  static constexpr std::chrono::milliseconds kPeriod{20};
  static constexpr std::chrono::microseconds kMiddle{1500};
  static constexpr std::chrono::microseconds kDeflection{500};

  /// @brief Moves the sticks. It counts from the next pulses on.
  /// @param sticks where they are; nothing: the remote control is off and sends no pulse
  void set(const std::optional<Sticks>& sticks) { sticks_ = sticks; }

  /// @brief Lets 1 ms pass.
  /// @return the edges in this time, in their order; valid until the next step
  std::span<const RcEdge> step();

 private:
  std::optional<Sticks> sticks_;
  std::array<std::chrono::nanoseconds, 2> falls_{};  // end of the pulse under way, 0 without one
  std::uint64_t steps_ = 0;
  std::vector<RcEdge> edges_;
};

}  // namespace wr::sim
