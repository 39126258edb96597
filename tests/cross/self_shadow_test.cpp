// No plane shades itself: rays that leave a flat surface do not meet it again. The hard case is a long strip with its
// normal across the long axis and light along it: the ray test's error grows with the strip's length, the offset of
// the ray's origin, which knows the error of the point alone, does not.
#include <cmath>
#include <glm/geometric.hpp>

#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kSize = 96;

// Along x, its normal +y.
Primitive stripOf(double halfLength, double halfWidth) {
  const auto l = static_cast<float>(halfLength), w = static_cast<float>(halfWidth);
  Primitive p;
  p.positions = {{-l, 0.0f, -w}, {-l, 0.0f, w}, {l, 0.0f, w}, {l, 0.0f, -w}};
  p.normals.assign(4, {0.0f, 1.0f, 0.0f});
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

// A strip turned about its long axis, seen askew from a distance of 10 and lit by a sun and a lamp.
Scene stripScene(double halfLength, double turn) {
  const glm::dmat3 about(glm::dvec3(1, 0, 0), glm::dvec3(0, std::cos(turn), std::sin(turn)),
                         glm::dvec3(0, -std::sin(turn), std::cos(turn)));
  Scene scene;
  Material material;
  material.model = IlluminationModel::lambert;
  scene.materials = {material};
  scene.meshes.push_back({"strip", {stripOf(halfLength, 3.0)}});
  MeshInstance instance;
  instance.worldFromObject = glm::dmat4(about);
  scene.instances = {instance};
  scene.instanceCount = 1;
  const glm::dvec3 back = glm::normalize(glm::dvec3(0.3, 0.7, 0.5));
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
  Camera camera;
  camera.worldFromCamera = glm::dmat4(about * glm::dmat3(right, glm::cross(back, right), back));
  camera.worldFromCamera[3] = glm::dvec4(about * (back * 10.0), 1.0);
  camera.zNear = 0.01;
  scene.cameras = {camera};
  Light sun;
  sun.type = LightType::directional;
  sun.classic = ClassicLight{};
  sun.worldDirection = about * glm::normalize(glm::dvec3(-0.8, -0.5, 0.3));
  Light lamp;
  lamp.classic = ClassicLight{};
  lamp.worldPosition = about * glm::dvec3(6.0, 2.0, -2.0);
  scene.lights = {sun, lamp};
  return scene;
}

struct Counts {
  std::size_t shown = 0, shaded = 0;
};

Counts countPixels(const Scene& scene) {
  RenderSettings s = settingsFor(Method::whitted, kSize, kSize);
  const std::vector<float> with = render(device(), scene, s).image.picture().samples;
  s.shadows = false;
  const std::vector<float> without = render(device(), scene, s).image.picture().samples;
  Counts counts;
  for (std::size_t i = 0; i < with.size(); i += 4) {
    counts.shown += without[i] > 0.0f && with[i + 3] == 1.0f;
    counts.shaded += with[i] != without[i] || with[i + 1] != without[i + 1] || with[i + 2] != without[i + 2];
  }
  return counts;
}

class SelfShadow : public ::testing::TestWithParam<double> {};

TEST_P(SelfShadow, noneOnAPlane) {
  for (const double turn : {0.0, 0.4, 1.1, 2.0}) {
    const Counts counts = countPixels(stripScene(GetParam(), turn));
    EXPECT_GT(counts.shown, 1000u);
    EXPECT_EQ(counts.shaded, 0u) << "of " << counts.shown << " pixels, half length " << GetParam() << ", turned by "
                                 << turn << " rad";
  }
}

INSTANTIATE_TEST_SUITE_P(HalfLengths, SelfShadow, ::testing::Values(3.0, 50.0, 1e3, 1e5),
                         [](const auto& i) { return "length" + std::to_string(static_cast<long>(i.param)); });

}  // namespace
}  // namespace crosslight::testing
