// --effects within=E: what is left out because a bound on what it brings is proven to be small.
#pragma once

#include "effects/analysis.h"

namespace crosslight {

// Cuts the ray tree of mirrors, at depth 0 reflection as a whole. Nothing, with the reason, where no bound is known.
void leaveOutWithin(const Analysis& analysis, Plan& plan);

}  // namespace crosslight
