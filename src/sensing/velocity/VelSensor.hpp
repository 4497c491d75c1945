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
/// @function Measures the velocity once a cycle from the edges since the last time and writes it to
/// a pipe; returns position and implausible edges of the same moment.
/// @secret Over which time the velocity is measured, its value without edges, and how many
/// implausible edges make it invalid.
/// @role{functions, Context}
class VelSensor final {
 public:
  /// @brief Binds the sensor.
  /// @param collector gives the edges
  /// @param function calculates the velocity; it refuses one that cannot be
  /// @param timebase gives the time
  /// @param velocity takes the velocity, with the time of the measurement
  VelSensor(SensorCollector& collector, const Function& function, const Timebase& timebase,
            Pipe<Velocity>& velocity);

  VelSensor(const VelSensor&) = delete;
  VelSensor& operator=(const VelSensor&) = delete;

  /// @brief Reads the record of the edges, measures the velocity and writes it to the pipe. With new
  /// edges it is their number,
  /// less those backwards, over the time from the edge before them to the newest; after a
  /// standstill, half an edge less over the time since the measurement before.
  /// Without new edges it is the velocity before. In all cases it is at most the velocity whose
  /// next edge would come now, so that an edge at the moment of the measurement changes a falling
  /// velocity by nothing. It is 0 once no edge came for 500 ms.
  /// @errors The velocity is not written, and the value in the pipe grows old, when the function
  /// refuses it, when more than 3 edges of the cycle were unclear, and when a wheel that turned
  /// with 30 rpm or more had more than 3 edges that were unclear or reversed its direction.
  /// @isr{no}
  /// @satisfies FR-120
  /// @satisfies FR-122
  /// @satisfies FR-124
  /// @satisfies FR-220
  void measure();

  /// @brief Returns the position of the wheel at the last measurement.
  /// @return Hall edges since start, rising forwards
  /// @isr{no}
  /// @satisfies FR-121
  [[nodiscard]] HallCount position() const;

  /// @brief Returns the number of implausible edges up to the last measurement.
  /// @return number since start, at most 65535
  /// @isr{no}
  /// @satisfies FR-123
  [[nodiscard]] std::uint16_t rejectedEdges() const;

 private:
  /// @brief Checks whether the edges since a record let a velocity be measured.
  [[nodiscard]] bool plausible(const HallRecord& before) const;

  /// @brief Velocity of a number of edges in a time, if the function gives one.
  [[nodiscard]] std::optional<Velocity> velocity(std::int32_t edges, Microseconds elapsed) const;

  /// @brief Velocity when edges came since the measurement before.
  [[nodiscard]] std::optional<Velocity> withEdges(const Instants& instants, Instant now);

  /// @brief Velocity when the wheel was at rest at the measurement before. It rested somewhere between two
  /// edges: the way to the first edge is half of one to the next, on average.
  [[nodiscard]] std::optional<Velocity> fromStandstill(std::int32_t edges,
                                                       Microseconds elapsed) const;

  /// @brief Velocity when no edge came since the measurement before.
  [[nodiscard]] Velocity withoutEdges(Instant now);

  /// @brief A velocity, but at most that of one edge more than came in a time: a faster wheel would
  /// have given that edge.
  [[nodiscard]] Velocity bounded(Velocity value, std::int32_t edges, Microseconds elapsed) const;

  SensorCollector& collector_;
  const Function& function_;
  const Timebase& timebase_;
  Pipe<Velocity>& pipe_;
  HallRecord record_{};          // of the last measurement
  bool standing_ = true;         // no edge for so long that the wheel counts as standing
  Instant measuredAt_{};         // time of the measurement before
  std::optional<Instant> edge_;  // newest edge at the measurement before
  std::int32_t count_ = 0;       // count of edges then
  Velocity velocity_{};          // velocity of the measurement before
};

}  // namespace wr
