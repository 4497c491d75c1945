#include "sensing/instants/CountCollector.hpp"

namespace wr {

CountCollector::CountCollector(InstantCollector& wrapped) : CollectorDecorator(wrapped) {}

void CountCollector::collect(const Edge& edge) {
  CollectorDecorator::collect(edge);
  count_ += static_cast<std::uint32_t>(edge.direction);
}

void CountCollector::fill(Instants& instants) const {
  CollectorDecorator::fill(instants);
  instants.count = static_cast<std::int32_t>(count_);
}

}  // namespace wr
