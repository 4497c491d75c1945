#include "sensing/instants/BasicCollector.hpp"

namespace wr {

void BasicCollector::collect(const Edge& edge) {
  last_ = edge.at;
}

void BasicCollector::fill(Instants& instants) const {
  instants.last = last_;
}

}  // namespace wr
