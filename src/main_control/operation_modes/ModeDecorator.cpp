#include "main_control/operation_modes/ModeDecorator.hpp"

namespace wr {

ModeDecorator::ModeDecorator(ModeId id, Mode& wrapped) : Mode(id), wrapped_(wrapped) {}

void ModeDecorator::serve() {
  wrapped_.serve();
}

bool ModeDecorator::newMessage() const {
  return wrapped_.newMessage();
}

void ModeDecorator::read(MainController& mCtrl) {
  wrapped_.read(mCtrl);
}

bool ModeDecorator::stopOrdered() const {
  return wrapped_.stopOrdered();
}

}  // namespace wr
