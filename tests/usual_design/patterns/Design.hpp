#pragma once

#include "usual_design/patterns/PatternDesign.hpp"

namespace wr {

using Design = PatternDesign;

}  // namespace wr
