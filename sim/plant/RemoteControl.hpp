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
  double velocity = 0;  ///< fraction of the full deflection, -1 to 1, positive forwards
  double steering = 0;  ///< fraction of the full deflection, -1 to 1, positive left
};

/// @brief Positions of the enable switch of the remote control.
enum class EnablePosition : std::uint8_t {
  Stop,    ///< the robot shall stop
  Pc,      ///< the remote control sends no orders
  Drive,   ///< the remote control drives the robot
  StopPc,  ///< the switch is between stop and pc
  PcDrive  ///< the switch is between pc and drive
};

/// @brief Output of a receiver when its transmitter is off.
enum class FailSafe : std::uint8_t {
  None,    ///< the receiver sends no pulses
  Hold,    ///< the receiver repeats the last pulses
  Neutral  ///< the receiver sends pulses of 1.5 ms on each channel
};

/// @brief A change of the level of a pin of the remote control's receiver.
struct RcEdge {
  std::chrono::nanoseconds offset;  ///< time since the start of the step, less than 1 ms
  std::size_t channel;              ///< 0 velocity, 1 direction, 2 enable
  bool level;                       ///< level after the change
};

/// @brief The remote control and its receiver with three channels. A channel has 50 pulses in a
/// second. A pulse has a width of 1.0 ms to 2.0 ms. With the stick in the middle, the width is
/// 1.5 ms.
///
/// At first, only the channel of the enable switch has pulses, and the switch is in the position
/// Pc. The first call of set() with positions connects the channels of the sticks. While the
/// transmitter is on, the width of a pulse varies by up to 2 us. If the receiver itself generates
/// the pulses, their width does not vary.
class RemoteControl {
 public:
  static constexpr std::size_t kChannels = 3;
  static constexpr std::chrono::milliseconds kPeriod{20};
  static constexpr std::chrono::microseconds kMiddle{1500};
  static constexpr std::chrono::microseconds kDeflection{500};
  static constexpr std::int64_t kJitter = 2;  ///< [us]

  /// @brief Sets the positions of the sticks and switches the transmitter on. Without positions,
  /// switches the transmitter off. The change takes effect with the next pulses.
  /// @param sticks positions of the sticks; nothing: the transmitter is off
  void set(const std::optional<Sticks>& sticks);

  /// @brief Turns the enable switch.
  /// @param position new position of the switch
  void setEnable(EnablePosition position) { enable_ = position; }

  /// @brief Sets the output of the receiver while the transmitter is off. The initial output is
  /// None.
  /// @param failSafe output of the receiver while the transmitter is off
  void setFailSafe(FailSafe failSafe) { failSafe_ = failSafe; }

  /// @brief Adds the trembling of the operator's hand to the velocity stick.
  /// @param microseconds greatest change of the width of the velocity pulses; initially 0
  void setTremor(double microseconds) { tremor_ = microseconds; }

  /// @brief Selects whether the pulses of all channels begin at the same time or one after the
  /// other. Initially, they begin one after the other.
  /// @param coincident true: the pulses begin at the same time
  void setCoincident(bool coincident) { coincident_ = coincident; }

  /// @brief Switches the noise of the pulses on or off. The noise is initially on.
  /// @param on true for on
  void setNoise(bool on) { noisy_ = on; }

  /// @brief Advances the time by 1 ms.
  /// @return the edges in this time, in the order of time; the result is valid until the next step
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
