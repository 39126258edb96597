// What lies behind surfaces that light passes straight: the camera sees it directly, in both worlds by the same rules;
// a mirror shows it as it shows everything else.
#include "support/stage.h"

namespace crosslight::testing {
namespace {

constexpr float kThrough = 0.5f;
constexpr double kRounding = 16 * 0x1p-24;  // a dozen sums and products of values around 1

// Brings no light of its own.
Material pane() {
  Material m = emitter(0.0f);
  m.classic.transparency = kThrough;
  return m;
}

Difference rasterAgainstRays(const Scene& scene, const std::function<void(RenderSettings&)>& change = {}) {
  RenderSettings s = settingsFor(Method::phong, 60, 40);
  if (change) change(s);
  const Image raster = render(device(), scene, s).image;
  s.method = Method::whitted;
  s.shadows = false;
  const auto all = [](std::uint32_t, std::uint32_t) { return true; };
  return largestDifference(raster, render(device(), scene, s).image, all);
}

// By light that depends on the viewer, one for all points or each point's own.
TEST(SeenThrough, surfacesAreLitForTheCamera) {
  Stage stage;
  stage.addWall(-3, stage.add(pane()));
  Material glossy;
  glossy.model = IlluminationModel::phong;
  glossy.classic.specularFactor = glm::vec3(1.0f);
  glossy.classic.shininess = 4.0f;
  stage.addWall(-5, stage.add(glossy));
  Light light;
  light.worldPosition = {1.5, 1.0, -3.5};
  light.intensity = 2.0f;
  stage.scene.lights = {light};
  for (const bool infinite : {false, true}) {
    const Difference d = rasterAgainstRays(stage.scene, [&](RenderSettings& s) { s.infiniteViewer = infinite; });
    EXPECT_LE(d.maximum, kRounding) << d << (infinite ? ", one viewer for all" : ", local viewer");
  }
}

// A wall straight ahead has one level of detail all over, however far its corners are from the eye.
TEST(SeenThrough, texturesAreReadAtTheSameLevel) {
  Stage stage;
  stage.addWall(-3, stage.add(pane()));
  const Scene pictures = sceneNamed("feature/mipmaps");
  stage.scene.images = pictures.images;
  Material painted = emitter(1.0f);
  painted.emissiveTexture = pictures.materials.front().baseColorTexture;
  painted.emissiveTexture.scale = glm::vec2(16.0f);
  painted.emissiveTexture.mip = Mip::linear;
  stage.addWall(-5, stage.add(painted));
  stage.scene.meshes.back().primitives[0].uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Difference d = rasterAgainstRays(stage.scene);
  // Coordinates of up to 16, in texels of a picture of 2^8: a rounding of theirs moves a color by as many roundings.
  EXPECT_LE(d.maximum, 16 * 256 * kRounding) << d;
}

// Mirrored rays meet both sides, behind a pane too.
TEST(SeenThrough, mirrorsShowBacksBehindPanes) {
  Stage stage;
  Material mirror = emitter(0.0f);
  mirror.classic.reflectionFactor = glm::vec3(1.0f);
  stage.addWall(-5, stage.add(mirror));
  stage.addWall(4, stage.add(emitter(1.0f)));  // its front faces away from the mirror
  EXPECT_EQ(stage.center(Method::whitted, 4)[0], 1.0f);
  stage.addWall(2, stage.add(pane()));
  EXPECT_EQ(stage.center(Method::whitted, 4)[0], kThrough);
}

}  // namespace
}  // namespace crosslight::testing
