#include "sim/scenario/ScenarioPlayer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace wr {

namespace {

// How long the PC does not look at its line.
constexpr RobotLine::Time kGlance{5'000};

void writeHeader(std::ostream& reports) {
  for (const FrameField& field : frameFields()) {
    if (field.type == kReportType) {
      reports << field.name << ',';
    }
  }
  reports << "at_ms";
  for (const TruthField& field : truthFields()) {
    reports << ',' << field.name;
  }
  reports << '\n';
}

// A true value with one decimal.
std::string tenths(double value) {
  std::array<char, 32> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 1);
  return {text.data(), end};
}

std::string inMilliseconds(RobotLine::Time time) {
  return std::to_string(time.count() / 1000) + " ms";
}

}  // namespace

ScenarioPlayer::ScenarioPlayer(const Scenario& scenario, RobotLine& robot, std::ostream* reports)
    : scenario_(scenario), robot_(robot), reports_(reports) {
  if (scenario_.seed()) {
    robot_.robot().setSeed(*scenario_.seed());
  }
  if (reports_ != nullptr) {
    writeHeader(*reports_);
  }
}

ScenarioPlayer::Outcome ScenarioPlayer::play() {
  for (const Scenario::Step& step : scenario_.steps()) {
    if (!advance(step.at)) {
      return std::move(outcome_);
    }
    at_ = step.line;
    std::visit([this](const auto& action) { act(action); }, step.action);
  }
  advance(scenario_.end());
  return std::move(outcome_);
}

// Runs to an instant and reads what comes; false if a finding has stopped the robot.
bool ScenarioPlayer::advance(Time instant) {
  while (robot_.now() < instant) {
    const bool runs = robot_.runUntil(std::min(instant, robot_.now() + kGlance));
    listen();
    if (!runs) {
      const LineFinding found = robot_.finding().value();
      if (!expectsFinding(found.id, robot_.now())) {
        outcome_.finding = found;
      }
      return false;
    }
  }
  return true;
}

bool ScenarioPlayer::expectsFinding(const std::string& id, Time since) const {
  return std::ranges::any_of(scenario_.steps(), [&](const Scenario::Step& step) {
    const auto* const expected = std::get_if<Scenario::ExpectFinding>(&step.action);
    return expected != nullptr && expected->id == id && step.at >= since;
  });
}

void ScenarioPlayer::listen() {
  for (const std::uint8_t byte : robot_.takeSent()) {
    line_.push_back(byte);
    if (byte != 0) {
      continue;
    }
    try {
      for (const Bytes& body : bodies(std::exchange(line_, {}))) {
        take(body);
      }
    } catch (const std::exception& error) {
      fail("the robot sent something that is no frame (" + std::string(error.what()) + ")");
    }
  }
}

void ScenarioPlayer::take(const Bytes& body) {
  if (const auto welcome = welcomeOf(body)) {
    welcome_ = body;
    if (std::exchange(confirms_, false)) {
      robot_.send(pc_.confirm(welcome->session));
    }
  } else if (reportOf(body)) {
    report_ = body;
    reportAt_ = robot_.now();
    ++outcome_.reports;
    if (reports_ != nullptr) {
      writeReport(body);
    }
  }
}

void ScenarioPlayer::writeReport(const Bytes& body) {
  for (const FrameField& field : frameFields()) {
    if (field.type == kReportType) {
      *reports_ << wr::valueOf(body, field) << ',';
    }
  }
  *reports_ << robot_.now().count() / 1000;
  for (const TruthField& field : truthFields()) {
    *reports_ << ',' << tenths(field.valueOf(robot_.robot(), mark_));
  }
  *reports_ << '\n';
}

void ScenarioPlayer::fail(const std::string& what) {
  outcome_.failures.push_back(scenario_.name() + ":" + std::to_string(at_) + ": " + what + ", at " +
                              inMilliseconds(robot_.now()));
}

void ScenarioPlayer::act(const Scenario::Connect& /*action*/) {
  confirms_ = true;
  robot_.send(pc_.hello());
}

void ScenarioPlayer::act(const Scenario::Hello& /*action*/) {
  robot_.send(pc_.hello());
}

void ScenarioPlayer::act(const Scenario::Confirm& /*action*/) {
  if (!welcome_) {
    fail("no Welcome has come that could be confirmed");
    return;
  }
  robot_.send(pc_.confirm(welcomeOf(*welcome_)->session));
}

void ScenarioPlayer::act(const Scenario::KeepAlive& /*action*/) {
  robot_.send(pc_.keepAlive());
}

void ScenarioPlayer::act(const Scenario::Order& action) {
  PcOrder order = action.order;
  order.id = ++orders_;
  robot_.send(pc_.order(order));
}

void ScenarioPlayer::act(const Scenario::Raw& action) {
  robot_.send(action.bytes);
}

void ScenarioPlayer::act(const Scenario::RemoteControl& action) {
  robot_.remoteControl().set(action.sticks);
}

void ScenarioPlayer::act(const Scenario::Slope& action) {
  robot_.robot().setSlope(action.percent);
}

void ScenarioPlayer::act(const Scenario::Noise& action) {
  robot_.robot().setNoise(action.on);
}

void ScenarioPlayer::act(const Scenario::Fault& action) {
  robot_.robot().setFault(action.fault, action.wheel, action.present);
}

void ScenarioPlayer::act(const Scenario::Mark& /*action*/) {
  mark_ = robot_.robot().distance();
}

// The value in the last frame that has the field; a failure when none has come.
std::optional<std::int64_t> ScenarioPlayer::valueOf(const FrameField& field) {
  const bool ofWelcome = field.type == kWelcomeType;
  const std::optional<Bytes>& body = ofWelcome ? welcome_ : report_;
  if (!body) {
    fail(field.name + " is unknown: no " + (ofWelcome ? "Welcome" : "Report") + " has come");
    return std::nullopt;
  }
  return wr::valueOf(*body, field);
}

void ScenarioPlayer::act(const Scenario::Expect& action) {
  std::string found;
  bool holds = false;
  std::string_view name;
  if (const auto* const truth = std::get_if<const TruthField*>(&action.field)) {
    name = (*truth)->name;
    const double value = (*truth)->valueOf(robot_.robot(), mark_);
    found = tenths(value);
    holds = value >= static_cast<double>(action.low) && value <= static_cast<double>(action.high);
  } else {
    const FrameField& field = *std::get<const FrameField*>(action.field);
    const auto value = valueOf(field);
    if (!value) {
      return;
    }
    name = field.name;
    found = std::to_string(*value);
    holds = *value >= action.low && *value <= action.high;
  }
  if (!holds) {
    fail(std::string(name) + " is " + found + ", not " + action.words);
  }
}

void ScenarioPlayer::act(const Scenario::ExpectSilence& action) {
  if (report_ && robot_.now() - reportAt_ < action.duration) {
    fail("a report came at " + inMilliseconds(reportAt_));
  }
}

void ScenarioPlayer::act(const Scenario::ExpectFinding& action) {
  fail("there was no finding " + action.id);
}

}  // namespace wr
