#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/plant/Noise.hpp"

namespace wr::plant {

/// @brief Positions of the sticks of the remote control.
struct Sticks {
  double velocity = 0;  ///< share of full deflection, -1 to 1, positive forwards
  double steering = 0;  ///< share of full deflection, -1 to 1, positive left
};

/// @brief Positions of the enable switch of the remote control.
enum class EnablePosition : std::uint8_t {
  Stop,    ///< the robot shall stop: 1.1 ms
  Pc,      ///< the remote control sends no orders: 1.5 ms
  Drive,   ///< the remote control drives: 1.9 ms
  StopPc,  ///< the switch is between stop and pc: 1.3 ms
  PcDrive  ///< the switch is between pc and drive: 1.7 ms
};

/// @brief Output of a receiver when its transmitter is off.
enum class FailSafe : std::uint8_t {
  None,    ///< nothing
  Hold,    ///< the receiver repeats the last pulses
  Neutral  ///< the receiver sends pulses of 1.5 ms on each channel
};

/// @brief A change of the level of a pin of the remote control's receiver.
struct RcEdge {
  std::chrono::nanoseconds offset;  ///< time since the start of the step, less than 1 ms
  std::size_t channel;              ///< 0 velocity, 1 direction, 2 enable
  bool level;                       ///< level from now on
};

/// @brief Remote control and its receiver. Each of three pins has 50 pulses in a second. A pulse is
/// 1.0 to 2.0 ms long, and 1.5 ms with the stick in the middle.
///
/// At first only the enable switch sends, in the position Pc. The channels of the sticks send from
/// the first call of set() on. While the transmitter is on, the width of a pulse varies by up to 2
/// us; pulses that the receiver generates itself do not vary.
class RemoteControl {
 public:
  static constexpr std::size_t kChannels = 3;
  static constexpr std::chrono::milliseconds kPeriod{20};
  static constexpr std::chrono::microseconds kMiddle{1500};
  static constexpr std::chrono::microseconds kDeflection{500};
  static constexpr std::int64_t kJitter = 2;  ///< us

  /// @brief Moves the sticks, and switches the transmitter on. It takes effect with the next
  /// pulses.
  /// @param sticks positions of the sticks; nothing: the transmitter is off
  void set(const std::optional<Sticks>& sticks);

  /// @brief Turns the enable switch.
  /// @param position its position from now on
  void setEnable(EnablePosition position) { enable_ = position; }

  /// @brief Sets the output of the receiver when the transmitter is off; None at first.
  /// @param failSafe its behaviour
  void setFailSafe(FailSafe failSafe) { failSafe_ = failSafe; }

  /// @brief Adds the tremble of the operator's hand to the velocity stick.
  /// @param microseconds greatest change of the pulses of the velocity; 0 at first
  void setTremor(double microseconds) { tremor_ = microseconds; }

  /// @brief Lets the pulses of all channels begin at one time, or one after the other, which is the
  /// initial setting.
  /// @param coincident true: at one time
  void setCoincident(bool coincident) { coincident_ = coincident; }

  /// @brief Switches the noise of the pulses on or off. It is on at first.
  /// @param on true for on
  void setNoise(bool on) { noisy_ = on; }

  /// @brief Lets 1 ms pass.
  /// @return the edges in this time, in their order; valid until the next step
  std::span<const RcEdge> step();

 private:
  [[nodiscard]] std::optional<std::chrono::microseconds> widthOf(std::size_t channel);
  [[nodiscard]] std::optional<std::chrono::microseconds> sentWidth(std::size_t channel) const;
  [[nodiscard]] double tremble() const;
  [[nodiscard]] std::chrono::nanoseconds beginOf(std::size_t channel) const;

  Noise noise_{1};
  bool noisy_ = true;
  bool on_ = true;  // the transmitter is on
  bool coincident_ = false;
  double tremor_ = 0;
  std::optional<Sticks> sticks_;
  EnablePosition enable_ = EnablePosition::Pc;
  FailSafe failSafe_ = FailSafe::None;
  std::array<std::optional<std::chrono::microseconds>, kChannels> last_{};
  std::array<std::chrono::nanoseconds, kChannels> falls_{};  // end of the pulse; 0 without a pulse
  std::uint64_t steps_ = 0;
  std::vector<RcEdge> edges_;
};

}  // namespace wr::plant
