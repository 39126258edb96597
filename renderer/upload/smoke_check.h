// Whether a device's shaders can go through smoke as finely as asked for.
#pragma once

#include "effects/effects.h"
#include "gpu/device.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight {

// DeviceError where the loops over steps and lights would be cut short (DeviceInfo::maxLoopPasses).
void checkSmokeLoops(const gpu::DeviceInfo& device, const Scene& scene, const Plan& plan,
                     const RenderSettings& settings);

}  // namespace crosslight
