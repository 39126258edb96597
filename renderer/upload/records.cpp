#include "upload/records.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "base/log.h"

namespace crosslight {
namespace {

// 1 - cos(angle) without cancellation.
float versineOf(double radians) {
  const double s = std::sin(0.5 * radians);
  return static_cast<float>(2.0 * s * s);
}

void setClassic(const Light& light, const ClassicLight& c, shared::LightRecord& r) {
  r.flags |= shared::kLightClassic;
  r.ambient = c.ambient;
  r.diffuse = c.diffuse;
  r.specular = c.specular;
  r.attenuation = c.attenuation;
  if (c.attenuation == glm::vec3(0.0f)) {
    logWarning("light '" + light.name + "': attenuation (0, 0, 0) divides by zero; taken as no attenuation");
    r.attenuation = {1.0f, 0.0f, 0.0f};
  }
  r.spotExponent = c.spotExponent;
  constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
  constexpr float kNoCone = 3.0f;  // no direction is that far
  r.outerVersine = c.spotCutoff >= 180.0f ? kNoCone : versineOf(c.spotCutoff * kRadiansPerDegree);
}

}  // namespace

std::vector<shared::LightRecord> makeLightRecords(const Scene& scene, const glm::dvec3& origin) {
  std::vector<shared::LightRecord> records;
  for (const Light& light : scene.lights) {
    shared::LightRecord r{};
    r.type = static_cast<std::uint32_t>(light.type);
    r.renderPosition = glm::vec3(light.worldPosition - origin);
    r.direction = glm::vec3(light.worldDirection);
    r.diffuse = light.color * light.intensity;
    r.specular = r.diffuse;
    r.attenuation = {1.0f, 0.0f, 0.0f};
    r.range = light.range.value_or(0.0f);
    r.innerVersine = versineOf(light.innerConeAngle);
    r.outerVersine = versineOf(light.outerConeAngle);
    if (light.classic) setClassic(light, *light.classic, r);
    r.areaU = glm::vec3(light.worldU);
    r.areaV = glm::vec3(light.worldV);
    r.areaRadius = static_cast<float>(light.radius);
    if (light.twoSided) r.flags |= shared::kLightTwoSided;
    records.push_back(r);
  }
  return records;
}

namespace {

void setFog(const Atmosphere& a, const RenderSettings& settings, shared::FrameRecord& f) {
  if (!hasFog(a)) return;
  f.fogMode = static_cast<std::uint32_t>(a.fogMode);
  const auto finite = [](double x) {  // shaders multiply it by zero
    return static_cast<float>(std::min(x, static_cast<double>(std::numeric_limits<float>::max())));
  };
  const bool linear = a.fogMode == FogMode::linear;
  f.fogColor = a.fogColor;
  f.fogScale = finite(linear ? 1.0 / (a.fogEnd - a.fogStart) : a.fogDensity);
  f.fogEnd = finite(a.fogEnd);
  f.fogByDepth = settings.fogDistance == FogDistance::depth ? 1u : 0u;
}

void setEnvironment(const Environment& around, const RenderSettings& settings, shared::FrameRecord& f) {
  if (!around.present()) return;
  constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
  const double turn = around.rotation + settings.environmentRotation * kRadiansPerDegree;
  f.environmentSize = {around.map->width, around.map->height};
  f.environmentTurn = {static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn))};
  f.environmentGain = static_cast<float>(around.intensity * settings.environmentIntensity);
}

// Steps are sampled at another place for every ray only where shadows have edges to hide.
void setSmoke(const Smoke& smoke, const RenderSettings& settings, bool shadows, const glm::dvec3& origin,
              shared::FrameRecord& f) {
  // Bodies that scatter are walked through alike.
  f.smokeSteps = settings.smokeSteps;
  f.smokeSeed = shadows ? static_cast<std::uint32_t>(settings.seed ^ settings.seed >> 32) | 1u : 0u;
  if (!hasSmoke(smoke)) return;
  f.smokeKind = static_cast<std::uint32_t>(smoke.shape);
  f.smokeCenter = glm::vec3(smoke.center - origin);
  f.smokeHalfSize =
      smoke.shape == SmokeShape::sphere ? glm::vec3(static_cast<float>(smoke.radius)) : glm::vec3(0.5 * smoke.size);
  f.smokeAbsorption = smoke.absorption;
  f.smokeScattering = smoke.scattering;
  f.smokeAnisotropy = smoke.anisotropy;
  f.smokeGridX = smoke.grid[0];
  f.smokeGridY = smoke.grid[1];
  f.smokeGridZ = smoke.grid[2];
}

static_assert(static_cast<std::uint32_t>(SmokeShape::none) == shared::kSmokeNone);
static_assert(static_cast<std::uint32_t>(SmokeShape::everywhere) == shared::kSmokeEverywhere);
static_assert(static_cast<std::uint32_t>(SmokeShape::box) == shared::kSmokeBox);
static_assert(static_cast<std::uint32_t>(SmokeShape::sphere) == shared::kSmokeSphere);
static_assert(static_cast<std::uint32_t>(FogMode::none) == shared::kFogNone);
static_assert(static_cast<std::uint32_t>(FogMode::linear) == shared::kFogLinear);
static_assert(static_cast<std::uint32_t>(FogMode::exp) == shared::kFogExp);
static_assert(static_cast<std::uint32_t>(FogMode::exp2) == shared::kFogExp2);

}  // namespace

glm::vec3 seenBackground(const Atmosphere& atmosphere, const RenderSettings& settings) {
  const bool covered = settings.fogDistance == FogDistance::ray && hasFog(atmosphere);
  return covered ? atmosphere.fogColor : atmosphere.background;
}

glm::dvec3 renderOrigin(const Camera& camera) { return glm::dvec3(camera.worldFromCamera[3]); }

// Lengyel 2005, "Oblique View Frustum Depth Projection and Clipping", for reversed Z: with z = w - s (n.p - c) the near
// plane is the given one, and depth still falls along every line of sight. s is as large as lets nothing that is seen
// have z < 0.
static void clipObliquely(const Scene& scene, const Camera& camera, const glm::dvec2& half, glm::dmat4& clip) {
  using glm::dvec3;
  const glm::dmat3 axes(camera.worldFromCamera);
  const dvec3 n(*camera.clipPlane), origin = renderOrigin(camera);
  const double c = camera.clipPlane->w - glm::dot(n, origin);
  const dvec3 right = glm::normalize(axes[0]) * half.x, up = glm::normalize(axes[1]) * half.y;
  const dvec3 forward = -glm::normalize(axes[2]);
  const DBounds& b = scene.worldBounds;
  const bool byBounds = camera.orthographic && !b.empty();
  double most = 0;
  for (int i = 0; i < 8; ++i) {
    const bool x = (i & 1) != 0, y = (i & 2) != 0, z = (i & 4) != 0;
    const dvec3 across = (x ? right : -right) + (y ? up : -up);
    dvec3 at = across + forward;  // a direction; parallel rays: a corner of what is seen
    if (camera.orthographic) at = across + forward * camera.zFar.value_or(camera.zNear + 1.0);
    if (byBounds) at = dvec3((x ? b.upper : b.lower).x, (y ? b.upper : b.lower).y, (z ? b.upper : b.lower).z) - origin;
    most = std::max(most, glm::dot(n, at) - (camera.orthographic ? c : 0.0));
  }
  const double s = most > 0 ? 1 / (most * (1 + 1e-6)) : 1.0;  // the margin is for rounding
  for (int i = 0; i < 3; ++i) clip[i][2] = clip[i][3] - s * n[i];
  clip[3][2] = clip[3][3] + s * c;
}

shared::FrameRecord makeFrameRecord(const Scene& scene, const RenderSettings& settings, const glm::vec2& sampleOffset) {
  const Camera& camera = scene.cameras[static_cast<std::size_t>(settings.camera)];
  const glm::dmat3 axes(camera.worldFromCamera);
  const glm::dvec3 right = glm::normalize(axes[0]), up = glm::normalize(axes[1]), forward = -glm::normalize(axes[2]);
  const double aspect = static_cast<double>(settings.width) / settings.height;
  const double halfY = camera.orthographic ? camera.yMag : std::tan(0.5 * camera.yFov);
  const double halfX = halfY * aspect;
  const double n = camera.zNear;

  // Rows of the projection act on (right, up, forward) coordinates x, y, d. Reversed Z: the near plane has depth 1.
  double depthOfD, depthConstant;
  if (camera.orthographic) {
    const double f = camera.zFar.value_or(n + 1.0);
    depthOfD = -1.0 / (f - n);
    depthConstant = f / (f - n);
  } else {
    const bool bounded = camera.zFar.has_value();
    depthOfD = bounded ? -n / (*camera.zFar - n) : 0.0;
    depthConstant = bounded ? n * *camera.zFar / (*camera.zFar - n) : n;
  }
  // The rasteriser samples at pixel centers: the image is moved so that the sample position lies there.
  const double moveX = -2.0 * (sampleOffset.x - 0.5) / settings.width;
  const double moveY = -2.0 * (sampleOffset.y - 0.5) / settings.height;
  glm::dmat4 clip(0.0);
  for (int i = 0; i < 3; ++i) {
    const double w = camera.orthographic ? 0.0 : forward[i];
    clip[i] = {right[i] / halfX + moveX * w, -up[i] / halfY + moveY * w, depthOfD * forward[i], w};
  }
  clip[3] = {camera.orthographic ? moveX : 0.0, camera.orthographic ? moveY : 0.0, depthConstant,
             camera.orthographic ? 1.0 : 0.0};

  if (camera.clipPlane) clipObliquely(scene, camera, {halfX, halfY}, clip);

  shared::FrameRecord f{};
  f.clipFromRender = glm::mat4(clip);
  f.cameraRight = glm::vec3(right);
  f.cameraUp = glm::vec3(up);
  f.cameraForward = glm::vec3(forward);
  f.imagePlaneHalf = glm::vec2(static_cast<float>(halfX), static_cast<float>(halfY));
  f.sampleOffset = sampleOffset;
  f.zNear = static_cast<float>(n);
  f.zFar = camera.zFar ? static_cast<float>(*camera.zFar) : std::numeric_limits<float>::infinity();
  f.orthographic = camera.orthographic ? 1u : 0u;
  f.infiniteViewer = settings.infiniteViewer ? 1u : 0u;
  f.resolution = {settings.width, settings.height};
  f.lightCount = static_cast<std::uint32_t>(scene.lights.size());
  f.twoSided = settings.twoSided == TwoSided::always ? 1u : 0u;
  f.ambient = scene.atmosphere.ambient;
  setEnvironment(scene.atmosphere.environment, settings, f);
  f.sampleSeed = static_cast<std::uint32_t>(settings.seed ^ (settings.seed >> 32));
  f.lightSamples = settings.lightSamples;
  f.background = seenBackground(scene.atmosphere, settings);
  setFog(scene.atmosphere, settings, f);
  const bool shadows = settings.method == Method::whitted && settings.shadows && !scene.lights.empty();
  setSmoke(scene.atmosphere.smoke, settings, shadows, renderOrigin(camera), f);
  f.fresnel = static_cast<std::uint32_t>(settings.fresnel);
  f.energyCompensation = settings.energyCompensation ? 1u : 0u;
  return f;
}

}  // namespace crosslight
