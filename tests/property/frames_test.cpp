// Frames of one session, whose trees move with their triangles, are the pictures that each would be by itself.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "app/render_session.h"
#include "scene/shape_mesh.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

Primitive tessellated(ShapeKind kind, const glm::vec4& params, int segments, int material) {
  Primitive p = tessellateShape(kind, params, segments, 2.0);
  p.material = material;
  return p;
}

// Rings of a mirror over a floor; with time they turn, bend and the camera rises.
Scene sceneAt(double time, bool bends) {
  Scene scene;
  scene.source = "made in a test";
  for (int i = 0; i < 2; ++i) {
    Material& m = scene.materials.emplace_back();
    m.model = IlluminationModel::phong;
    m.doubleSided = true;
    if (i == 1) m.classic.reflectionFactor = glm::vec3(0.6f);
  }
  scene.meshes.push_back({"floor", {tessellated(ShapeKind::disk, glm::vec4(5), 32, 0)}});
  scene.meshes.push_back({"ring", {tessellated(ShapeKind::torus, {0.8f, 0.3f, 0, 0}, 48, 1)}});
  if (bends) {
    for (glm::vec3& p : scene.meshes[1].primitives[0].positions) p.y += std::sin(static_cast<float>(time) + 2 * p.x);
  }
  const auto add = [&](int mesh, const glm::dmat4& place) {
    MeshInstance& instance = scene.instances.emplace_back();
    instance.mesh = mesh;
    instance.worldFromObject = place;
    instance.instanceId = scene.instanceCount++;
  };
  add(0, glm::translate(glm::dmat4(1.0), {0, -1.5, 0}));
  for (int i = 0; i < 3; ++i) {
    add(1, glm::rotate(glm::translate(glm::dmat4(1.0), {1.5 * i - 1.5, 0, 0}), time + i, glm::dvec3(1, 0.3, 0)));
  }
  scene.cameras.emplace_back().worldFromCamera[3] = glm::dvec4(0, 0.1 * time, 6, 1);
  scene.lights.emplace_back().worldPosition = glm::dvec3(2, 5, 3);
  scene.lights.back().intensity = 80;
  return scene;
}

RenderSettings frameSettings(InstanceMode mode) {
  RenderSettings settings = settingsFor(Method::whitted, 121, 90);
  settings.aovs = {"depth", "instanceId", "primitiveId"};
  settings.instances = mode;
  return settings;
}

// Expected of the frames but the first: how many trees are moved, and how many are as they were.
void expectFramesAsAlone(InstanceMode mode, bool bends, std::uint64_t moved, std::uint64_t unchanged) {
  RenderSession session(device());
  const RenderSettings settings = frameSettings(mode);
  for (int frame = 0; frame < 4; ++frame) {
    SCOPED_TRACE(frame);
    const auto scene = std::make_shared<const Scene>(sceneAt(0.4 * frame, bends));
    const RenderResult inRow = session.render({scene, settings, {}, 0, true});
    const RenderResult alone = render(device(), *scene, settings);
    ASSERT_EQ(inRow.image.layers.size(), alone.image.layers.size());
    for (std::size_t i = 0; i < alone.image.layers.size(); ++i) {
      EXPECT_TRUE(inRow.image.layers[i].samples == alone.image.layers[i].samples) << alone.image.layers[i].name;
      EXPECT_EQ(inRow.image.layers[i].integers, alone.image.layers[i].integers) << alone.image.layers[i].name;
    }
    EXPECT_EQ(inRow.report.rays, alone.report.rays);
    EXPECT_EQ(inRow.report.tree.moved, frame == 0 ? 0 : moved);
    EXPECT_EQ(inRow.report.tree.unchanged, frame == 0 ? 0 : unchanged);
    EXPECT_EQ(alone.report.tree.moved, 0u);
  }
}

TEST(Frames, withOneTreeAreAsAlone) { expectFramesAsAlone(InstanceMode::flatten, false, 1, 0); }
TEST(Frames, withOneTreeThatBendsAreAsAlone) { expectFramesAsAlone(InstanceMode::flatten, true, 1, 0); }
// The rings share a tree in their own space, which nothing moves; the floor's is in render space.
TEST(Frames, withSharedTreesMoveWhatIsInRenderSpaceOnly) { expectFramesAsAlone(InstanceMode::share, false, 1, 1); }
TEST(Frames, withSharedTreesThatBendMoveThose) { expectFramesAsAlone(InstanceMode::share, true, 2, 0); }

// What two transparent surfaces let pass is multiplied in the order of the walk: no tree is kept.
TEST(Frames, withTransparentShadowsKeepNoTree) {
  RenderSession session(device());
  for (int frame = 0; frame < 3; ++frame) {
    Scene scene = sceneAt(frame, false);
    for (Material& m : scene.materials) m.classic.transparency = 0.3f;
    const auto shared = std::make_shared<const Scene>(std::move(scene));
    const RenderSettings settings = frameSettings(InstanceMode::automatic);
    const RenderResult inRow = session.render({shared, settings, {}, 0, true});
    EXPECT_EQ(inRow.report.tree.built, 1u);
    EXPECT_TRUE(inRow.image.picture().samples == render(device(), *shared, settings).image.picture().samples);
  }
}

}  // namespace
}  // namespace crosslight::testing
