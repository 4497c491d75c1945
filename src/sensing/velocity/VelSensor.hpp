#pragma once

#include <cstdint>
#include <optional>

#include "devices/Timebase.hpp"
#include "functions/Function.hpp"
#include "sensing/velocity/SensorCollector.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Sensor for velocity and position of a wheel.
/// @function In each cycle, measures the velocity from the edges since the last measurement, and
/// writes the velocity to a pipe. Returns the position and the number of implausible edges at the
/// time of the last measurement.
/// @secret The time interval of a measurement, the velocity of a cycle without edges, and the
/// number of implausible edges that makes a measurement invalid.
/// @role{functions, Context}
class VelSensor final {
 public:
  /// @param collector returns the edges
  /// @param function calculates the velocity; it rejects an impossible value
  /// @param timebase returns the time
  /// @param velocity pipe that receives the velocity and the time of the measurement
  VelSensor(SensorCollector& collector, const Function& function, const Timebase& timebase,
            Pipe<Velocity>& velocity);

  VelSensor(const VelSensor&) = delete;
  VelSensor& operator=(const VelSensor&) = delete;

  /// @brief Reads the record of the edges, measures the velocity and writes the velocity to the
  /// pipe. If edges occurred since the previous measurement, the velocity is a number of edges
  /// divided by a time. The number is the number of new forward edges minus the number of new
  /// backward edges. The time begins at the last edge of the previous measurement and ends at the
  /// newest edge. If the wheel was at rest at the previous measurement, the magnitude of the number
  /// is reduced by half an edge, and the time begins at the previous measurement and ends now. If
  /// no new edge occurred, the velocity is the previous velocity. The velocity is limited to the
  /// velocity at which the next edge would occur exactly now. Because of this limit, a falling
  /// velocity does not jump when an edge occurs at the moment of the measurement. The velocity is 0
  /// when no edge occurred for 500 ms.
  /// @errors The velocity is not written, and the value in the pipe becomes old, in three cases:
  /// (1) The function rejects the velocity. (2) More than 3 edges of the cycle were unclear. (3)
  /// One of the last two written velocities was 30 rpm or more, and the cycle had more than 3 edges
  /// that were unclear or reversals.
  /// @return time of the measurement
  /// @isr{no}
  /// @satisfies FR-120
  /// @satisfies FR-122
  /// @satisfies FR-124
  /// @satisfies FR-220
  Instant measure();

  /// @brief Returns the position of the wheel at the last measurement.
  /// @return number of forward Hall edges minus number of backward Hall edges, since start
  /// @isr{no}
  /// @satisfies FR-121
  [[nodiscard]] HallCount position() const;

  /// @brief Returns the number of implausible edges up to the last measurement.
  /// @return number since start, modulo 2^32
  /// @isr{no}
  /// @satisfies FR-123
  [[nodiscard]] std::uint32_t rejectedEdges() const;

 private:
  /// @brief Checks whether a velocity can be measured in spite of the implausible edges since the
  /// previous measurement.
  [[nodiscard]] bool plausible(const HallRecord& record) const;

  /// @brief Returns the velocity for a number of edges in a time. Returns an empty value if the
  /// velocity function calculates no velocity.
  [[nodiscard]] std::optional<Velocity> velocity(std::int32_t edges, Microseconds elapsed) const;

  /// @brief Returns the velocity of a wheel that had edges since the previous measurement.
  [[nodiscard]] std::optional<Velocity> withEdges(const Instants& instants, Instant now);

  /// @brief Returns the velocity of a wheel that was at rest at the previous measurement. The wheel
  /// rested at an unknown position between two edges. On average, the distance to the first edge
  /// was half of the distance between two edges.
  [[nodiscard]] std::optional<Velocity> fromStandstill(std::int32_t edges,
                                                       Microseconds elapsed) const;

  /// @brief Returns the velocity of a wheel that had no edge since the previous measurement.
  [[nodiscard]] Velocity withoutEdges(Instant now);

  /// @brief Computes a limited velocity. The limit is the velocity at which one more edge would
  /// have occurred in the same time. A faster wheel would have caused this additional edge.
  [[nodiscard]] Velocity bounded(Velocity value, std::int32_t edges, Microseconds elapsed) const;

  SensorCollector& collector_;
  const Function& function_;
  const Timebase& timebase_;
  Pipe<Velocity>& pipe_;
  bool standing_ = true;         // the wheel counts as being at rest
  Instant measuredAt_{};         // time of the previous measurement
  std::optional<Instant> edge_;  // newest edge at the previous measurement
  std::int32_t count_ = 0;       // count of edges at the previous measurement
  HallCount position_{};         // position at the last measurement
  std::uint32_t unclear_ = 0;    // unclear edges at the previous measurement
  std::uint32_t reversals_ = 0;  // reversals at the previous measurement
  Velocity velocity_{};          // newest written velocity
  Velocity velocityBefore_{};    // velocity that was written before velocity_
};

}  // namespace wr
