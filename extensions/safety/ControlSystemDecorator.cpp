#include "safety/ControlSystemDecorator.hpp"

namespace wr {

ControlSystemDecorator::ControlSystemDecorator(ControlSystem& wrapped) : wrapped_(wrapped) {}

bool ControlSystemDecorator::completed(std::uint32_t cycle) const {
  return wrapped_.completed(cycle);
}

void ControlSystemDecorator::collect(Measurements& measurements, Outputs& outputs) const {
  wrapped_.collect(measurements, outputs);
}

ControlSystem& ControlSystemDecorator::wrapped() const {
  return wrapped_;
}

void ControlSystemDecorator::follow(const SetPoints& setPoints, std::uint32_t cycle) {
  wrapped_.control(setPoints, cycle);
}

void ControlSystemDecorator::stand(std::uint32_t cycle) {
  wrapped_.hold(cycle);
}

void ControlSystemDecorator::recover(std::uint32_t cycle) {
  wrapped_.acknowledge(cycle);
}

}  // namespace wr
