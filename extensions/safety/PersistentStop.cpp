#include "safety/PersistentStop.hpp"

#include <optional>

#include "main_control/MainController.hpp"

namespace wr {

PersistentStop::PersistentStop(Mode& wrapped, StopMemory& memory)
    : ModeDecorator(ModeId::None, wrapped), memory_(memory), kept_(memory.stopped()) {}

void PersistentStop::serve() {
  ModeDecorator::serve();
  const bool stopped = stopOrdered();
  if (stopped != memory_.stopped()) {
    memory_.save(stopped);
  }
}

void PersistentStop::read(MainController& mCtrl) {
  ModeDecorator::read(mCtrl);
  const std::optional<SetPoints>& order = mCtrl.getData().setPoints();
  if (order && order->neutral() && !ModeDecorator::stopOrdered()) {
    kept_ = false;
  }
}

void PersistentStop::changeMode(MainController& /*mCtrl*/) {}

bool PersistentStop::stopOrdered() const {
  return kept_ || ModeDecorator::stopOrdered();
}

}  // namespace wr
