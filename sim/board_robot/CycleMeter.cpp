#include "sim/board_robot/CycleMeter.hpp"

#include <algorithm>
#include <string_view>

namespace wr::board_robot {

namespace {

constexpr unsigned kFirstInterrupt = 16;
constexpr unsigned kPulse = kFirstInterrupt + BoardSession::kPulseInterrupt;
// The main thread runs in this software interrupt.
constexpr unsigned kMainThread = kFirstInterrupt + 64;
// Data register of the serial port to the PC.
constexpr std::uint32_t kUart0Data = 0x4006A007;
// Lowest address of the stack, which is also the start of the RAM. The stack grows downwards from
// the initial stack pointer, which is the first word of the flash.
constexpr std::uint32_t kStack = 0x1FFF0000;
constexpr std::uint32_t kWord = 4;

CycleMeter::Cost operator-(const CycleMeter::Cost& left, const CycleMeter::Cost& right) {
  return {.cycles = left.cycles - right.cycles,
          .instructions = left.instructions - right.instructions};
}

CycleMeter::Cost& operator+=(CycleMeter::Cost& left, const CycleMeter::Cost& right) {
  left.cycles += right.cycles;
  left.instructions += right.instructions;
  return left;
}

template <typename Value>
void writeColumn(std::ostream& output, std::string_view name,
                 const std::vector<CycleMeter::Cycle>& cycles, Value value) {
  output << '"' << name << "\": [";
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    output << (i == 0 ? "" : ", ") << value(cycles[i]);
  }
  output << "],\n";
}

}  // namespace

CycleMeter::CycleMeter(BoardSession& robot, std::chrono::nanoseconds from, bool profiled)
    : robot_(robot), from_(from), profiled_(profiled) {
  for (std::uint32_t at = kStack; at < robot_.board.word(0); at += kWord) {
    stack_.push_back(robot_.board.word(at));
  }
  robot_.onEvent([this](const emulator::Event& event) { take(event); });
  robot_.board.onWrite([this](std::uint32_t address, unsigned /*size*/, std::uint32_t /*value*/) {
    if (address == kUart0Data) {
      reported();
    }
  });
}

void CycleMeter::take(const emulator::Event& event) {
  switch (event.kind) {
    case emulator::Event::Kind::LineRaised:
      if (event.number == kPulse && event.at >= from_) {
        pulse();
      }
      request(event.number);
      break;
    case emulator::Event::Kind::ExceptionEntered:
      enter(event.number);
      break;
    case emulator::Event::Kind::ExceptionLeft:
      leave();
      break;
    default:
      break;
  }
}

void CycleMeter::pulse() {
  charge();
  const Instant now = present();
  if (measures()) {
    cycle_.whole = now.passed - pulseAt_.passed;
    cycle_.whole.cycles -= now.slept - pulseAt_.slept;
    cycles_.push_back(cycle_);
  }
  begun_ = true;
  toReport_ = true;
  cycle_ = {};
  pulseAt_ = now;
  profileTo(true);
}

void CycleMeter::reported() {
  if (!toReport_) {
    return;
  }
  charge();
  cycle_.toReport = present().passed - pulseAt_.passed;
  cycle_.reported = true;
  toReport_ = false;
  profileTo(false);
}

void CycleMeter::request(unsigned number) {
  if (measures()) {
    Exception& one = exception(number);
    ++one.requests;
    if (!one.at) {
      one.at = robot_.board.cycles();
    }
  }
}

void CycleMeter::enter(unsigned number) {
  charge();
  active_.push_back(number);
  if (number == kPulse) {
    cycle_.pulseLatency = robot_.board.cycles() - pulseAt_.passed.cycles;
  }
  if (number == kMainThread && toReport_ && cycle_.startDelay == 0) {
    cycle_.startDelay = robot_.board.cycles() - pulseAt_.passed.cycles;
  }
  if (!measures()) {
    return;
  }
  Exception& one = exception(number);
  one.priority = robot_.board.priority(number);
  ++one.entries;
  if (one.at) {
    one.worstLatency = std::max(one.worstLatency, robot_.board.cycles() - *one.at);
    one.at.reset();
  }
}

void CycleMeter::leave() {
  charge();
  if (!active_.empty()) {
    active_.pop_back();
  }
}

// Updates the costs of the running exception: adds the processor cycles and the instructions since
// the last call of this function.
void CycleMeter::charge() {
  const Instant now = present();
  if (measures()) {
    Cost cost = now.passed - chargedAt_.passed;
    cost.cycles -= now.slept - chargedAt_.slept;
    Exception& one = exception(active_.empty() ? 0 : active_.back());
    one.whole += cost;
    if (toReport_) {
      one.toReport += cost;
    }
  }
  chargedAt_ = now;
}

CycleMeter::Exception& CycleMeter::exception(unsigned number) {
  if (number >= exceptions_.size()) {
    exceptions_.resize(number + 1);
  }
  return exceptions_[number];
}

std::map<unsigned, CycleMeter::Exception> CycleMeter::exceptions() const {
  std::map<unsigned, Exception> found;
  for (unsigned number = 0; number < exceptions_.size(); ++number) {
    const Exception& one = exceptions_[number];
    if (one.requests + one.entries + one.whole.cycles != 0) {
      found.emplace(number, one);
    }
  }
  return found;
}

void CycleMeter::profileTo(bool toReport) {
  if (profiled_) {
    robot_.board.noteExecuted(measures() ? profile_[toReport ? 1 : 0] : rest_);
  }
}

std::size_t CycleMeter::stackBytes() const {
  std::uint32_t at = kStack;
  const auto deepest = std::ranges::find_if(stack_, [&](std::uint32_t before) {
    const bool kept = robot_.board.word(at) == before;
    at += kWord;
    return !kept;
  });
  return static_cast<std::size_t>(stack_.end() - deepest) * kWord;
}

CycleMeter::Instant CycleMeter::present() const {
  return {.passed = {.cycles = robot_.board.cycles(), .instructions = robot_.board.instructions()},
          .slept = robot_.board.sleptCycles()};
}

void CycleMeter::write(std::ostream& output) const {
  output << "{\n\"clock_hz\": " << robot_.board.clockHz() << ",\n"
         << "\"simulated_ns\": " << robot_.board.now().count() << ",\n"
         << "\"stack_bytes\": " << stackBytes() << ",\n";
  writeColumn(output, "reported", cycles_, [](const Cycle& one) { return one.reported ? 1 : 0; });
  writeColumn(output, "report_cycles", cycles_,
              [](const Cycle& one) { return one.toReport.cycles; });
  writeColumn(output, "report_instructions", cycles_,
              [](const Cycle& one) { return one.toReport.instructions; });
  writeColumn(output, "awake_cycles", cycles_, [](const Cycle& one) { return one.whole.cycles; });
  writeColumn(output, "instructions", cycles_,
              [](const Cycle& one) { return one.whole.instructions; });
  writeColumn(output, "start_cycles", cycles_, [](const Cycle& one) { return one.startDelay; });
  output << "\"exceptions\": {";
  const char* comma = "\n";
  for (const auto& [number, one] : exceptions()) {
    output << comma << '"' << number << R"(": {"priority": )" << one.priority
           << ", \"entries\": " << one.entries << ", \"requests\": " << one.requests
           << ", \"worst_latency\": " << one.worstLatency << ", \"cycles\": " << one.whole.cycles
           << ", \"instructions\": " << one.whole.instructions
           << ", \"report_cycles\": " << one.toReport.cycles
           << ", \"report_instructions\": " << one.toReport.instructions << '}';
    comma = ",\n";
  }
  output << "},\n\"profile\": {";
  comma = "\n";
  for (std::size_t half = 0; half < emulator::ExecutedCode::kHalves; ++half) {
    const std::uint32_t address = emulator::ExecutedCode::addressOf(half);
    if (timesOf(address, false) + timesOf(address, true) != 0) {
      output << comma << '"' << address << "\": [" << timesOf(address, false) << ", "
             << timesOf(address, true) << ']';
      comma = ",\n";
    }
  }
  output << "}\n}\n";
}

}  // namespace wr::board_robot
