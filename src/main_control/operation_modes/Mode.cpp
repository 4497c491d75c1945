#include "main_control/operation_modes/Mode.hpp"

namespace wr {

Mode::Mode(ModeId id) : id_(id) {}

ModeId Mode::id() const {
  return id_;
}

}  // namespace wr
