// Trees that instances share or one over all triangles: the same hits, bit for bit, wherever instances stand and
// however they are turned, stretched, sheared or mirrored.
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "app/render_session.h"
#include "scene/shape_mesh.h"
#include "support/render_fixture.h"
#include "upload/shared_trees.h"

namespace crosslight::testing {
namespace {

using Random = std::mt19937;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
glm::dvec3 pointBetween(Random& random, double low, double high) {
  return {between(random, low, high), between(random, low, high), between(random, low, high)};
}

glm::dmat4 turned(Random& random) {
  return glm::rotate(glm::dmat4(1.0), between(random, 0, 6.3), glm::normalize(pointBetween(random, -1, 1)));
}
glm::dmat4 stretched(const glm::dvec3& by) { return glm::scale(glm::dmat4(1.0), by); }
glm::dmat4 sheared(double by) {
  glm::dmat4 m(1.0);
  m[1][0] = by;
  m[2][1] = -0.5 * by;
  return m;
}

// What a test's instances have in common.
enum class Kind { turned, stretched, mirrored, sheared, nested, upright };

glm::dmat4 linearPart(Kind kind, Random& random) {
  switch (kind) {
    case Kind::turned:
      return turned(random);
    case Kind::stretched:
      return turned(random) * stretched(glm::exp(pointBetween(random, -2, 1))) * turned(random);
    case Kind::mirrored:
      return turned(random) * stretched({-1, between(random, 0.5, 1), 1});
    case Kind::sheared:
      return turned(random) * sheared(between(random, -2, 2));
    case Kind::nested:
      return turned(random) * stretched({0.7, 1.1, 0.4}) * turned(random) * sheared(0.5) * turned(random);
    case Kind::upright:
      return stretched({between(random, 0.2, 1), 1, 1});
  }
  return glm::dmat4(1.0);
}

void add(Scene& scene, int mesh, const glm::dmat4& worldFromObject) {
  MeshInstance& instance = scene.instances.emplace_back();
  instance.mesh = mesh;
  instance.worldFromObject = worldFromObject;
  instance.instanceId = scene.instanceCount++;
}

Primitive tessellated(ShapeKind kind, const glm::vec4& params, int segments, int material) {
  Primitive p = tessellateShape(kind, params, segments, 2.0);
  p.material = material;
  return p;
}

// Meshes of one primitive and of two, with and without mirrors, one- and two-sided; a light that casts shadows.
Scene emptyScene(const glm::dvec3& at) {
  Scene scene;
  scene.source = "made in a test";
  for (int i = 0; i < 3; ++i) {
    Material& m = scene.materials.emplace_back();
    m.model = IlluminationModel::phong;
    m.classic.specularFactor = glm::vec3(0.4f);
    m.classic.shininess = 20;
    m.doubleSided = i != 1;
    if (i == 2) m.classic.reflectionFactor = glm::vec3(0.5f);
  }
  scene.meshes.push_back({"ball", {tessellated(ShapeKind::sphere, glm::vec4(0.5f), 24, 0)}});
  scene.meshes.push_back({"ring and block",
                          {tessellated(ShapeKind::torus, {0.6f, 0.2f, 0, 0}, 24, 2),
                           tessellated(ShapeKind::box, {0.5f, 0.4f, 0.3f, 0}, 4, 1)}});
  scene.meshes.push_back({"floor", {tessellated(ShapeKind::disk, glm::vec4(6), 32, 0)}});
  Camera& camera = scene.cameras.emplace_back();
  camera.worldFromCamera[3] = glm::dvec4(at + glm::dvec3(0, 0, 6), 1);
  Light& light = scene.lights.emplace_back();
  light.worldPosition = at + glm::dvec3(3, 5, 6);
  light.intensity = 100;
  add(scene, 2, glm::translate(glm::dmat4(1.0), at + glm::dvec3(0, -2.5, 0)));
  return scene;
}

Scene randomScene(Kind kind, unsigned seed, const glm::dvec3& at = glm::dvec3(0)) {
  Random random(seed);
  Scene scene = emptyScene(at);
  for (int i = 0; i < 40; ++i) {
    add(scene, i % 2, glm::translate(glm::dmat4(1.0), at + pointBetween(random, -2.5, 2.5)) * linearPart(kind, random));
  }
  return scene;
}

RenderResult renderWith(const Scene& scene, RenderSettings settings, InstanceMode mode) {
  settings.instances = mode;
  return render(device(), scene, settings);
}

RenderSettings allLayers(std::uint32_t width, std::uint32_t height) {
  RenderSettings settings = settingsFor(Method::whitted, width, height);
  settings.aovs = {"depth", "position", "geometricNormal", "instanceId", "primitiveId", "materialId"};
  return settings;
}

void expectEqual(const RenderResult& flat, const RenderResult& other) {
  ASSERT_EQ(flat.image.layers.size(), other.image.layers.size());
  for (std::size_t i = 0; i < flat.image.layers.size(); ++i) {
    const Layer &a = flat.image.layers[i], &b = other.image.layers[i];
    std::size_t differ = 0;
    for (std::size_t k = 0; k < a.samples.size(); ++k) differ += a.samples[k] != b.samples[k] ? 1 : 0;
    for (std::size_t k = 0; k < a.integers.size(); ++k) differ += a.integers[k] != b.integers[k] ? 1 : 0;
    EXPECT_EQ(differ, 0u) << "values of the layer '" << a.name << "'";
  }
  EXPECT_EQ(flat.report.rays, other.report.rays);
  EXPECT_EQ(other.report.counters.at("traversalsCapped"), 0u);
}

// The same hits: depths (a camera ray's t), ids and points; and with what follows from them, shadows and mirrors. With
// one tree both families of kernels have to agree as well.
void expectSame(const Scene& scene, RenderSettings settings) {
  settings.kernel = KernelFamily::perLane;
  const RenderResult flat = renderWith(scene, settings, InstanceMode::flatten);
  EXPECT_EQ(flat.report.tree.kind, "flat");
  EXPECT_GT(flat.report.rays.at("shadow"), 0u);
  const RenderResult shared = renderWith(scene, settings, InstanceMode::share);
  ASSERT_EQ(shared.report.tree.kind, "two-level") << shared.report.tree.reason;
  expectEqual(flat, shared);
  settings.kernel = KernelFamily::automatic;
  SCOPED_TRACE("the device's own kernels");
  expectEqual(flat, renderWith(scene, settings, InstanceMode::flatten));
}

class SharedTrees : public ::testing::TestWithParam<Kind> {};

TEST_P(SharedTrees, areHitAsOneTreeIs) {
  for (unsigned seed = 1; seed <= 3; ++seed) expectSame(randomScene(GetParam(), seed), allLayers(161, 123));
}

TEST_P(SharedTrees, areHitAsOneTreeIsFarFromTheWorldsOrigin) {
  expectSame(randomScene(GetParam(), 7, {1e6, -3e5, 2e6}), allLayers(161, 123));
}

INSTANTIATE_TEST_SUITE_P(Kinds, SharedTrees,
                         ::testing::Values(Kind::turned, Kind::stretched, Kind::mirrored, Kind::sheared, Kind::nested,
                                           Kind::upright));

TEST(SharedTrees, areHitAsOneTreeIsThroughAnOrthographicCamera) {
  Scene scene = randomScene(Kind::nested, 11);
  scene.cameras[0].orthographic = true;
  scene.cameras[0].xMag = scene.cameras[0].yMag = 3;
  expectSame(scene, allLayers(161, 123));
}

TEST(SharedTrees, areHitAsOneTreeIsWhereMasksCutHoles) {
  Scene scene = randomScene(Kind::turned, 12);
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& p : mesh.primitives) {
      for (std::size_t v = 0; v < p.positions.size(); ++v) p.colors.emplace_back(1, 1, 1, v % 3 == 0 ? 0.2f : 0.9f);
    }
  }
  for (Material& m : scene.materials) m.alphaMode = AlphaMode::mask;
  expectSame(scene, allLayers(161, 123));
}

// Of triangles at one place the lowest id is seen, as in a tree over all.
TEST(SharedTrees, ofCoincidentInstancesShowTheFirst) {
  Scene scene = emptyScene(glm::dvec3(0));
  Random random(5);
  const glm::dmat4 place = turned(random) * sheared(0.3);
  for (int i = 0; i < 4; ++i) add(scene, 0, place);
  // Planes that face the camera: their boxes have no depth that could hide an error.
  for (int i = 0; i < 3; ++i) {
    add(scene, 2,
        glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.1, -2.7)) *
            glm::rotate(glm::dmat4(1.0), 1.5707963267948966, glm::dvec3(1, 0, 0)));
  }
  expectSame(scene, allLayers(161, 123));
  const RenderResult shared = renderWith(scene, allLayers(161, 123), InstanceMode::share);
  const std::vector<std::uint32_t>& ids = shared.image.find("instanceId")->integers;
  for (const std::uint32_t id : {2u, 3u, 4u, 6u, 7u}) EXPECT_EQ(std::count(ids.begin(), ids.end(), id), 0) << id;
  EXPECT_GT(std::count(ids.begin(), ids.end(), 1u), 100);
  EXPECT_GT(std::count(ids.begin(), ids.end(), 5u), 100);
}

TEST(SharedTrees, leaveOutInstancesThatHaveNoUsableInverse) {
  Scene scene = randomScene(Kind::turned, 3);
  const std::size_t ordinary = scene.instances.size();
  add(scene, 0, stretched({1, 0, 1}));                                                        // flat
  add(scene, 0, glm::translate(glm::dmat4(1.0), {900, 0, 0}) * stretched(glm::dvec3(1e-4)));  // lost in rounding
  add(scene, 0, stretched(glm::dvec3(1e-42)));
  const RenderSettings settings = allLayers(161, 123);
  expectSame(scene, settings);
  // No picture of it: slivers as thin as rounding are hit beyond their ends, as far as their tree lets rays go.
  add(scene, 0, stretched({1, 1e-9, 1}) * sheared(1) * stretched({1e-5, 1, 1}));
  RenderSettings forced = settings;
  forced.instances = InstanceMode::share;
  const Sharing sharing = planSharing(scene, {0, 0, 6}, makePlan(scene, forced), forced);
  for (std::size_t i = ordinary; i < scene.instances.size(); ++i) EXPECT_FALSE(sharing.byMesh[i]) << i - ordinary;
  EXPECT_TRUE(sharing.byMesh[ordinary - 1]);
  EXPECT_FALSE(sharing.byMesh[0]) << "the only one of its mesh";
}

TEST(SharedTrees, areNotTakenWhereSeveralTransparentSurfacesMayShadow) {
  Scene scene = randomScene(Kind::turned, 3);
  for (Material& m : scene.materials) m.classic.transparency = 0.5f;
  RenderSettings settings = settingsFor(Method::whitted, 32, 32);
  settings.instances = InstanceMode::share;
  const Sharing sharing = planSharing(scene, {0, 0, 6}, makePlan(scene, settings), settings);
  EXPECT_FALSE(sharing.shares);
  EXPECT_NE(sharing.reason.find("transparent"), std::string::npos) << sharing.reason;
  EXPECT_EQ(renderWith(scene, settings, InstanceMode::share).report.tree.kind, "flat");
}

TEST(SharedTrees, areTakenByThemselvesOnlyWhereTheySaveMuch) {
  Scene scene = emptyScene(glm::dvec3(0));
  scene.meshes.push_back({"dense", {tessellated(ShapeKind::sphere, glm::vec4(0.5f), 256, 0)}});
  const std::size_t triangles = scene.meshes.back().primitives[0].indices.size() / 3;
  const RenderSettings settings = settingsFor(Method::whitted, 32, 32);
  const Plan plan = makePlan(scene, settings);
  Random random(3);
  std::size_t copies = 0;
  const auto saved = [&] { return copies == 0 ? 0 : (copies - 1) * triangles; };
  while (saved() < kFewestTrianglesSaved) {
    EXPECT_FALSE(planSharing(scene, {0, 0, 6}, plan, settings).shares) << saved();
    add(scene, 3, glm::translate(glm::dmat4(1.0), pointBetween(random, -2, 2)) * turned(random));
    ++copies;
  }
  const Sharing sharing = planSharing(scene, {0, 0, 6}, plan, settings);
  EXPECT_TRUE(sharing.shares) << sharing.reason;
  EXPECT_EQ(sharing.trianglesSaved, saved());
}

// A session that changes its mind keeps no kernels of the other kind.
TEST(SharedTrees, mayBeTurnedOnAndOffWithinASession) {
  const auto scene = std::make_shared<const Scene>(randomScene(Kind::turned, 9));
  RenderSession session(device());
  RenderSettings settings = allLayers(64, 48);
  settings.instances = InstanceMode::flatten;
  const RenderResult first = session.render({scene, settings});
  settings.instances = InstanceMode::share;
  const RenderResult second = session.render({scene, settings});
  settings.instances = InstanceMode::flatten;
  const RenderResult third = session.render({scene, settings});
  EXPECT_EQ(second.report.tree.kind, "two-level");
  EXPECT_EQ(third.report.tree.kind, "flat");
  EXPECT_TRUE(first.image.picture().samples == second.image.picture().samples);
  EXPECT_TRUE(first.image.picture().samples == third.image.picture().samples);
}

}  // namespace
}  // namespace crosslight::testing
