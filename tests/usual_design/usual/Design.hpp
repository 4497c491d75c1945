#pragma once

#include "usual_design/usual/UsualDesign.hpp"

namespace wr {

using Design = UsualDesign;

}  // namespace wr
