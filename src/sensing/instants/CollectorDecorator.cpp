#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

CollectorDecorator::CollectorDecorator(InstantCollector& wrapped) : wrapped_(wrapped) {}

void CollectorDecorator::collect(const Edge& edge) {
  wrapped_.collect(edge);
}

void CollectorDecorator::fill(Instants& instants) const {
  wrapped_.fill(instants);
}

}  // namespace wr
