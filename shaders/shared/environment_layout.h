// Where things lie in the texels of an environment (kBindEnvironment), one after the other.
#ifndef CROSSLIGHT_SHARED_ENVIRONMENT_LAYOUT_H
#define CROSSLIGHT_SHARED_ENVIRONMENT_LAYOUT_H
#include "types.h"

CL_SHARED_BEGIN
// The map: radiance, and in w the share of the row's luminance up to and with the texel. Then per row in x the share of
// all luminance up to and with it. Then maps of this size, all of directions as the map itself has them:
CL_CONST uint kEnvironmentWidth = 128u;
CL_CONST uint kEnvironmentHeight = 64u;
// one of irradiance over pi, and one per level: radiance seen in a GGX lobe that is looked at along its normal, of
// perceptual roughness level / kEnvironmentLevels. Last, kEnvironmentTable^2 texels by NoV and perceptual roughness,
// both from 0 to 1: the GGX lobe's integral without and with Schlick's weight, and (1 - VoH)^5 NoL / pi.
CL_CONST uint kEnvironmentLevels = 7u;
CL_CONST uint kEnvironmentTable = 32u;
CL_SHARED_END
#endif
