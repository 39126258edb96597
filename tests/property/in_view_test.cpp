// The camera counts: what no ray can meet calls for nothing, and leaving it out changes no bit. Lights whose shadows
// nothing casts send no rays; rays go no deeper than the scene can use.
#include <fmt/format.h>

#include <set>

#include "app/render_session.h"
#include "effects/effects.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

const EffectVerdict& verdictOn(const Plan& plan, const std::string& name) {
  return *std::find_if(plan.verdicts.begin(), plan.verdicts.end(),
                       [&](const EffectVerdict& v) { return v.name == name; });
}

void expectTheFullPicture(const Scene& scene, RenderSettings settings, const std::string& what) {
  const RenderResult specialized = render(device(), scene, settings);
  settings.allEffects = true;
  const RenderResult full = render(device(), scene, settings);
  const auto all = [](std::uint32_t, std::uint32_t) { return true; };
  EXPECT_TRUE(specialized.image.picture().samples == full.image.picture().samples)
      << what << ": " << largestDifference(specialized.image, full.image, all);
  for (const char* kind : {"primary", "reflection", "refraction", "passThrough"}) {
    const auto of = [&](const RenderResult& r) { return r.report.rays.contains(kind) ? r.report.rays.at(kind) : 0; };
    EXPECT_EQ(of(specialized), of(full)) << what << ": " << kind;
  }
}

// The camera looks at a part of the scene: turned about itself by steps, some surfaces leave the view, then all.
class Turned : public ::testing::TestWithParam<const char*> {};

TEST_P(Turned, whatIsOutOfViewIsLeftOutAndChangesNoBit) {
  std::set<std::uint64_t> plans;
  for (int step = 0; step < 8; ++step) {
    Scene scene = sceneNamed(GetParam());
    const double angle = 0.7853981633974483 * step;
    glm::dmat4 turn(1.0);
    turn[0] = {std::cos(angle), 0, -std::sin(angle), 0};
    turn[2] = {std::sin(angle), 0, std::cos(angle), 0};
    scene.cameras[0].worldFromCamera = scene.cameras[0].worldFromCamera * turn;
    for (const Method method : {Method::phong, Method::whitted}) {
      RenderSettings settings = settingsFor(method, 40, 30);
      settings.spp = 2;
      settings.filter = PixelFilter::mitchell;
      settings.hitQueues = HitQueues::on;
      plans.insert(makePlan(scene, settings).effects);
      expectTheFullPicture(scene, settings,
                           fmt::format("{} by {}, turned by {} eighths", GetParam(), nameOf(method), step));
    }
  }
  EXPECT_GE(plans.size(), 3u) << "the view decides nothing";  // one per method, and one that it decides
}

INSTANTIATE_TEST_SUITE_P(Scenes, Turned,
                         ::testing::Values("feature/mirror", "feature/transparency", "feature/alpha_mask",
                                           "feature/clearcoat", "showcase/spheres_checker"),
                         [](const auto& i) {
                           std::string name = i.param;
                           std::replace(name.begin(), name.end(), '/', '_');
                           return name;
                         });

// What a setting switches off is off with all effects too.
TEST(SwitchedOff, holdsForTheFullPipeline) {
  for (const char* name : {"feature/mirror", "feature/refraction", "feature/areaSphere"}) {
    const Scene scene = sceneNamed(name);
    for (const auto set :
         {+[](RenderSettings& s) { s.shadows = false; }, +[](RenderSettings& s) { s.reflection = false; },
          +[](RenderSettings& s) { s.refraction = false; }}) {
      RenderSettings settings = settingsFor(Method::whitted, 32, 24);
      set(settings);
      expectTheFullPicture(scene, settings, name);
    }
  }
}

// A square in the plane y = `height`, of side 2, its front up.
MeshInstance addSquare(Scene& scene, const std::string& name, int material, const glm::dvec3& at) {
  Primitive p;
  p.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  p.normals.assign(4, {0, 1, 0});
  p.indices = {0, 1, 2, 0, 2, 3};
  p.material = material;
  scene.meshes.push_back({name, {p}});
  MeshInstance instance;
  instance.name = name;
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  instance.worldFromObject[3] = glm::dvec4(at, 1.0);
  instance.instanceId = scene.instanceCount++;
  return instance;
}

// A lit square, seen from above.
Scene squareScene() {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[0].name = "matte";
  scene.materials[0].model = IlluminationModel::lambert;
  scene.materials[1] = scene.materials[0];
  scene.materials[1].name = "glass";
  scene.materials[1].classic.transparency = 0.5f;
  scene.instances.push_back(addSquare(scene, "floor", 0, glm::dvec3(0.0)));
  Camera camera;
  camera.worldFromCamera = glm::dmat4(1.0);
  camera.worldFromCamera[1] = {0, 0, -1, 0};  // up: -Z
  camera.worldFromCamera[2] = {0, 1, 0, 0};   // looks down
  camera.worldFromCamera[3] = {0, 3, 0, 1};
  scene.cameras.push_back(camera);
  Light sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  sun.worldDirection = {0, -1, 0};
  scene.lights.push_back(sun);
  Light lamp;
  lamp.name = "lamp";
  lamp.worldPosition = {3, 2, 0};
  scene.lights.push_back(lamp);
  return scene;
}

TEST(Shadows, aLightWithoutCastersSendsNoRays) {
  Scene scene = squareScene();
  const RenderSettings settings = settingsFor(Method::whitted, 40, 30);
  const Plan alone = makePlan(scene, settings);
  EXPECT_FALSE(alone.has(Effect::shadows)) << verdictOn(alone, "shadows").reason;
  expectTheFullPicture(scene, settings, "a floor alone");

  scene.instances.push_back(addSquare(scene, "shelf", 0, {2.5, 1, 0}));  // between the lamp and the floor
  const Plan shelf = makePlan(scene, settings);
  ASSERT_EQ(shelf.lightShadows.size(), 2u);
  EXPECT_FALSE(shelf.lightShadows[0].shadows) << shelf.lightShadows[0].reason;
  EXPECT_NE(shelf.lightShadows[0].reason.find("shadows off for light 'sun': no caster between it and any"),
            std::string::npos)
      << shelf.lightShadows[0].reason;
  EXPECT_TRUE(shelf.lightShadows[1].shadows) << shelf.lightShadows[1].reason;
  expectTheFullPicture(scene, settings, "a shelf beside a floor");
  RenderSettings full = settings;
  full.allEffects = true;
  const auto shadowRays = [&](const RenderSettings& s) { return render(device(), scene, s).report.rays.at("shadow"); };
  EXPECT_LT(shadowRays(settings), shadowRays(full));
  EXPECT_GT(shadowRays(settings), 0u);

  scene.instances.back().worldFromObject[3].x = 0.5;  // above the floor: both lights
  for (const LightVerdict& light : makePlan(scene, settings).lightShadows) EXPECT_TRUE(light.shadows) << light.reason;
}

TEST(Shadows, whatLetsLightPassCountsOutOfView) {
  Scene scene = squareScene();
  scene.instances.push_back(addSquare(scene, "pane", 1, {0, 5, 0}));  // behind the camera, below the sun
  RenderSettings settings = settingsFor(Method::whitted, 40, 30);
  EXPECT_TRUE(makePlan(scene, settings).has(Effect::transparency));
  expectTheFullPicture(scene, settings, "a pane behind the camera");
  settings.shadows = false;
  EXPECT_FALSE(makePlan(scene, settings).has(Effect::transparency));
  expectTheFullPicture(scene, settings, "a pane behind the camera, no shadows");
}

ShapeInstance sphereAt(const glm::dvec3& center, int material) {
  ShapeInstance sphere;
  sphere.name = "ball";
  sphere.params = {0.5f, 0, 0, 0};
  sphere.material = material;
  sphere.worldFromObject[3] = glm::dvec4(center, 1.0);
  return sphere;
}

TEST(Depth, goesAsFarAsRaysCanGo) {
  Scene scene = squareScene();
  scene.materials[1] = scene.materials[0];
  scene.materials[1].name = "mirror";
  scene.materials[1].classic.reflectionFactor = glm::vec3(0.5f);
  const RenderSettings settings = settingsFor(Method::whitted, 400, 300);
  EXPECT_EQ(makePlan(scene, settings).maxDepth, 0u);
  scene.shapes.push_back(sphereAt({0, 0.8, 0}, 1));
  const Plan one = makePlan(scene, settings);
  EXPECT_EQ(one.maxDepth, 1u) << one.depthReason;
  expectTheFullPicture(scene, settings, "one mirroring ball");
  scene.shapes.push_back(sphereAt({0.6, 1.5, 0}, 1));
  const Plan two = makePlan(scene, settings);
  EXPECT_EQ(two.maxDepth, settings.maxDepth) << two.depthReason;
  expectTheFullPicture(scene, settings, "two mirroring balls");

  Scene panes = squareScene();
  for (const double height : {0.5, 1.0}) panes.instances.push_back(addSquare(panes, "pane", 1, {0, height, 0}));
  const Plan straight = makePlan(panes, settings);
  EXPECT_EQ(straight.maxDepth, 4u) << straight.depthReason;  // two triangles each
  expectTheFullPicture(panes, settings, "two panes");
}

}  // namespace
}  // namespace crosslight::testing
