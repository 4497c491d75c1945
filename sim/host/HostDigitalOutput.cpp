#include "sim/host/HostDigitalOutput.hpp"

#include <utility>

namespace wr::host {

void HostDigitalOutput::set(bool on) {
  const bool before = std::exchange(on_, on);
  if (on && !before && rise_) {
    rise_();
  }
}

void HostDigitalOutput::onRise(std::function<void()> call) {
  rise_ = std::move(call);
}

}  // namespace wr::host
