#include "sensing/instants/PeriodCollector.hpp"

namespace wr {

PeriodCollector::PeriodCollector(InstantCollector& wrapped) : CollectorDecorator(wrapped) {}

void PeriodCollector::collect(const Edge& edge) {
  CollectorDecorator::collect(edge);
  if (!edge.rising) {
    return;
  }
  if (rise_) {
    period_ = edge.at - *rise_;
  }
  rise_ = edge.at;
}

void PeriodCollector::fill(Instants& instants) const {
  CollectorDecorator::fill(instants);
  instants.period = period_;
}

}  // namespace wr
