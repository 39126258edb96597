// Surfaces that glow as lights: two triangles are the rectangle light of the same radiance.
#include "base/log.h"
#include "scene/emissive_lights.h"
#include "support/area_stage.h"

namespace crosslight::testing {
namespace {

// A square of side 1 that faces `facing`, as a mesh; its triangles glow.
int addGlowingSquare(Stage& stage, const glm::dmat4& worldFromObject, float radiance) {
  Material m = emitter(radiance);
  m.name = "glow";
  Primitive p;
  p.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
  p.normals.assign(4, {0, 0, 1});
  p.indices = {0, 1, 2, 0, 2, 3};
  p.material = stage.add(m);
  stage.scene.meshes.push_back({"square", {p}});
  MeshInstance instance;
  instance.mesh = static_cast<int>(stage.scene.meshes.size()) - 1;
  instance.worldFromObject = worldFromObject;
  instance.instanceId = stage.scene.instanceCount++;
  stage.scene.instances.push_back(instance);
  return p.material;
}

// Columns x, y, z and the place.
glm::dmat4 frameOf(const Light& rectangle) {
  return glm::dmat4(glm::dvec4(2.0 * rectangle.worldU, 0), glm::dvec4(-2.0 * rectangle.worldV, 0),
                    glm::dvec4(rectangle.worldDirection, 0), glm::dvec4(rectangle.worldPosition, 1));
}

Light lamp() { return rectangleLight({1.6, 0.3, -1.8}, {-1.0, -0.2, -0.6}, 0.8, 1.1); }

TEST(EmissiveLight, twoTrianglesAreTheRectangleLight) {
  for (const bool mirrored : {false, true}) {
    LitWall asLight(lamp()), asMesh(lamp());
    asLight.scene.lights[0].intensity = 2.0f;
    asMesh.scene.lights.clear();
    glm::dmat4 frame = frameOf(lamp());
    if (mirrored) frame[0] = -frame[0];  // the node turns the triangles around; its front is where the normals were
    addGlowingSquare(asMesh, frame, 2.0f);
    EXPECT_EQ(addEmissiveLights(asMesh.scene), 2u);
    for (const Method method : {Method::phong, Method::whitted}) {
      const Image a = asLight.draw(method, 24, 18), b = asMesh.draw(method, 24, 18);
      const Difference d = largestDifference(a, b, [](std::uint32_t, std::uint32_t) { return true; });
      EXPECT_GT(pixelAt(a, 12, 9)[0], 0.05f);
      EXPECT_TRUE(d.maximum <= 3e-6) << nameOf(method) << ": " << d;
    }
  }
}

TEST(EmissiveLight, aSideThatDoesNotGlowLightsNothing) {
  LitWall wall(lamp());
  wall.scene.lights.clear();
  glm::dmat4 frame = frameOf(lamp());
  frame[0] = -frame[0], frame[2] = -frame[2];  // turned around
  addGlowingSquare(wall, frame, 2.0f);
  EXPECT_EQ(addEmissiveLights(wall.scene), 2u);
  EXPECT_EQ(pixelAt(wall.draw(Method::phong, 9, 9), 4, 4)[0], 0.0f);
}

TEST(EmissiveLight, theBrightestAreTakenAndTheOthersNamed) {
  LitWall wall(lamp());
  wall.scene.lights.clear();
  glm::dmat4 frame(1.0);
  for (int i = 0; i < 3; ++i) {
    frame[3] = glm::dvec4(3.0 * i, 0, 0, 1);
    addGlowingSquare(wall, frame, static_cast<float>(i + 1));
  }
  EXPECT_EQ(addEmissiveLights(wall.scene, 3), 3u);
  const std::string said = loggedWarnings().back();
  EXPECT_NE(said.find("3 of 6 glowing triangles"), std::string::npos) << said;
  EXPECT_NE(said.find("66.7 %"), std::string::npos) << said;  // (3 + 3 + 2) / 12
  ASSERT_EQ(wall.scene.lights.size(), 3u);
  EXPECT_EQ(wall.scene.lights[0].color.r, 3.0f);
  EXPECT_EQ(wall.scene.lights[2].color.r, 2.0f);
}

}  // namespace
}  // namespace crosslight::testing
