#include "sim/host/HostEdgeInput.hpp"

#include <utility>

#include "sim/host/HostScheduler.hpp"

namespace wr::host {

HostEdgeInput::HostEdgeInput(HostScheduler& scheduler, bool level)
    : scheduler_(scheduler), level_(level) {}

void HostEdgeInput::connect(std::function<void()> vector) {
  vector_ = std::move(vector);
}

void HostEdgeInput::drive(bool level) {
  if (std::exchange(level_, level) == level || !started_) {
    return;
  }
  edge_ = true;
  if (vector_) {
    scheduler_.interrupt(vector_);
  }
}

void HostEdgeInput::start() {
  started_ = true;
}

bool HostEdgeInput::level() const {
  return level_;
}

bool HostEdgeInput::acknowledge() {
  return std::exchange(edge_, false);
}

}  // namespace wr::host
