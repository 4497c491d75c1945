#include "sim/emulator/EventTrace.hpp"

#include <array>
#include <cstddef>

namespace wr::emulator {

namespace {

constexpr std::array<const char*, 8> kKinds{"exception_entered", "exception_left", "reset",
                                            "pin_changed",       "byte_sent",      "pwm_changed",
                                            "line_raised",       "byte_received"};

}  // namespace

const char* nameOf(Event::Kind kind) {
  return kKinds.at(static_cast<std::size_t>(kind));
}

EventTrace::EventTrace(std::ostream* lines) : lines_(lines) {
  if (lines_ != nullptr) {
    *lines_ << "time_ns,event,number,value\n";
  }
}

void EventTrace::add(const emulator::Event& event) {
  const auto kind = static_cast<std::size_t>(event.kind);
  ++events_;
  mix(kind);
  mix(static_cast<std::uint64_t>(event.at.count()));
  mix(event.number);
  mix(event.value);
  if (lines_ != nullptr) {
    *lines_ << event.at.count() << ',' << nameOf(event.kind) << ',' << event.number << ','
            << event.value << '\n';
  }
}

void EventTrace::mix(std::uint64_t value) {
  for (unsigned shift = 0; shift < 64; shift += 8) {
    hash_ = (hash_ ^ (value >> shift & 0xFFU)) * 0x100000001B3U;
  }
}

}  // namespace wr::emulator
