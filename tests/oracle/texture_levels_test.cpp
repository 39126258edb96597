// The levels of textures as the device reads them, against the rule of shaders/material/texture.glsl in double, pixel
// by pixel; the levels themselves against means over the image; bumps against Blinn's formula.
#include "oracle/model_probe.h"
#include "upload/mip_levels.h"

namespace crosslight::testing {
namespace {

using glm::dvec3;

TEST(MipLevels, areMeansOfWhatTheyCover) {
  for (const auto& [width, height] : {std::pair{8u, 8u}, {7u, 5u}, {13u, 1u}, {6u, 2u}}) {
    std::vector<glm::vec4> texels;
    dvec3 sum(0);
    for (std::uint32_t i = 0; i < width * height; ++i) {
      texels.emplace_back(static_cast<float>(i % 7), static_cast<float>(i % 3), static_cast<float>(i), 1.0f);
      sum += dvec3(glm::vec3(texels.back()));
    }
    appendMipLevels(texels, 0, width, height);
    const dvec3 last{glm::vec3(texels.back())};
    const double scale = 1.0 / (width * height);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(last[c], sum[c] * scale, 1e-5 * (sum[c] * scale)) << width << "x" << height;
  }
  std::vector<glm::vec4> row = {glm::vec4(1), glm::vec4(2), glm::vec4(6)};  // one texel covers all three
  appendMipLevels(row, 0, 3, 1);
  EXPECT_EQ(row.size(), 4u);
  EXPECT_EQ(row.back(), glm::vec4(3));
}

constexpr std::uint32_t kSize = 32;

Scene floorScene(Mip mip) {
  Scene scene = carrierOf(Material{});
  Primitive& p = scene.meshes[0].primitives[0];
  // A floor to the horizon, two triangles of different shape; z runs away from the camera.
  p.positions = {{-40, 0, 2}, {40, 0, 2}, {40, 0, -200}, {-40, 0, -200}};
  p.normals.assign(4, {0, 1, 0});
  p.uv0 = {{0, 0}, {20, 0}, {20, 50}, {0, 50}};
  p.indices = {0, 1, 2, 0, 2, 3};
  Material& m = scene.materials[0];
  m.model = IlluminationModel::unlit;
  m.baseColorTexture.image = 0;
  m.baseColorTexture.mip = mip;
  TextureImage image{"checks", kSize, kSize, {}};
  for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
    const float v = ((i % kSize) + (i / kSize)) % 2 == 0 ? 1.0f : 0.0f;  // gray from level 1 on
    image.rgba.insert(image.rgba.end(), {v, v, v, 1.0f});
  }
  scene.images.push_back(std::move(image));
  scene.cameras[0].worldFromCamera[3] = {0, 1, 0, 1};
  scene.cameras[0].yFov = 1.0;
  return scene;
}

class TextureLevels : public ::testing::TestWithParam<Method> {};

// Checks of one texel: level 0 shows 0 or 1 (or between, by bilinear filtering), level 1 and above one half. Where the
// rule says level 1 or more every pixel is gray, in raster as in rays.
TEST_P(TextureLevels, beginWhereTheRuleSays) {
  constexpr std::uint32_t kWidth = 160, kHeight = 120;
  const Scene scene = floorScene(Mip::linear);
  const Image picture = render(device(), scene, settingsFor(GetParam(), kWidth, kHeight)).image;
  const double spread = 2 * std::tan(0.5) / kHeight;
  std::size_t gray = 0, sharp = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    const double down = (y + 0.5 - 0.5 * kHeight) * spread;
    if (down <= 0.006) continue;  // sky, and beyond the floor's end
    const double depth = 1 / down;
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const double right = (x + 0.5 - 0.5 * kWidth) * spread;
      if (std::abs(right * depth) > 39) continue;
      const double cosine = down / std::sqrt(1 + down * down + right * right);
      // Texture area per area: 20 / 80 by 50 / 202.
      const double footprint = depth * spread / cosine * std::sqrt(20.0 / 80.0 * 50.0 / 202.0);
      const double level = std::log2(footprint * kSize);
      const double value = static_cast<double>(pixelAt(picture, x, y)[0]);
      if (level >= 1) {
        ++gray;
        EXPECT_NEAR(value, 0.5, 2e-3) << x << ", " << y << " of level " << level;  // sRGB 0 and 1 are linear 0 and 1
        continue;
      }
      // Between levels 0 and 1 the checks fade by as much as the level says.
      EXPECT_LE(std::abs(value - 0.5), 0.5 * (1 - std::max(level, 0.0)) + 2e-3) << x << ", " << y;
      sharp += level <= 0.25 && std::abs(value - 0.5) > 0.1;
    }
  }
  EXPECT_GT(gray, 1000u);
  EXPECT_GT(sharp, 10u);
}

INSTANTIATE_TEST_SUITE_P(Each, TextureLevels, ::testing::Values(Method::phong, Method::whitted),
                         [](const auto& i) { return std::string(nameOf(i.param)); });

// A height map of h = a u + b v: its slope is the same everywhere, and so is Blinn's normal.
TEST(Bump, tiltsTheNormalByTheSlope) {
  Material m;
  m.model = IlluminationModel::lambert;
  m.classic.diffuseFactor = glm::vec3(1.0f);
  m.bumpTexture.image = 0;
  m.bumpTexture.wrapU = m.bumpTexture.wrapV = Wrap::clampToEdge;
  m.bumpFactor = 0.5f;
  const auto image = [] {
    TextureImage out{"ramp", 64, 64, {}};
    for (int i = 0; i < 64 * 64; ++i) {
      const float h = 0.4f * (static_cast<float>(i % 64) + 0.5f) / 64 + 0.2f * (static_cast<float>(i / 64) + 0.5f) / 64;
      out.rgba.insert(out.rgba.end(), {h, 0, 0, 1});
    }
    return out;
  };
  Probe probe = probeOf({0, 0, 1}, directionAt(40, 70));
  probe.wo.w = 0.4f;
  probe.wi.w = 0.6f;
  const dvec3 value = probeModel(m, {probe}, settingsFor(Method::phong, 8, 8), {image()})[0];
  // Texture coordinates are x and y of the plane: n is across (1, 0, 0.5 * 0.4) and (0, 1, 0.5 * 0.2).
  const dvec3 n = glm::normalize(glm::cross(dvec3(1, 0, 0.2), dvec3(0, 1, 0.1)));
  EXPECT_NEAR(value.x, glm::dot(n, dvec3(glm::vec3(probe.wi))), 1e-5);
}

}  // namespace
}  // namespace crosslight::testing
