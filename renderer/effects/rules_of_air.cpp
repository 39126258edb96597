// Rules on what surrounds the surfaces: environment, fog, smoke.
#include <fmt/format.h>

#include "effects/analysis.h"

namespace crosslight {
namespace {

std::string describeFog(const Atmosphere& a) {
  if (a.fogMode == FogMode::linear) return fmt::format("linear from {:g} to {:g}", a.fogStart, a.fogEnd);
  return fmt::format("{} of density {:g}", a.fogMode == FogMode::exp ? "exp" : "exp2", a.fogDensity);
}

}  // namespace

void judgeAir(Analysis& analysis) {
  const Atmosphere& a = analysis.scene.atmosphere;
  const bool around = a.environment.present();
  analysis.draft.add(Effect::environment, "environment", around,
                     around ? "the scene is lit by the environment " + a.environment.file.filename().string()
                            : "the scene has no environment");
  analysis.draft.add(Effect::fog, "fog", hasFog(a),
                     hasFog(a) ? "the scene has fog: " + describeFog(a) : "the scene has no fog");
  const bool smoke = hasSmoke(a.smoke), drawn = analysis.settings.method != Method::wireframe;
  analysis.draft.add(
      Effect::smoke, "smoke", smoke && drawn,
      !smoke ? "the scene has no smoke" : (drawn ? "the scene has smoke" : "wireframe draws edges without smoke"));
}

}  // namespace crosslight
