#include "construction/ControlSystemPoolBuilder.hpp"

#include "services/assertion.hpp"

namespace wr {

void ControlSystemPoolBuilder::buildPool() {
  pool_.emplace();
}

ControlSystemPool& ControlSystemPoolBuilder::pool() {
  require(pool_.has_value(), AssertId::PartMissing);
  return *pool_;
}

}  // namespace wr
