#include "main_control/operation_modes/BasicMode.hpp"

#include "communication/serialization/OrderMessage.hpp"
#include "main_control/MainController.hpp"

namespace wr {

BasicMode::BasicMode(Reader& reader) : Mode(ModeId::None), reader_(reader) {}

void BasicMode::serve() {}

bool BasicMode::newMessage() const {
  return reader_.available();
}

void BasicMode::read(MainController& mCtrl) {
  OrderMessage order;
  if (order.readFrom(reader_)) {
    mCtrl.getData().saveSetPoints(order.setPoints());
  }
}

void BasicMode::changeMode(MainController& /*mCtrl*/) {}

bool BasicMode::stopOrdered() const {
  return reader_.stopOrdered();
}

}  // namespace wr
