#include "upload/smoke_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace crosslight {

namespace {

// shaders/shade/smoke.glsl: of a step, and of a sample of the grid, loops over corners and channels included.
constexpr std::uint64_t kPassesPerStep = 16;
constexpr std::uint64_t kPassesPerSample = 10;

}  // namespace

void checkSmokeLoops(const gpu::DeviceInfo& device, const Scene& scene, const Plan& plan,
                     const RenderSettings& settings) {
  const Smoke& smoke = scene.atmosphere.smoke;
  if (!plan.has(Effect::smoke) || !hasSmoke(smoke) || device.maxLoopPasses == 0) return;
  const std::uint64_t towardsLight =
      smoke.densities.empty() ? 4 : 4 + kPassesPerSample * std::max(settings.smokeSteps / 2, 1u);
  // Rays with shadows go step by step; what is left are the steps before.
  const bool stepwise = plan.has(Effect::shadows);
  const std::uint64_t lights = stepwise ? 0 : scene.lights.size();
  const std::uint64_t passes = settings.smokeSteps * (kPassesPerStep + kPassesPerSample + lights * towardsLight);
  if (passes <= device.maxLoopPasses) return;
  throw DeviceError(
      fmt::format("smoke in {} steps lit by {} lights takes {} passes through a shader's loops, and this driver ({}) "
                  "ends them after "
                  "{}: ask for fewer steps (--set smoke-steps=8|16|32)",
                  settings.smokeSteps, scene.lights.size(), passes, device.driverName, device.maxLoopPasses));
}

}  // namespace crosslight
