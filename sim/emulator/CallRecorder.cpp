#include "sim/emulator/CallRecorder.hpp"

#include <algorithm>
#include <utility>

namespace wr::emulator {

namespace {

constexpr std::uint64_t kLeft = std::uint64_t{1} << 63U;

}  // namespace

CallRecorder::CallRecorder(std::vector<std::uint32_t> functions, std::size_t most)
    : functions_(std::move(functions)), most_(most) {
  std::ranges::sort(functions_);
}

void CallRecorder::note(std::uint64_t event) {
  if (call_) {
    call_(static_cast<std::uint32_t>(event), (event & kLeft) != 0);
  }
  if (events_.size() == most_) {
    truncated_ = true;
  } else {
    events_.push_back(event);
  }
}

void CallRecorder::enter(const Call& call) {
  calls_.push_back(call);
  calls_.back().begin = events_.size();
  note(call.function);
}

void CallRecorder::leave() {
  note(calls_.back().function | kLeft);
  calls_.pop_back();
}

void CallRecorder::block(std::uint32_t address, std::uint32_t stack, std::uint32_t link) {
  // A function has returned if two conditions are true: a block begins at the return address of the
  // function, and the stack pointer is not below its value at the call.
  while (!calls_.empty() && calls_.back().returnsTo == address && calls_.back().stack <= stack) {
    leave();
  }
  if (std::ranges::binary_search(functions_, address)) {
    enter({.function = address, .returnsTo = link & ~1U, .stack = stack});
  }
}

void CallRecorder::exceptionEntered(std::uint32_t handler, std::uint32_t stack) {
  enter({.function = handler, .returnsTo = 0, .stack = stack});
}

void CallRecorder::exceptionLeft() {
  // Ends the handler. If the handler called a function that ended with a jump instead of a return,
  // calls_ still contains this call. In this case, the call also ends here.
  while (!calls_.empty()) {
    const bool handler = calls_.back().returnsTo == 0;
    const std::size_t begin = calls_.back().begin;
    leave();
    if (handler) {
      forgetRepeated(begin);
      return;
    }
  }
}

// Removes the calls of an interrupt if an earlier interrupt had the same calls. Without this
// removal, fast timers would fill the record with repeated calls.
void CallRecorder::forgetRepeated(std::size_t begin) {
  const auto first = events_.begin() + static_cast<std::ptrdiff_t>(begin);
  if (!truncated_ && !handled_.emplace(first, events_.end()).second) {
    events_.erase(first, events_.end());
  }
}

void CallRecorder::reset() {
  while (!calls_.empty()) {
    leave();
  }
}

void CallRecorder::clear() {
  events_.clear();
  handled_.clear();
  truncated_ = false;
  for (Call& call : calls_) {
    call.begin = 0;
  }
}

}  // namespace wr::emulator
