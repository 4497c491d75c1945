#include "safety/WheelComparison.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace wr {

namespace {

constexpr std::int32_t kComparedWay = 20;  // [edges] distance of one comparison: 0.057 m

// In the tightest curve the slowest wheel moves 71 % of the mean distance. When the robot changes
// between forwards and backwards in a curve, this wheel can move less in one comparison.
constexpr std::int32_t kMinShareDivisor = 2;  // half of the mean distance

// While the steering angle does not exceed kStraight, no wheel needs a current above kHighCurrent
// for longer than 1 s. At a larger angle the set-points of a source can make the wheels work
// against each other for some time. Therefore the limit at a larger angle is 5 s.
constexpr Current kHighCurrent(11000);
constexpr Angle kStraight(1100);
constexpr std::uint8_t kCurveCycles = 50;
// In a cycle with a high current, the count of the wheel increases: by kStraightCycle while the
// steering angle does not exceed kStraight, otherwise by 1.
constexpr std::uint8_t kStraightCycle = 5;

bool isGreat(std::optional<Current> current) {
  const Current measured = current.value_or(Current());
  return measured > kHighCurrent || measured < -kHighCurrent;
}

}  // namespace

std::optional<std::uint8_t> WheelComparison::behind(const Measurements& measurements) {
  add(measurements);
  const std::int32_t way = common();
  if (std::abs(way) < kComparedWay) {
    return std::nullopt;
  }
  std::optional<std::uint8_t> result;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const std::int32_t own = way > 0 ? ways_[wheel] : -ways_[wheel];
    const bool late = std::abs(way) >= kMinShareDivisor * own;
    if (late && late_[wheel]) {
      result = static_cast<std::uint8_t>(wheel);
    }
    late_[wheel] = late;
  }
  ways_ = {};
  return result;
}

std::optional<std::uint8_t> WheelComparison::overloaded(const Measurements& measurements) {
  const Angle angle = measurements.steering.value_or(Angle());
  const bool straight = angle <= kStraight && angle >= -kStraight;
  std::optional<std::uint8_t> result;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const bool great = isGreat(measurements.wheels[wheel].current);
    const std::int32_t counted = straight ? kStraightCycle : 1;
    greatCycles_[wheel] = static_cast<std::uint8_t>(
        great ? std::min<std::int32_t>(greatCycles_[wheel] + counted, kCurveCycles) : 0);
    if (greatCycles_[wheel] >= kCurveCycles) {
      result = static_cast<std::uint8_t>(wheel);
    }
  }
  return result;
}

void WheelComparison::reset() {
  before_ = {};
  ways_ = {};
  late_ = {};
  greatCycles_ = {};
}

void WheelComparison::add(const Measurements& measurements) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const std::optional<HallCount>& position = measurements.wheels[wheel].position;
    if (position && before_[wheel]) {
      ways_[wheel] += edgesBetween(*before_[wheel], *position).count();
    }
    before_[wheel] = position;
  }
}

// Returns the mean of the two middle distances. The least and the greatest of the four distances
// are left out. Therefore one failed wheel does not change the mean much.
std::int32_t WheelComparison::common() const {
  const auto [least, greatest] = std::ranges::minmax(ways_);
  std::int32_t sum = 0;
  for (const std::int32_t way : ways_) {
    sum += way;
  }
  return (sum - least - greatest) / 2;
}

}  // namespace wr
