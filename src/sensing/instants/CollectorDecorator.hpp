#pragma once

#include "sensing/instants/InstantCollector.hpp"

namespace wr {

/// @brief A collector that extends another collector.
/// @function Forwards each call to the wrapped collector. Each subclass adds a value to the record.
/// @secret The operations that are forwarded to the wrapped collector unchanged.
/// @role{instant-collectors, Decorator}
class CollectorDecorator : public InstantCollector {
 public:
  void collect(const Edge& edge) override;
  void fill(Instants& instants) const override;

 protected:
  /// @param wrapped the extended collector
  explicit CollectorDecorator(InstantCollector& wrapped);
  ~CollectorDecorator() = default;

 private:
  InstantCollector& wrapped_;
};

}  // namespace wr
