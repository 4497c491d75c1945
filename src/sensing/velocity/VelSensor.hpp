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
/// @function Measures the velocity once per cycle from the edges since the last measurement and
/// writes it to a pipe; returns position and implausible edges of the same time.
/// @secret The time interval of a measurement, the velocity without edges, and the number of
/// implausible edges that makes it invalid.
/// @role{functions, Context}
class VelSensor final {
 public:
  /// @brief Binds the sensor.
  /// @param collector returns the edges
  /// @param function calculates the velocity; it rejects an impossible value
  /// @param timebase returns the time
  /// @param velocity receives the velocity, with the time of the measurement
  VelSensor(SensorCollector& collector, const Function& function, const Timebase& timebase,
            Pipe<Velocity>& velocity);

  VelSensor(const VelSensor&) = delete;
  VelSensor& operator=(const VelSensor&) = delete;

  /// @brief Reads the record of the edges, measures the velocity and writes it to the pipe. With
  /// new edges the velocity is the number of forward edges minus backward edges, divided by the
  /// time from the last old edge to the newest edge. After a standstill it is this number minus
  /// half an edge, divided by the time since the previous measurement. Without new edges it is the
  /// previous velocity. In all cases it is at most the velocity at which the next edge would come
  /// now. A falling velocity then does not jump when an edge comes at the moment of the
  /// measurement. It is 0 when no edge came for 500 ms.
  /// @errors The velocity is not written, and the value in the pipe becomes old, in three cases.
  /// The function rejects the velocity. More than 3 edges of the cycle were unclear. The wheel
  /// turned with 30 rpm or more, and more than 3 edges were unclear or reversed its direction.
  /// @return time of the measurement
  /// @isr{no}
  /// @satisfies FR-120
  /// @satisfies FR-122
  /// @satisfies FR-124
  /// @satisfies FR-220
  Instant measure();

  /// @brief Returns the position of the wheel at the last measurement.
  /// @return Hall edges since start, increasing forwards
  /// @isr{no}
  /// @satisfies FR-121
  [[nodiscard]] HallCount position() const;

  /// @brief Returns the number of implausible edges up to the last measurement.
  /// @return number since start, at most 65535
  /// @isr{no}
  /// @satisfies FR-123
  [[nodiscard]] std::uint16_t rejectedEdges() const;

 private:
  /// @brief Checks whether the edges of a record since the previous measurement are sufficient to
  /// measure a velocity.
  [[nodiscard]] bool plausible(const HallRecord& record) const;

  /// @brief Returns the velocity that the function calculates from a number of edges in a time;
  /// empty if it calculates no velocity.
  [[nodiscard]] std::optional<Velocity> velocity(std::int32_t edges, Microseconds elapsed) const;

  /// @brief Returns the velocity when edges came since the previous measurement.
  [[nodiscard]] std::optional<Velocity> withEdges(const Instants& instants, Instant now);

  /// @brief Returns the velocity when the wheel was at rest at the previous measurement. The
  /// wheel rested somewhere between two edges: on average the distance to the first edge is half of
  /// the distance between two edges.
  [[nodiscard]] std::optional<Velocity> fromStandstill(std::int32_t edges,
                                                       Microseconds elapsed) const;

  /// @brief Returns the velocity when no edge came since the previous measurement.
  [[nodiscard]] Velocity withoutEdges(Instant now);

  /// @brief Limits a velocity to the velocity that one more edge would give: a faster wheel would
  /// have caused this edge.
  [[nodiscard]] Velocity bounded(Velocity value, std::int32_t edges, Microseconds elapsed) const;

  SensorCollector& collector_;
  const Function& function_;
  const Timebase& timebase_;
  Pipe<Velocity>& pipe_;
  bool standing_ = true;         // no edge for so long that the wheel counts as being at rest
  Instant measuredAt_{};         // time of the previous measurement
  std::optional<Instant> edge_;  // newest edge at the previous measurement
  std::int32_t count_ = 0;       // count of edges at the previous measurement
  HallCount position_{};         // position at the last measurement
  std::uint32_t unclear_ = 0;    // unclear edges at the previous measurement
  std::uint32_t reversals_ = 0;  // reversals at the previous measurement
  Velocity velocity_{};          // velocity of the previous measurement
};

}  // namespace wr
