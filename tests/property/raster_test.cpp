// What the raster methods promise about how they draw: neither the plan, nor the cut of a picture into bands and
// strips, nor the joining of draws may change a bit.
#include <algorithm>

#include "film/film.h"
#include "raster/draw_list.h"
#include "raster/raster.h"
#include "raster/strip.h"
#include "support/render_fixture.h"
#include "upload/gpu_scene.h"
#include "upload/records.h"

namespace crosslight::testing {
namespace {

TEST(Strips, coverEachBandOnceAndBeginWhereThePictureSays) {
  for (const std::uint32_t rows : {1u, 3u, 64u, 100u}) {
    std::uint32_t next = 7;
    for (const Strip& strip : stripsOf({7, 93}, rows)) {
      EXPECT_EQ(strip.rows.firstRow, next);
      EXPECT_EQ(strip.firstRow % rows, 0u);
      EXPECT_GE(strip.rows.firstRow, strip.firstRow);
      EXPECT_LE(strip.rows.firstRow + strip.rows.rowCount, strip.firstRow + rows);
      next += strip.rows.rowCount;
    }
    EXPECT_EQ(next, 100u);
  }
}

TEST(Strips, keepTheTargetsOfAHugePictureSmall) {
  EXPECT_EQ(rowsPerStrip(1920, 1080, 1), 1080u) << "one strip";
  EXPECT_EQ(rowsPerStrip(3840, 2160, 1), 2160u) << "one strip";
  const std::uint64_t bytes = std::uint64_t{20} * 16384 * rowsPerStrip(16384, 16384, 1);  // RGBA32F and D32F
  EXPECT_LE(bytes, std::uint64_t{200} << 20);
  EXPECT_EQ(rowsPerStrip(1u << 30, 5, 8), 1u) << "never none";
}

DrawCall call(std::uint32_t firstTriangle, std::uint32_t count, std::uint32_t material, std::uint32_t flags) {
  return {firstTriangle, count, 0, material, flags, true};
}

TEST(DrawLists, joinNeighboursOfOneStateAndKeepTheOrder) {
  Scene scene;
  scene.materials.resize(2);
  FlatScene flat;
  flat.draws = {{0, 2, 0, 0, 0, 0, 0, 0},
                {2, 3, 0, 1, 0, 0, 0, 0},
                {5, 1, 1, 2, 0, 0, 0, 0},
                {6, 4, 0, 3, 0, 0, 0, 0},
                {10, 1, 0, 4, 0, shared::kDrawFlipsWinding, 0, 0}};
  flat.meshDrawCount = 5;
  const DrawLists lists = makeDrawLists(flat, scene, Plan{}, RenderSettings{});
  const std::vector<DrawCall> expected{call(0, 5, 0, 0), call(5, 1, 1, 0), call(6, 4, 0, 0),
                                       call(10, 1, 0, shared::kDrawFlipsWinding)};
  ASSERT_EQ(lists.opaque.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(lists.opaque[i].firstTriangle, expected[i].firstTriangle) << i;
    EXPECT_EQ(lists.opaque[i].triangleCount, expected[i].triangleCount) << i;
    EXPECT_EQ(lists.opaque[i].materialId, expected[i].materialId) << i;
    EXPECT_EQ(lists.opaque[i].flags, expected[i].flags) << i;
    EXPECT_TRUE(lists.opaque[i].cullsBackFaces) << "a material that is not double-sided";
  }
  EXPECT_EQ(lists.records.size(), 5u) << "AOVs need the ids of each";
  EXPECT_TRUE(lists.transparent.empty());
}

std::vector<glm::vec4> pictureOf(const Scene& scene, const RenderSettings& settings, const std::vector<Band>& rows,
                                 const std::vector<PixelSample>& samples = {PixelSample{}}) {
  const Plan plan = makePlan(scene, settings);
  GpuScene gpuScene(device(), scene, settings, flattenScene(scene, renderOrigin(scene.cameras[0]), false), nullptr);
  FilmSettings filmSettings{settings.width, settings.height, samples, false};
  filmSettings.rows = rows;
  Film film(device(), filmSettings);
  const std::unique_ptr<Technique> technique = makeRaster(device(), gpuScene, plan, settings, film.buffers());
  std::vector<glm::vec4> pixels(film.exposedPixels());
  Tally tally;
  film.expose(*technique, tally, [&](const ExposedPixels& some) {
    std::copy(some.picture.begin(), some.picture.end(), pixels.begin() + static_cast<std::ptrdiff_t>(some.first));
  });
  return pixels;
}

// Vulkan's standard positions of four samples (26.3, "Multisampling"): where each is lit by itself a pixel is the mean
// of four pictures that are lit there. Vertices lie on a grid of 1/256 pixel, onto which a moved picture rounds anew:
// that much of the texture's steepest slope, about 1 per pixel, is what may differ. Lit once per pixel it differs by
// tenfold.
TEST(SampleShading, lightsEverySampleWhereItLies) {
  const std::vector<std::uint32_t>& counts = device().info().msaaCounts;
  if (std::find(counts.begin(), counts.end(), 4u) == counts.end()) GTEST_SKIP() << "no MSAA 4";
  if (!device().info().hasSampleShading) GTEST_SKIP() << "no sample shading";
  const Scene scene = sceneNamed("feature/texture");
  RenderSettings settings = settingsFor(Method::phong, 64, 48);
  const std::vector<glm::vec4> four =
      pictureOf(scene, settings, {}, {{{0.375f, 0.125f}}, {{0.875f, 0.375f}}, {{0.125f, 0.625f}}, {{0.625f, 0.875f}}});
  settings.msaa = 4;
  const auto largestTo = [&](const std::vector<glm::vec4>& picture) {
    float largest = 0;
    for (std::size_t i = 0; i < four.size(); ++i) {
      for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(four[i][c] - picture[i][c]));
    }
    return largest;
  };
  EXPECT_GT(largestTo(pictureOf(scene, settings, {})), 8.0f / 256) << "the texture does not tell the two apart";
  settings.shadesPerSample = true;
  EXPECT_LE(largestTo(pictureOf(scene, settings, {})), 1.0f / 256);
}

// Rows of the picture drawn by themselves, in two pieces: through a target that is copied, not the film's own memory.
void expectPartsEqualTheWhole(const Scene& scene, const RenderSettings& settings) {
  const std::vector<glm::vec4> whole = pictureOf(scene, settings, {});
  const std::uint32_t cut = settings.height / 3;
  std::vector<glm::vec4> parts;
  for (const Band& rows : {Band{0, cut}, Band{cut, settings.height - cut}}) {
    const std::vector<glm::vec4> part = pictureOf(scene, settings, {rows});
    parts.insert(parts.end(), part.begin(), part.end());
  }
  ASSERT_EQ(whole.size(), parts.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) different += whole[i] == parts[i] ? 0 : 1;
  EXPECT_EQ(different, 0u);
  EXPECT_TRUE(std::any_of(whole.begin(), whole.end(), [&](const glm::vec4& p) { return p != whole[0]; }));
}

TEST(Strips, partsOfAPictureHaveTheBitsOfTheWhole) {
  const Scene scene = sceneNamed("showcase/spheres_checker");
  for (const Method method : {Method::wireframe, Method::flat, Method::gouraud, Method::phong}) {
    SCOPED_TRACE(nameOf(method));
    expectPartsEqualTheWhole(scene, settingsFor(method, 160, 120));
    expectPartsEqualTheWhole(scene, settingsFor(method, 33, 21));
  }
}

TEST(Strips, partsThatCrossStripsHaveTheBitsOfTheWhole) {
  const std::vector<std::uint32_t>& counts = device().info().msaaCounts;
  if (std::find(counts.begin(), counts.end(), 4u) == counts.end()) GTEST_SKIP() << "no MSAA 4";
  RenderSettings settings = settingsFor(Method::phong, 1600, 1400);
  settings.msaa = 4;
  ASSERT_LT(rowsPerStrip(settings.width, settings.height, settings.msaa), settings.height) << "more than one strip";
  expectPartsEqualTheWhole(sceneNamed("showcase/spheres_checker"), settings);
}

// As in specialized_test.cpp, for the methods that light vertices: what they pass on depends on the plan.
TEST(Specialized, vertexLightingEqualsTheFullOneBitForBit) {
  for (const std::string& name : allSceneNames()) {
    if (name.rfind("feature/", 0) != 0) continue;
    const Scene scene = sceneNamed(name);
    for (const Method method : {Method::flat, Method::gouraud}) {
      RenderSettings settings = settingsFor(method, 48, 36);
      settings.clampVertexColors = method == Method::flat;
      const Image specialized = render(device(), scene, settings).image;
      settings.allEffects = true;
      const Image full = render(device(), scene, settings).image;
      EXPECT_TRUE(specialized.picture().samples == full.picture().samples) << name << " by " << nameOf(method);
    }
  }
}

}  // namespace
}  // namespace crosslight::testing
