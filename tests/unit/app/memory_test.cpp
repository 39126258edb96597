// What does not fit is refused with its figures and a remedy that works; the estimate grows with what it is made of.
#include <gmock/gmock.h>

#include "app/render_checks.h"
#include "base/error.h"

namespace crosslight {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30;

gpu::DeviceInfo anyDevice() {
  gpu::DeviceInfo info;
  info.name = "any";
  info.maxStorageBufferBytes = std::uint64_t{1} << 27;
  info.maxWorkGroupCountX = 65535;
  return info;
}

RenderRequest requestFor(Method method, std::uint32_t side) {
  RenderRequest request;
  request.scene = std::make_shared<Scene>();
  request.settings.method = method;
  request.settings.width = request.settings.height = side;
  return request;
}

std::string refusal(const MemoryNeed& need, const MemoryLimits& limits, const RenderSettings& settings = {}) {
  try {
    checkMemory(need, limits, settings);
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "";
}

TEST(MemoryNeed, ofAPictureIsItsLayersAndItsFile) {
  RenderRequest request = requestFor(Method::whitted, 1024);
  const MemoryNeed plain = memoryNeedOf(anyDevice(), request);
  EXPECT_EQ(plain.hostPictureBytes, std::uint64_t{1024} * 1024 * 16);
  request.fileBytesPerPixel = 8;
  request.settings.aovs = {"depth", "normal", "instanceId"};
  EXPECT_EQ(memoryNeedOf(anyDevice(), request).hostPictureBytes, std::uint64_t{1024} * 1024 * (16 + 4 + 12 + 4 + 8));
  EXPECT_GT(memoryNeedOf(anyDevice(), request).devicePictureBytes, plain.devicePictureBytes);
}

TEST(MemoryNeed, ofAPartIsItsShare) {
  RenderRequest request = requestFor(Method::whitted, 1024);
  const std::uint64_t whole = memoryNeedOf(anyDevice(), request).hostPictureBytes;
  request.rows = {{0, 128}, {512, 128}};
  EXPECT_EQ(memoryNeedOf(anyDevice(), request).hostPictureBytes, whole / 4);
}

// Bands bound the film, and strips the targets of raster methods, whatever the picture's size.
TEST(MemoryNeed, onTheDeviceIsBoundedWhateverThePicturesSize) {
  for (const Method method : {Method::whitted, Method::phong}) {
    EXPECT_LT(memoryNeedOf(anyDevice(), requestFor(method, 65536)).devicePictureBytes, kGiB);
  }
  RenderRequest multisampled = requestFor(Method::phong, 1024);
  const std::uint64_t plain = memoryNeedOf(anyDevice(), multisampled).devicePictureBytes;
  multisampled.settings.msaa = 4;
  EXPECT_EQ(memoryNeedOf(anyDevice(), multisampled).devicePictureBytes - plain,
            std::uint64_t{1024} * 1024 * (3 * 20 + 16));
}

TEST(MemoryNeed, ofASceneGrowsWithItsTrianglesAndMoreForRays) {
  Scene scene;
  scene.stats.triangles = 1'000'000;
  scene.stats.vertices = 500'000;
  RenderRequest rays = requestFor(Method::whitted, 16), raster = requestFor(Method::phong, 16);
  rays.scene = raster.scene = std::make_shared<Scene>(scene);
  EXPECT_GT(memoryNeedOf(anyDevice(), raster).deviceSceneBytes, 1'000'000u * 12);
  EXPECT_GT(memoryNeedOf(anyDevice(), rays).deviceSceneBytes, memoryNeedOf(anyDevice(), raster).deviceSceneBytes);
}

TEST(MemoryCheck, letsPassWhatFitsExactly) {
  const MemoryNeed need{4 * kGiB, kGiB, 2 * kGiB, kGiB};
  EXPECT_EQ(refusal(need, {8 * kGiB, 0, true}), "");
  EXPECT_NE(refusal(need, {8 * kGiB - 1, 0, true}), "");
  EXPECT_EQ(refusal(need, {5 * kGiB, 3 * kGiB, false}), "");
  EXPECT_NE(refusal(need, {5 * kGiB, 3 * kGiB - 1, false}), "");
  EXPECT_NE(refusal(need, {5 * kGiB - 1, 3 * kGiB, false}), "");
}

TEST(MemoryCheck, namesFiguresAndTheNumberOfPartsThatFits) {
  const MemoryNeed need{30 * kGiB, kGiB, kGiB, 0};
  RenderSettings settings;
  settings.width = settings.height = 40000;
  settings.aovs = {"depth"};
  const std::string text = refusal(need, {12 * kGiB, 0, true}, settings);
  for (const char* words : {"40000x40000", "30.0 GiB", "32.0 GiB", "12.0 GiB", "--resolution", "--aov"}) {
    EXPECT_THAT(text, HasSubstr(words));
  }
  // 10 GiB are left for 30 GiB of picture.
  EXPECT_THAT(text, HasSubstr("--part 1/3,"));
  MemoryNeed share = need;
  share.hostPictureBytes /= 3;
  EXPECT_EQ(refusal(share, {12 * kGiB, 0, true}, settings), "");
}

TEST(MemoryCheck, suggestsNoPartsWhereTheyDoNotHelp) {
  const MemoryNeed need{kGiB, 20 * kGiB, 0, 0};
  EXPECT_THAT(refusal(need, {12 * kGiB, 0, true}), Not(HasSubstr("--part")));
  EXPECT_THAT(refusal({0, 0, 20 * kGiB, 0}, {12 * kGiB, 8 * kGiB, false}), Not(HasSubstr("--part")));
}

TEST(MemoryCheck, findsSomethingAvailableHere) {
  EXPECT_GT(availableHostBytes(), std::uint64_t{1} << 20);
  EXPECT_LT(availableHostBytes(), std::uint64_t{1} << 50) << "/proc/meminfo was not understood";
}

TEST(Lists, thatShadersCannotReadAreRefusedBeforeAnythingIsBuilt) {
  gpu::DeviceInfo info = anyDevice();
  info.maxTexelBufferElements = 3000;  // a thousand triangles of a tree
  const auto refused = [&](Method method, std::uint64_t triangles, std::uint64_t vertices, std::uint64_t saved = 0) {
    RenderRequest request = requestFor(method, 16);
    auto scene = std::make_shared<Scene>();
    scene->stats.triangles = triangles;
    scene->stats.vertices = vertices;
    request.scene = scene;
    try {
      checkLists(info, request, saved);
    } catch (const DeviceError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(Method::whitted, 1000, 750), "");
  EXPECT_THAT(refused(Method::whitted, 1001, 750), AllOf(HasSubstr("1001 triangles"), HasSubstr("at most 1000")));
  EXPECT_THAT(refused(Method::phong, 10, 751), AllOf(HasSubstr("751 vertices"), HasSubstr("at most 750")));
  EXPECT_EQ(refused(Method::phong, 1001, 750), "") << "no tree";
  EXPECT_EQ(refused(Method::whitted, 2000, 750, 1000), "") << "shared";
}

}  // namespace
}  // namespace crosslight
