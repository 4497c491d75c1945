#include "sim/host/HostTimebase.hpp"

#include <ctime>

namespace wr::host {

namespace {

constexpr std::uint64_t kMicrosPerSecond = 1'000'000;
constexpr std::uint64_t kNanosPerMicro = 1000;

Instant monotonic() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return Instant(static_cast<std::uint64_t>(time.tv_sec) * kMicrosPerSecond +
                 static_cast<std::uint64_t>(time.tv_nsec) / kNanosPerMicro);
}

}  // namespace

RealTimebase::RealTimebase() : start_(monotonic()) {}

Instant RealTimebase::now() const {
  return Instant(0) + (monotonic() - start_);
}

void RealTimebase::sleepUntil(Instant instant) const {
  const std::uint64_t micros = start_.sinceStart() + instant.sinceStart();
  timespec time{};
  time.tv_sec = static_cast<std::time_t>(micros / kMicrosPerSecond);
  time.tv_nsec = static_cast<long>((micros % kMicrosPerSecond) * kNanosPerMicro);
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
}

}  // namespace wr::host
