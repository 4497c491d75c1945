#include "sim/scenario/ScenarioPlayer.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace wr {

namespace {

// How long the PC does not look at its line.
constexpr RobotLine::Time kGlance{5'000};

void writeHeader(std::ostream& reports) {
  const char* separator = "";
  for (const FrameField& field : frameFields()) {
    if (field.type == kReportType) {
      reports << separator << field.name;
      separator = ",";
    }
  }
  reports << '\n';
}

void writeReport(std::ostream& reports, const Bytes& body) {
  const char* separator = "";
  for (const FrameField& field : frameFields()) {
    if (field.type == kReportType) {
      reports << separator << valueOf(body, field);
      separator = ",";
    }
  }
  reports << '\n';
}

std::string inMilliseconds(RobotLine::Time time) {
  return std::to_string(time.count() / 1000) + " ms";
}

}  // namespace

ScenarioPlayer::ScenarioPlayer(const Scenario& scenario, RobotLine& robot, std::ostream* reports)
    : scenario_(scenario), robot_(robot), reports_(reports) {
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
      writeReport(*reports_, body);
    }
  }
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

void ScenarioPlayer::act(const Scenario::Expect& action) {
  const FrameField& field = *action.field;
  const bool ofWelcome = field.type == kWelcomeType;
  const std::optional<Bytes>& body = ofWelcome ? welcome_ : report_;
  if (!body) {
    fail(field.name + " is unknown: no " + (ofWelcome ? "Welcome" : "Report") + " has come");
    return;
  }
  const std::int64_t found = valueOf(*body, field);
  if (found != action.value) {
    fail(field.name + " is " + std::to_string(found) + ", not " + action.word);
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
