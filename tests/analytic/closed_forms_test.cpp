// Closed forms of optics and of the sphere: where rays go through slabs, prisms, balls and drops, read from the ray
// tree; how bright a matte sphere is at every phase; light of several lamps adds up.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "app/render_session.h"
#include "support/stage.h"

namespace crosslight::testing {
namespace {

using glm::dvec3;

constexpr double kDegree = glm::pi<double>() / 180.0;
// Directions and places of rays that were bent a few times, in floats of size 4 at most: some dozen roundings.
constexpr double kBent = 4e-6;

Material glass(double index) {
  Material m;
  m.model = IlluminationModel::cookTorrance;
  m.baseColorFactor = glm::vec4(1.0f);
  m.metallicFactor = 0.0f;
  m.perceptualRoughnessFactor = 0.0f;
  m.transmissionFactor = 1.0f;
  m.indexOfRefraction = static_cast<float>(index);
  m.hasVolume = true;
  return m;
}

// A quadrilateral whose front is where `outward` points.
Primitive quad(const std::array<dvec3, 4>& corners, const dvec3& outward, int material) {
  Primitive p;
  for (const dvec3& c : corners) p.positions.emplace_back(c);
  p.normals.assign(4, glm::vec3(outward));
  const bool turns = glm::dot(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), outward) < 0;
  p.indices = turns ? std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2} : std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3};
  p.material = material;
  return p;
}

// One ray, from `origin` along `direction`, which lies in the plane y = 0, with all that follows.
RayTree traced(Stage stage, const dvec3& origin, const dvec3& direction, std::uint32_t depth) {
  Camera& camera = stage.scene.cameras[0];
  const dvec3 up(0, 1, 0), back = -direction;
  camera.worldFromCamera = glm::dmat4(glm::dmat3(glm::cross(up, back), up, back));
  camera.worldFromCamera[3] = glm::dvec4(origin, 1.0);
  camera.orthographic = true;
  camera.zFar = 100.0;
  RenderRequest request;
  request.scene = std::make_shared<Scene>(std::move(stage.scene));
  request.settings = settingsFor(Method::whitted, 1, 1);
  request.settings.maxDepth = depth;
  request.rayTreePixel = glm::uvec2(0);
  RenderSession session(device());
  const RenderResult result = session.render(request);
  return result.rayTree.value();
}

enum class Way { through, back };

// The ray that remains after the given turns.
RayTreeNode after(const RayTree& tree, const std::vector<Way>& ways) {
  std::size_t at = 0;
  for (const Way way : ways) {
    const auto next = way == Way::through ? tree.nodes[at].transmitted : tree.nodes[at].reflected;
    if (!next) throw std::runtime_error("the ray ends early");
    at = *next;
  }
  return tree.nodes[at];
}

double angleBetween(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(ClosedForms, aSlabShiftsRaysAndLetsThemGoOnParallel) {
  Stage stage;
  const int material = stage.add(glass(1.5));
  stage.addWall(0.0, material);
  stage.addWall(-1.0, material, false);
  const std::pair<double, double> table[] = {
      {30, .193813782152103}, {45, .32914230817732}, {60, .512472013191165}, {80, .833663850009496}};
  for (const auto& [degrees, shift] : table) {
    const dvec3 d(std::sin(degrees * kDegree), 0, -std::cos(degrees * kDegree));
    const dvec3 origin = dvec3(-1, 0, 0) - 2.0 * d;
    const RayTreeNode out = after(traced(stage, origin, d, 3), {Way::through, Way::through});
    EXPECT_LT(glm::length(out.direction - d), kBent) << degrees;
    EXPECT_NEAR(glm::length(glm::cross(out.origin - origin, d)), shift, kBent) << degrees;
  }
}

// Apex on +x, symmetric about the plane z = 0; its sides are 2 long.
Stage prism(double apex, double index) {
  Stage stage;
  const int material = stage.add(glass(index));
  const double s = std::sin(apex / 2), c = std::cos(apex / 2);
  const auto at = [](const dvec3& p, double y) { return p + dvec3(0, y, 0); };
  const dvec3 tip(1, 0, 0), front = tip + 2.0 * dvec3(-c, 0, s), rear = tip + 2.0 * dvec3(-c, 0, -s);
  const auto side = [&](const dvec3& a, const dvec3& b, const dvec3& n) {
    return quad({at(a, -1), at(b, -1), at(b, 1), at(a, 1)}, n, material);
  };
  stage.scene.meshes.push_back(
      {"prism", {side(tip, front, {s, 0, c}), side(tip, rear, {s, 0, -c}), side(front, rear, {-1, 0, 0})}});
  MeshInstance instance;
  instance.instanceId = stage.scene.instanceCount++;
  stage.scene.instances.push_back(instance);
  return stage;
}

TEST(ClosedForms, aPrismBendsLeastWhereTheWayThroughItIsSymmetric) {
  const struct {
    double apex, index, deviation;  // degrees
  } table[] = {{60, 1.5, 37.1807557814583}, {60, 1.52, 38.9283957773669}, {30, 1.5, 15.6886410536287}};
  for (const auto& row : table) {
    const double apex = row.apex * kDegree, incidence = std::asin(row.index * std::sin(apex / 2));
    const Stage stage = prism(apex, row.index);
    const dvec3 entry = dvec3(1, 0, 0) + dvec3(-std::cos(apex / 2), 0, std::sin(apex / 2));
    const auto deviation = [&](double more) {
      const double a = incidence + more - apex / 2;
      const dvec3 d(std::sin(a), 0, -std::cos(a));
      return angleBetween(d, after(traced(stage, entry - 2.0 * d, d, 3), {Way::through, Way::through}).direction);
    };
    const double least = deviation(0);
    // The index is a float: 2^-25 of it times 2 tan(i).
    EXPECT_NEAR(least, row.deviation * kDegree, kBent) << row.apex << ' ' << row.index;
    EXPECT_GT(deviation(0.05), least + kBent);
    EXPECT_GT(deviation(-0.05), least + kBent);
  }
}

Stage ballOf(double index) {
  Stage stage;
  stage.addShape(ShapeKind::sphere, {1, 0, 0, 0}, {0, 0, 0}, stage.add(glass(index)));
  return stage;
}

// Bent twice by asin(b) - asin(b / n), and no nearer to the center than before: it crosses the axis at
// b / sin(deviation), for thin bundles at n / (2 (n - 1)).
TEST(ClosedForms, aBallFocusesAtItsFocalLength) {
  const Stage stage = ballOf(1.5);
  for (const double b : {0.01, 0.1, 0.5, 0.9}) {
    const RayTreeNode out = after(traced(stage, {b, 0, 3}, {0, 0, -1}, 3), {Way::through, Way::through});
    const double deviation = 2 * (std::asin(b) - std::asin(b / 1.5));
    EXPECT_NEAR(angleBetween(out.direction, {0, 0, -1}), deviation, kBent / std::sqrt(1 - b * b)) << b;
    const double focus = -(out.origin.z - out.origin.x / out.direction.x * out.direction.z);
    EXPECT_NEAR(focus, b / std::sin(deviation), 2 * kBent / b) << b;
    if (b < 0.02) {
      EXPECT_NEAR(focus, 1.5, 2e-4 + 2 * kBent / b);
    }
  }
}

// Descartes 1637: rays that are reflected once inside a drop come back at 42 degrees at most.
TEST(ClosedForms, aDropMakesTheRainbow) {
  const Stage stage = ballOf(1.333);
  const auto bow = [&](double b) {
    const auto tree = traced(stage, {b, 0, 3}, {0, 0, -1}, 4);
    return angleBetween(after(tree, {Way::through, Way::back, Way::through}).direction, {0, 0, 1});
  };
  const double primary = bow(.860835059694948);
  EXPECT_NEAR(primary, 42.0781073802436 * kDegree, 2 * kBent);
  EXPECT_LT(bow(.84), primary - 2 * kBent);
  EXPECT_LT(bow(.88), primary - 2 * kBent);
}

// Mean over the disc: 2 / (3 pi) (sin a + (pi - a) cos a), a the angle between the light and the viewer.
TEST(ClosedForms, aMatteSphereHasThePhasesOfLambert) {
  constexpr std::uint32_t kSize = 512;
  for (const double degrees : {0.0, 45.0, 90.0, 135.0}) {
    const double a = degrees * kDegree;
    Stage stage;
    Material matte;
    matte.model = IlluminationModel::lambert;
    matte.classic.ambientFactor = glm::vec3(0.0f);
    matte.classic.diffuseFactor = glm::vec3(1.0f);
    stage.addShape(ShapeKind::sphere, {1, 0, 0, 0}, {0, 0, -2}, stage.add(matte));
    Light sun;
    sun.type = LightType::directional;
    sun.classic = ClassicLight{};
    sun.worldDirection = -dvec3(std::sin(a), 0, std::cos(a));
    stage.scene.lights = {sun};
    Camera& camera = stage.scene.cameras[0];
    camera.orthographic = true;
    camera.xMag = camera.yMag = 1.0;
    camera.zFar = 10.0;
    const Image image = render(device(), stage.scene, settingsFor(Method::whitted, kSize, kSize)).image;
    double sum = 0;
    for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) sum += image.picture().samples[4 * i];
    const double mean = sum * 4 / (double{kSize} * kSize) / glm::pi<double>();
    const double expected = 2.0 / 3.0 * (std::sin(a) + (glm::pi<double>() - a) * std::cos(a)) / glm::pi<double>();
    // Samples at pixels' centers: an edge of 2 pi 256 pixels, each wrong by at most its brightness, half of the time
    // either way, is off by the square root of their number.
    EXPECT_NEAR(mean, expected, 2 * std::sqrt(2 * glm::pi<double>() * kSize / 2) / (kSize * kSize / 1.0)) << degrees;
  }
}

TEST(ClosedForms, lightOfSeveralLampsAddsUp) {
  Scene scene = sceneNamed("showcase/three_lights");
  scene.atmosphere.ambient = glm::vec3(0.0f);
  scene.atmosphere.background = glm::vec3(0.0f);
  for (const Method method : {Method::gouraud, Method::phong, Method::whitted}) {
    RenderSettings s = settingsFor(method, 64, 48);
    s.reflection = s.refraction = false;
    const auto all = render(device(), scene, s).image.picture().samples;
    std::vector<double> sum(all.size(), 0.0);
    for (const Light& light : scene.lights) {
      Scene one = scene;
      one.lights = {light};
      const auto part = render(device(), one, s).image.picture().samples;
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
    }
    constexpr double kRounding = 16 * 0x1p-24;  // a dozen sums and products of values around 1
    double worst = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      if (i % 4 != 3) worst = std::max(worst, std::abs(sum[i] - all[i]));
    }
    EXPECT_LT(worst, kRounding) << nameOf(method);
    EXPECT_GT(*std::max_element(all.begin(), all.end()), 0.2f);
  }
}

}  // namespace
}  // namespace crosslight::testing
