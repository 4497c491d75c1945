#include "services/assertion.hpp"

#include <cstdio>
#include <cstdlib>

namespace wr {

void assertionFailed(AssertId id) {
  std::fprintf(stderr, "assertion %u failed\n", static_cast<unsigned>(id));
  std::abort();
}

}  // namespace wr
