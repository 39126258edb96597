// Transparent surfaces in raster: exact whatever the order, the number and the place of the triangles. Panes emit and
// reflect nothing, so that values are sums of few products.
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "support/stage.h"

namespace crosslight::testing {
namespace {

constexpr double kRounding = 2e-6;
constexpr Method kRasterMethods[] = {Method::flat, Method::gouraud, Method::phong};

Material pane(const glm::vec3& radiance, float kt) {
  Material m = emitter(0.0f);
  m.emissiveFactor = radiance;
  m.classic.transparency = kt;
  m.doubleSided = true;
  return m;
}

// A square of side 4 around the point, spanned by two unit vectors.
void addPane(Stage& stage, const glm::vec3& center, const glm::vec3& u, const glm::vec3& v, int material) {
  Primitive p;
  for (const auto& [a, b] : {std::pair(-2, -2), {2, -2}, {2, 2}, {-2, 2}}) {
    p.positions.push_back(center + static_cast<float>(a) * u + static_cast<float>(b) * v);
  }
  p.normals.assign(4, glm::normalize(glm::cross(u, v)));
  p.indices = {0, 1, 2, 0, 2, 3};
  p.material = material;
  stage.scene.meshes.push_back({"pane", {p}});
  MeshInstance instance;
  instance.mesh = static_cast<int>(stage.scene.meshes.size()) - 1;
  instance.instanceId = stage.scene.instanceCount++;
  stage.scene.instances.push_back(instance);
}

Image draw(const Stage& stage, Method method, std::uint32_t width, std::uint32_t height) {
  return render(device(), stage.scene, settingsFor(method, width, height)).image;
}

// Two panes that cross in the picture's vertical middle line: on the left one is nearer, on the right the other.
// Sorting whole triangles must fail on one side.
TEST(Transparency, isExactWherePanesPassThroughEachOther) {
  const double half = std::tan(0.5 * 0.7853981633974483);
  const float c = std::cos(0.5f), s = std::sin(0.5f);
  Stage stage;
  addPane(stage, {0, 0, -5}, {c, 0, -s}, {0, 1, 0}, stage.add(pane({1.0f, 0.0f, 0.0f}, 0.3f)));  // nearer on the left
  addPane(stage, {0, 0, -5}, {c, 0, s}, {0, 1, 0}, stage.add(pane({0.0f, 1.0f, 0.0f}, 0.6f)));
  stage.addWall(-9.0, stage.add(emitter(1.0f)));
  constexpr std::uint32_t kSize = 32;
  for (const Method method : {Method::flat, Method::gouraud, Method::phong, Method::whitted}) {
    const Image image = draw(stage, method, kSize, kSize);
    std::size_t compared = 0;
    for (std::uint32_t x = 0; x < kSize; ++x) {
      const double slope = (2.0 * (x + 0.5) / kSize - 1.0) * half;  // x / depth
      const double depthA = 5.0 / (1.0 - slope * std::tan(0.5)), depthB = 5.0 / (1.0 + slope * std::tan(0.5));
      if (std::abs(slope) * std::max(depthA, depthB) > 2.0 * std::cos(0.5) - 0.1) continue;  // beside a pane
      ++compared;
      const bool aIsNearer = depthA < depthB;
      // I = (1 - kt) Irefl + kt Itrans, twice.
      const double redFromA = 0.7 * (aIsNearer ? 1.0 : 0.6), greenFromB = 0.4 * (aIsNearer ? 0.3 : 1.0);
      const auto pixel = pixelAt(image, x, kSize / 2);
      EXPECT_NEAR(pixel[0], redFromA + 0.18, kRounding) << nameOf(method) << " at " << x;
      EXPECT_NEAR(pixel[1], greenFromB + 0.18, kRounding) << nameOf(method) << " at " << x;
      EXPECT_NEAR(pixel[3], 1.0, kRounding) << nameOf(method) << " at " << x;
    }
    EXPECT_GT(compared, 20u);
  }
}

// No order of whole triangles is right here: each lies before the next, and the last before the first.
TEST(Transparency, isExactWherePanesOverlapInACircle) {
  Stage stage;
  const glm::vec3 colors[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i) {
    const float angle = 2.0943951f * static_cast<float>(i);
    const glm::vec3 along(std::cos(angle), std::sin(angle), 0.0f), side(-along.y, along.x, 0.0f);
    const glm::vec3 tilted = glm::normalize(along + glm::vec3(0, 0, 0.2f));  // one end nearer than the other
    addPane(stage, glm::vec3(0, 0, -6) + 0.6f * side, 0.9f * tilted, 0.2f * side, stage.add(pane(colors[i], 0.5f)));
  }
  const Image rays = draw(stage, Method::whitted, 96, 96);
  for (const Method method : kRasterMethods) {
    const Image raster = draw(stage, method, 96, 96);
    std::size_t beyond = 0, several = 0;
    for (std::uint32_t y = 0; y < 96; ++y) {
      for (std::uint32_t x = 0; x < 96; ++x) {
        const auto p = pixelAt(raster, x, y), q = pixelAt(rays, x, y);
        several += q[3] > 0.7f ? 1 : 0;
        for (std::size_t k = 0; k < 3; ++k) {
          if (!(std::abs(p[k] - q[k]) <= kRounding)) {
            ++beyond;
            break;
          }
        }
      }
    }
    EXPECT_GT(several, 100u);
    EXPECT_LT(beyond, 40u) << nameOf(method) << ": more than the outlines";
  }
}

// The radiance behind n panes of kt = 1 - 1/n that emit 1: 1 - kt^n.
double behindPanes(int count) {
  return 1.0 - std::pow(static_cast<double>(1.0f - 1.0f / static_cast<float>(count)), count);
}

Stage panesInARow(int count) {
  Stage stage;
  const int material = stage.add(pane(glm::vec3(1.0f), 1.0f - 1.0f / static_cast<float>(count)));
  for (int i = 0; i < count; ++i) {
    const int place = i % 2 == 0 ? i : count - i;  // not in the order of their depth
    stage.addWall(-2.0 - 0.01 * place, material);
  }
  return stage;
}

TEST(Transparency, isExactBehindHundredsOfPanes) {
  for (const int count : {7, 8, 9, 40, 500}) {
    EXPECT_NEAR(panesInARow(count).center(Method::phong, 0)[0], behindPanes(count), count * 1.2e-7)
        << count << " panes";
  }
}

TEST(Transparency, saysSoWhereADriversLoopsEndTooSoon) {
  const std::uint32_t passes = device().info().maxLoopPasses;
  if (passes == 0) GTEST_SKIP() << "this driver's loops do not end before they are done";
  const int count = static_cast<int>(2.0 * std::sqrt(8.0 * passes));
  EXPECT_THROW(panesInARow(count).center(Method::phong, 0), DeviceError);
}

TEST(Transparency, ofCoincidentPanesTheFirstLiesInFront) {
  Stage stage;
  const int red = stage.add(pane({1, 0, 0}, 0.5f)), green = stage.add(pane({0, 1, 0}, 0.5f));
  for (const int material : {red, green, red}) addPane(stage, {0, 0, -5}, {1, 0, 0}, {0, 1, 0}, material);
  const auto pixel = pixelAt(draw(stage, Method::phong, 9, 9), 4, 4);
  EXPECT_NEAR(pixel[0], 0.5 + 0.125, kRounding);
  EXPECT_NEAR(pixel[1], 0.25, kRounding);
}

// The order in which objects stand in the file, or fragments come to a list, leaves no trace.
TEST(Transparency, looksTheSameInEveryOrder) {
  Scene scene = sceneNamed("feature/alpha_blend");
  const RenderSettings settings = settingsFor(Method::phong, 96, 72);
  const std::vector<float> reference = render(device(), scene, settings).image.picture().samples;
  EXPECT_TRUE(render(device(), scene, settings).image.picture().samples == reference);
  std::reverse(scene.instances.begin(), scene.instances.end());
  EXPECT_TRUE(render(device(), scene, settings).image.picture().samples == reference);
}

TEST(Transparency, isTheSameInLittleMemory) {
  for (const std::uint32_t msaa : {1u, 4u}) {
    for (const char* name : {"feature/alpha_blend", "feature/transparency"}) {
      const Scene scene = sceneNamed(name);
      RenderSettings settings = settingsFor(Method::gouraud, 80, 60);
      settings.msaa = msaa;
      const std::vector<float> reference = render(device(), scene, settings).image.picture().samples;
      settings.maxLayerBytes = 36 * 80 * 4 * msaa;  // about two rows of panes
      EXPECT_TRUE(render(device(), scene, settings).image.picture().samples == reference) << name << ", " << msaa;
    }
  }
}

TEST(Transparency, saysSoWhereOneRowNeedsMoreThanThereMayBe) {
  const Stage stage = panesInARow(20);
  RenderSettings settings = settingsFor(Method::phong, 16, 16);
  settings.maxLayerBytes = 36 * 16 * 19;
  try {
    render(device(), stage.scene, settings);
    FAIL() << "was drawn";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("row 0 has 320 transparent fragments"), std::string::npos) << error.what();
  }
  settings.maxLayerBytes = 36 * 16 * 20;
  EXPECT_NEAR(pixelAt(render(device(), stage.scene, settings).image, 8, 8)[0], behindPanes(20), kRounding);
}

TEST(Transparency, tintsByEveryChannel) {
  Material tinted = glass(1.5f);
  tinted.hasVolume = false;
  tinted.baseColorFactor = {0.9f, 0.5f, 0.1f, 1.0f};
  tinted.transmissionFactor = 0.75f;
  tinted.doubleSided = true;
  Stage stage;
  const int material = stage.add(tinted);
  stage.addWall(-2.0, material);
  stage.addWall(-3.0, material);
  stage.addWall(-4.0, stage.add(emitter(1.0f)));
  for (const Method method : {Method::flat, Method::gouraud, Method::phong, Method::whitted}) {
    RenderSettings settings = settingsFor(method, 9, 9);
    settings.refraction = settings.reflection = false;
    const auto pixel = pixelAt(render(device(), stage.scene, settings).image, 4, 4);
    for (int c = 0; c < 3; ++c) {
      const double passed = 0.75 * static_cast<double>(tinted.baseColorFactor[c]);
      EXPECT_NEAR(pixel[static_cast<std::size_t>(c)], passed * passed, kRounding) << nameOf(method) << ' ' << c;
    }
  }
}

// Over an opaque edge: what shows of every pixel is kt times what was there without the pane.
TEST(Transparency, weighsEverySampleOfAPixel) {
  Stage without;
  addPane(without, {0, 0, -6}, glm::normalize(glm::vec3(1, 0.3f, 0)), glm::normalize(glm::vec3(-0.3f, 1, 0)),
          without.add(emitter(1.0f)));
  Stage with = without;
  with.addWall(-3.0, with.add(pane({0.25f, 0.5f, 0.75f}, 0.4f)));
  for (const Method method : kRasterMethods) {
    RenderSettings settings = settingsFor(method, 64, 48);
    settings.msaa = 4;
    const Image a = render(device(), without.scene, settings).image, b = render(device(), with.scene, settings).image;
    std::size_t edges = 0;
    for (std::uint32_t y = 0; y < 48; ++y) {
      for (std::uint32_t x = 0; x < 64; ++x) {
        const double before = pixelAt(a, x, y)[0];
        edges += before > 0 && before < 1 ? 1 : 0;
        EXPECT_NEAR(pixelAt(b, x, y)[0], 0.6 * 0.25 + 0.4 * before, kRounding) << x << ' ' << y;
      }
    }
    EXPECT_GT(edges, 20u);
  }
}

// Panes that cross within a pixel: half of its samples see one first. The mean of the samples lies between.
TEST(Transparency, sortsEverySampleOfAPixel) {
  const float c = std::cos(0.5f), s = std::sin(0.5f);
  Stage stage;
  addPane(stage, {0, 0, -5}, {c, 0, -s}, {0, 1, 0}, stage.add(pane({1, 0, 0}, 0.5f)));
  addPane(stage, {0, 0, -5}, {c, 0, s}, {0, 1, 0}, stage.add(pane({0, 1, 0}, 0.5f)));
  RenderSettings settings = settingsFor(Method::phong, 9, 9);  // the middle column holds the crossing
  settings.msaa = 4;
  const auto pixel = pixelAt(render(device(), stage.scene, settings).image, 4, 4);
  EXPECT_NEAR(pixel[0], 0.375, kRounding);
  EXPECT_NEAR(pixel[1], 0.375, kRounding);
}

// The pane's own edge covers as much of a pixel as that of an opaque one.
TEST(Transparency, coversPartsOfAPixel) {
  const auto edge = [](float kt) {
    Stage stage;
    addPane(stage, {0, 0, -6}, glm::normalize(glm::vec3(1, 0.3f, 0)), glm::normalize(glm::vec3(-0.3f, 1, 0)),
            stage.add(pane(glm::vec3(1.0f), kt)));
    RenderSettings settings = settingsFor(Method::phong, 64, 48);
    settings.msaa = 4;
    return render(device(), stage.scene, settings).image;
  };
  const Image opaque = edge(0.0f), half = edge(0.5f);
  for (std::uint32_t y = 0; y < 48; ++y) {
    for (std::uint32_t x = 0; x < 64; ++x)
      EXPECT_NEAR(pixelAt(half, x, y)[0], 0.5 * double{pixelAt(opaque, x, y)[0]}, kRounding);
  }
}

}  // namespace
}  // namespace crosslight::testing
