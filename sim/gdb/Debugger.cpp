#include "sim/gdb/Debugger.hpp"

#include <utility>

namespace wr::gdb {

namespace {

constexpr const char* kTrap = "05";
constexpr const char* kInterruptSignal = "02";
constexpr const char* kBeginning = "05replaylog:begin;";
// Number of instructions between two reads of the serial line to GDB. The computer executes these
// instructions in far less than 1 ms.
constexpr std::uint32_t kLook = 4096;

}  // namespace

Debugger::Debugger(Serve serve, std::function<bool()> asked)
    : serve_(std::move(serve)), asked_(std::move(asked)) {}

void Debugger::begin(emulator::DebugPort& port) {
  port_ = &port;
  nextChange_ = 0;
  ended_ = false;
  static_cast<void>(rules_.takeHit());
  rulesChanged();
  port_->onInstruction([this] { beforeInstruction(); });
}

void Debugger::end(const std::string& why) {
  ended_ = true;
  if (mode_ == Mode::Search) {
    endSearch();
  }
  stop(why);
}

void Debugger::rulesChanged() {
  if (rules_.watches()) {
    port_->onAccess([this](std::uint32_t address, std::uint32_t size, bool store) {
      rules_.accessed(address, size, store);
    });
  } else {
    port_->onAccess({});
  }
}

void Debugger::beforeInstruction() {
  const std::uint64_t position = port_->instructions();
  repeatChanges(position);
  switch (mode_) {
    case Mode::Return:
      if (position >= target_) {
        stop(why_);
      }
      return;
    case Mode::Search:
      lookBack(position);
      return;
    case Mode::Time:
      if (port_->now() >= until_ || wantsStop()) {
        stop(kTrap);
      }
      return;
    case Mode::Forward:
      lookAhead(position);
      return;
  }
}

void Debugger::repeatChanges(std::uint64_t position) {
  for (; nextChange_ < changes_.size() && changes_[nextChange_].position <= position;
       ++nextChange_) {
    changes_[nextChange_].apply(*port_);
  }
}

bool Debugger::wantsStop() {
  return ++looks_ % kLook == 0 && asked_();
}

void Debugger::lookAhead(std::uint64_t position) {
  if (const auto hit = rules_.takeHit()) {
    stop(kTrap + *hit);
  } else if (position != from_ && (steps_ || rules_.stopsAt(static_cast<std::uint32_t>(
                                                 port_->read(emulator::DebugPort::kPc))))) {
    stop(kTrap);
  } else if (wantsStop()) {
    stop(kInterruptSignal);
  }
}

// When the program runs backwards, a watchpoint stops it before the instruction with the access.
void Debugger::lookBack(std::uint64_t position) {
  if (const auto hit = rules_.takeHit()) {
    found_ = position - 1;
    why_ = kTrap + *hit;
  }
  if (position >= target_) {
    endSearch();
  }
  if (rules_.stopsAt(static_cast<std::uint32_t>(port_->read(emulator::DebugPort::kPc)))) {
    found_ = position;
    why_ = kTrap;
  }
}

void Debugger::endSearch() {
  mode_ = Mode::Return;
  target_ = found_.value_or(0);
  if (!found_) {
    why_ = kBeginning;
  }
  throw BeginsAgain();
}

// Discards the changes after the present position, because they belong to a discarded run.
void Debugger::stop(const std::string& why) {
  from_ = port_->instructions();
  std::erase_if(changes_, [this](const Change& each) { return each.position > from_; });
  nextChange_ = changes_.size();
  static_cast<void>(rules_.takeHit());
  mode_ = Mode::Forward;
  steps_ = false;
  serve_(why);
}

void Debugger::step() {
  steps_ = true;
}

void Debugger::stepBack() {
  mode_ = Mode::Return;
  target_ = from_ == 0 ? 0 : from_ - 1;
  why_ = from_ == 0 ? kBeginning : kTrap;
  throw BeginsAgain();
}

void Debugger::resumeBack() {
  mode_ = Mode::Search;
  target_ = from_;
  found_.reset();
  throw BeginsAgain();
}

void Debugger::runTo(std::chrono::nanoseconds time) {
  mode_ = Mode::Time;
  until_ = time;
  if (time <= port_->now()) {
    throw BeginsAgain();
  }
}

void Debugger::restart() {
  mode_ = Mode::Return;
  target_ = 0;
  why_ = kTrap;
  throw BeginsAgain();
}

void Debugger::leave() {
  rules_.clear();
  rulesChanged();
}

void Debugger::write(std::size_t number, std::uint64_t value) {
  port_->write(number, value);
  changes_.push_back(
      {from_, [number, value](emulator::DebugPort& port) { port.write(number, value); }});
  nextChange_ = changes_.size();
}

bool Debugger::writeMemory(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  if (!port_->writeMemory(address, bytes)) {
    return false;
  }
  changes_.push_back(
      {from_, [address, copy = std::vector(bytes.begin(), bytes.end())](emulator::DebugPort& port) {
         static_cast<void>(port.writeMemory(address, copy));
       }});
  nextChange_ = changes_.size();
  return true;
}

}  // namespace wr::gdb
