#include "sim/web/LiveRobot.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "sim/scenario/GroundTruth.hpp"

namespace wr::web {

namespace {

using scenario::Scenario;

constexpr std::uint32_t kFirstInterrupt = 16;
constexpr std::uint32_t kPulse = kFirstInterrupt + board_robot::BoardSession::kPulseInterrupt;
constexpr scenario::RobotSession::Time kOrderPeriod{100'000};
// If there is no clock pulse in this time, the board does not run control cycles.
constexpr scenario::RobotSession::Time kLongest{200'000};
constexpr std::size_t kMostCalls = 30'000;
constexpr std::uint64_t kLeft = std::uint64_t{1} << 63U;
constexpr std::uint32_t kHashBegin = 0x811C9DC5;
constexpr std::uint32_t kHashFactor = 0x01000193;

Scenario readScenario(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  return {lines, name};
}

Scenario::Action actionOf(const std::string& text) {
  const Scenario scenario = readScenario("at 0 " + text + "\nat 0 end\n", "action");
  if (scenario.steps().empty()) {
    throw Scenario::Error("'" + text + "' is not an action");
  }
  return scenario.steps().front().action;
}

}  // namespace

LiveRobot::LiveRobot(Setup setup)
    : setup_(std::move(setup)),
      scenario_(readScenario(setup_.scenario, setup_.name)),
      recorder_(setup_.functions, kMostCalls),
      session_(setup_.image, {.resetsAreFindings = setup_.resetsAreFindings}),
      line_(session_),
      player_(scenario_, line_, setup_.verifies ? &reports_ : nullptr),
      entries_(setup_.functions.size()),
      lastCalls_(setup_.functions.size()) {
  std::ranges::sort(setup_.functions);
  session_.onEvent([this](const emulator::Event& event) { take(event); });
  if (!setup_.functions.empty()) {
    recorder_.onCall([this](std::uint32_t function, bool left) {
      if (!left) {
        noteCall(function);
      }
    });
    session_.board.record(recorder_);
  }
}

LiveRobot::State LiveRobot::runCycle() {
  cycleEnded_ = false;
  const scenario::RobotSession::Time limit = line_.now() + kLongest;
  while (state_ == State::Runs && !cycleEnded_ && line_.now() < limit) {
    step();
  }
  if (!cycleEnded_) {
    endCycle();
  }
  return state_;
}

LiveRobot::State LiveRobot::runToEnd() {
  while (state_ == State::Runs) {
    step();
  }
  return state_;
}

void LiveRobot::step() {
  const bool goesOn = player_.step();
  sendOrder();
  if (session_.finding()) {
    state_ = State::Found;
  } else if (!goesOn) {
    state_ = State::Ended;
  }
}

void LiveRobot::perform(const std::string& action) {
  player_.perform(actionOf(action));
}

void LiveRobot::repeat(const std::string& order) {
  order_.reset();
  if (!order.empty()) {
    order_ = actionOf(order);
  }
}

void LiveRobot::sendOrder() {
  if (order_ && player_.report() && line_.now() >= orderAt_) {
    orderAt_ = line_.now() + kOrderPeriod;
    player_.perform(*order_);
  }
}

std::vector<double> LiveRobot::truth() {
  std::vector<double> values;
  for (const scenario::TruthField& field : scenario::truthFields()) {
    values.push_back(field.valueOf(session_.robot(), 0));
  }
  return values;
}

void LiveRobot::take(const emulator::Event& event) {
  if (setup_.verifies) {
    events_.add(event);
  }
  const bool entered = event.kind == emulator::Event::Kind::ExceptionEntered;
  if (entered && event.number == kPulse) {
    endCycle();
  }
  if (entered || event.kind == emulator::Event::Kind::ExceptionLeft) {
    switches_.push_back({.exception = event.number,
                         .entered = entered,
                         .at = static_cast<std::uint32_t>((event.at - pulseAt_).count())});
  }
}

void LiveRobot::noteCall(std::uint32_t function) {
  const auto found = std::ranges::lower_bound(setup_.functions, function);
  if (found == setup_.functions.end() || *found != function) {
    return;
  }
  LastCall& last = lastCalls_[static_cast<std::size_t>(found - setup_.functions.begin())];
  last.at = session_.board.now();
  for (unsigned number = 0; number < last.registers.size(); ++number) {
    last.registers[number] = session_.board.core(number);
  }
}

void LiveRobot::endCycle() {
  cycle_.calls.clear();
  cycle_.hash = kHashBegin;
  for (const std::uint64_t event : recorder_.events()) {
    const auto address = static_cast<std::uint32_t>(event & ~kLeft);
    const bool left = (event & kLeft) != 0;
    cycle_.calls.push_back(address | (left ? 1U : 0U));
    cycle_.hash = (cycle_.hash ^ cycle_.calls.back()) * kHashFactor;
    const auto function = std::ranges::lower_bound(setup_.functions, address);
    if (!left && function != setup_.functions.end() && *function == address) {
      ++entries_[static_cast<std::size_t>(function - setup_.functions.begin())];
    }
  }
  cycle_.truncated = recorder_.truncated();
  cycle_.switches = std::exchange(switches_, {});
  cycle_.lastCalls = lastCalls_;
  pulseAt_ = session_.board.now();
  recorder_.clear();
  const std::uint64_t now = session_.board.cycles();
  const std::uint64_t slept = session_.board.sleptCycles();
  cycle_.cycles = now - beganAt_;
  cycle_.awake = cycle_.cycles - (slept - sleptBefore_);
  beganAt_ = now;
  sleptBefore_ = slept;
  cycleEnded_ = true;
}

}  // namespace wr::web
