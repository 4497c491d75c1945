#include "sim/board_robot/CallTimeline.hpp"

#include "sim/emulator/EventTrace.hpp"

namespace wr::board_robot {

namespace {

constexpr std::uint32_t kFirstRanked = 16;

}  // namespace

CallTimeline::CallTimeline(BoardSession& robot, const std::filesystem::path& elf, Window window,
                           std::ostream& output)
    : robot_(robot), recorder_(elf, 0), window_(window), output_(output) {
  output_ << "time_ns,event,number,value\n";
  recorder_.onCall(
      [this](std::uint32_t function, bool left) { write(left ? "return" : "call", function, 0); });
  robot_.board.record(recorder_);
  robot_.onEvent([this](const emulator::Event& event) { take(event); });
}

void CallTimeline::take(const emulator::Event& event) {
  const bool entered = event.kind == emulator::Event::Kind::ExceptionEntered;
  const bool ranked = entered && event.number >= kFirstRanked;
  write(emulator::nameOf(event.kind), event.number,
        ranked ? robot_.board.priority(event.number) : event.value);
}

void CallTimeline::write(const char* event, std::uint32_t number, std::uint32_t value) {
  const auto now = robot_.board.now();
  if (now >= window_.from && now < window_.to) {
    output_ << now.count() << ',' << event << ',' << number << ',' << value << '\n';
  }
}

}  // namespace wr::board_robot
