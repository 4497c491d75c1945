#include "sensing/instants/WidthCollector.hpp"

namespace wr {

WidthCollector::WidthCollector(InstantCollector& wrapped) : CollectorDecorator(wrapped) {}

void WidthCollector::collect(const Edge& edge) {
  CollectorDecorator::collect(edge);
  if (edge.rising) {
    rise_ = edge.at;
    return;
  }
  width_.reset();
  if (rise_) {
    width_ = edge.at - *rise_;
    rise_.reset();
  }
}

void WidthCollector::fill(Instants& instants) const {
  CollectorDecorator::fill(instants);
  instants.width = width_;
}

}  // namespace wr
