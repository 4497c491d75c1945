#include "sim/emulator/StimulusQueue.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace wr::emulator {

void StimulusQueue::add(const Level& level) {
  // Most levels are added in the order of their times. Therefore the search begins at the end.
  auto place = levels_.end();
  while (place != levels_.begin() && std::prev(place)->at > level.at) {
    --place;
  }
  levels_.insert(place, level);
  next_ = std::min(next_, level.at);
}

void StimulusQueue::every(Time period, Time now, std::function<void()> call) {
  if (period <= Time(0)) {
    throw std::invalid_argument("a period must be longer than 0");
  }
  calls_.push_back({period, (now / period + 1) * period, std::move(call)});
  renew();
}

StimulusQueue::Call* StimulusQueue::firstCall() {
  const auto found = std::ranges::min_element(calls_, {}, &Call::at);
  return found == calls_.end() ? nullptr : &*found;
}

void StimulusQueue::renew() {
  const Call* call = firstCall();
  next_ =
      std::min(levels_.empty() ? kNever : levels_.front().at, call == nullptr ? kNever : call->at);
}

void StimulusQueue::advance(Time now) {
  while (next_ <= now) {
    if (!levels_.empty() && levels_.front().at == next_) {
      const Level level = levels_.front();
      levels_.pop_front();
      drive_(level);
    } else {
      Call& call = *firstCall();
      call.at += call.period;
      call.call();
    }
    renew();
  }
}

}  // namespace wr::emulator
