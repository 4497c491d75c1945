#include "sim/scenario/ScenarioPlayer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace wr::scenario {

namespace {

// Time between two reads of the PC's serial line.
constexpr RobotSession::Time kGlance{5'000};
// Time between two reads while at least one expectation is pending.
constexpr RobotSession::Time kClose{1'000};

void writeHeader(std::ostream& reports) {
  for (const FrameField& field : kFrameFields) {
    if (field.type == PcReport::kType) {
      reports << field.name << ',';
    }
  }
  reports << "at_ms";
  for (const TruthField& field : truthFields()) {
    reports << ',' << field.name;
  }
  reports << '\n';
}

// Returns the text of a true value with one decimal.
std::string tenths(double value) {
  std::array<char, 32> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 1);
  return {text.data(), end};
}

std::string inMilliseconds(RobotSession::Time time) {
  return std::to_string(time.count() / 1000) + " ms";
}

}  // namespace

ScenarioPlayer::ScenarioPlayer(const Scenario& scenario, RobotSession& robot, std::ostream* reports)
    : scenario_(scenario), robot_(robot), reports_(reports) {
  if (scenario_.seed()) {
    robot_.robot().setSeed(*scenario_.seed());
  }
  for (const WorldAction& action : scenario_.plant()) {
    act(action);
  }
  if (reports_ != nullptr) {
    writeHeader(*reports_);
  }
}

ScenarioPlayer::Outcome ScenarioPlayer::play() {
  while (step()) {
  }
  return std::move(outcome_);
}

bool ScenarioPlayer::step() {
  if (ended_) {
    return false;
  }
  const std::vector<Scenario::Step>& steps = scenario_.steps();
  const bool acts = next_ < steps.size();
  const Time instant = acts ? steps[next_].at : scenario_.end();
  if (robot_.now() < instant) {
    ended_ = !glance(instant);
  } else if (acts) {
    const Scenario::Step& step = steps[next_++];
    at_ = step.line;
    std::visit([this](const auto& action) { act(action); }, step.action);
  } else {
    end();
  }
  return !ended_;
}

void ScenarioPlayer::perform(const Scenario::Action& action) {
  std::visit([this](const auto& one) { act(one); }, action);
}

void ScenarioPlayer::end() {
  ended_ = true;
  for (const Pending& pending : pending_) {
    at_ = pending.line;
    fail(mismatch(pending.expect) + " at the end");
  }
}

// Runs until the next read of the serial line, or until the given time if this time is earlier.
// Then reads the received bytes. Returns false if a finding has stopped the robot.
bool ScenarioPlayer::glance(Time instant) {
  const Time length = pending_.empty() ? kGlance : kClose;
  const bool runs = robot_.runUntil(std::min(instant, robot_.now() + length));
  listen();
  checkPending();
  if (!runs) {
    const SessionFinding found = robot_.finding().value();
    if (!expectsFinding(found.id, robot_.now())) {
      outcome_.finding = found;
    }
  }
  return runs;
}

bool ScenarioPlayer::expectsFinding(const std::string& id, Time since) const {
  return std::ranges::any_of(scenario_.steps(), [&](const Scenario::Step& step) {
    const auto* const expected = std::get_if<Scenario::ExpectFinding>(&step.action);
    return expected != nullptr && expected->id == id && step.at >= since;
  });
}

void ScenarioPlayer::listen() {
  for (const std::uint8_t byte : robot_.takeSent()) {
    if (byte != 0) {
      line_.push_back(byte);
      continue;
    }
    const Bytes frame = std::exchange(line_, {});
    if (frame.empty()) {
      continue;  // this zero byte ends the bytes that were sent before the first frame
    }
    if (const FrameBody body = bodyOf(frame); body.damage.empty()) {
      take(body.bytes);
    } else {
      fail("the robot sent bytes that are not a frame (" + std::string(body.damage) + ")");
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
  for (const FrameField& field : kFrameFields) {
    if (field.type == PcReport::kType) {
      *reports_ << scenario::valueOf(body, field) << ',';
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
    fail("there is no Welcome to confirm");
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
  order.sentAt = static_cast<std::uint32_t>(robot_.now().count() / 1000);
  order_ = pc_.order(order);
  robot_.send(order_);
}

void ScenarioPlayer::act(const Scenario::Raw& action) {
  robot_.send(action.bytes);
}

void ScenarioPlayer::act(const Scenario::Replay& /*action*/) {
  if (order_.empty()) {
    fail("there is no earlier order to replay");
    return;
  }
  robot_.send(order_);
}

void ScenarioPlayer::act(const WorldAction& action) {
  scenario::act(action, robot_);
}

void ScenarioPlayer::act(const Scenario::Mark& /*action*/) {
  mark_ = robot_.robot().distance();
  robot_.robot().clearGreatestVelocity();
}

// Returns the present value of an expected field; nothing when no frame with this field was
// received.
std::optional<double> ScenarioPlayer::valueOf(const Scenario::Expect& expect) const {
  if (const auto* const truth = std::get_if<const TruthField*>(&expect.field)) {
    return (*truth)->valueOf(robot_.robot(), mark_);
  }
  const FrameField& field = *std::get<const FrameField*>(expect.field);
  const std::optional<Bytes>& body = field.type == PcWelcome::kType ? welcome_ : report_;
  return body ? std::optional(static_cast<double>(scenario::valueOf(*body, field))) : std::nullopt;
}

// Returns the reason why an expectation is not met; empty when it is met.
std::string ScenarioPlayer::mismatch(const Scenario::Expect& expect) const {
  const auto* const truth = std::get_if<const TruthField*>(&expect.field);
  const auto* const field = std::get_if<const FrameField*>(&expect.field);
  const std::string name((truth != nullptr) ? (*truth)->name : (*field)->name);
  const auto value = valueOf(expect);
  if (!value) {
    return name + " is unknown: no " + ((*field)->type == PcWelcome::kType ? "Welcome" : "Report") +
           " was received";
  }
  if (*value >= static_cast<double>(expect.low) && *value <= static_cast<double>(expect.high)) {
    return {};
  }
  const std::string found =
      truth != nullptr ? tenths(*value) : std::to_string(static_cast<std::int64_t>(*value));
  return name + " is " + found + ", not " + expect.words;
}

void ScenarioPlayer::act(const Scenario::Expect& action) {
  const std::string wrong = mismatch(action);
  if (wrong.empty()) {
    return;
  }
  if (action.within) {
    pending_.push_back({action, at_, robot_.now(), robot_.robot().distance()});
  } else {
    fail(wrong);
  }
}

bool ScenarioPlayer::isLate(const Pending& pending) const {
  const Scenario::Limit& limit = *pending.expect.within;
  if (limit.isWay) {
    return std::abs(robot_.robot().distance() - pending.from) * 1000 > limit.amount;
  }
  return static_cast<double>((robot_.now() - pending.since).count()) / 1000 > limit.amount;
}

// Removes the expectations that are met. Also removes the expectations whose limit has passed, and
// reports them as failures.
void ScenarioPlayer::checkPending() {
  std::erase_if(pending_, [this](const Pending& pending) {
    const std::string wrong = mismatch(pending.expect);
    const bool late = !wrong.empty() && isLate(pending);
    if (late) {
      at_ = pending.line;
      const Scenario::Limit& limit = *pending.expect.within;
      fail(wrong + " within " + tenths(limit.amount) + (limit.isWay ? " mm" : " ms"));
    }
    return late || wrong.empty();
  });
}

void ScenarioPlayer::act(const Scenario::ExpectSilence& action) {
  if (report_ && robot_.now() - reportAt_ < action.duration) {
    fail("a report was received at " + inMilliseconds(reportAt_));
  }
}

void ScenarioPlayer::act(const Scenario::ExpectFinding& action) {
  fail("there was no finding " + action.id);
}

}  // namespace wr::scenario
