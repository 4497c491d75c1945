#include "safety/OrderStageDecorator.hpp"

namespace wr {

OrderStageDecorator::OrderStageDecorator(OrderStage& wrapped) : wrapped_(wrapped) {}

bool OrderStageDecorator::completed(std::uint32_t cycle) const {
  return wrapped_.completed(cycle);
}

void OrderStageDecorator::collect(Measurements& measurements, Outputs& outputs) const {
  wrapped_.collect(measurements, outputs);
}

OrderStage& OrderStageDecorator::wrapped() const {
  return wrapped_;
}

}  // namespace wr
