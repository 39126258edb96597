#include <algorithm>
#include <array>
#include <bit>

#include "gpu_fixture.h"

namespace crosslight::gpu {
namespace {

struct Vertex {
  glm::vec4 clipPos;
  glm::vec4 color;
};

// Draws triangles of `Vertex` into a small image and reads it back.
class Canvas {
 public:
  Canvas(const Device& device, std::uint32_t width, std::uint32_t height, std::uint32_t samples = 1)
      : device_(&device),
        width_(width),
        color_(device, "color", ImageFormat::rgba32f, width, height, samples),
        depth_(device, "depth", ImageFormat::depth32f, width, height, samples),
        layout_(device, {}, 0),
        set_(device, layout_) {
    if (samples > 1) resolve_ = Image(device, "resolve", ImageFormat::rgba32f, width, height);
    state.samples = samples;
    state.vertex = embeddedShader("colored.vert");
    state.fragment = embeddedShader("colored.frag");
    state.buffers = {{sizeof(Vertex)}};
    state.attributes = {{0, 0, 0, VertexFormat::float4}, {1, 0, 16, VertexFormat::float4}};
  }

  RenderTargets targets() const {
    return {&color_, resolve_ ? &resolve_ : nullptr,     &depth_, ColorBefore::clear,
            true,    glm::vec4(0.25f, 0.5f, 0.75f, 1.0f)};
  }

  // Records one pass with everything in `vertices`; `before` may change the dynamic state.
  void draw(Commands& commands, const RenderTargets& into, const std::vector<Vertex>& vertices,
            const std::function<void(Commands&)>& before = {}) {
    pipelines_.emplace_back(*device_, layout_, state);
    std::vector<std::uint32_t> indices(vertices.size());
    for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    buffers_.push_back(Buffer::of(*device_, "vertices", vertices, useVertex));
    buffers_.push_back(Buffer::of(*device_, "indices", indices, useIndex));
    commands.beginRendering(into);
    commands.bind(pipelines_.back(), set_);
    commands.bindVertexBuffer(0, buffers_[buffers_.size() - 2]);
    commands.bindIndexBuffer(buffers_.back());
    if (before) before(commands);
    commands.drawIndexed(static_cast<std::uint32_t>(indices.size()), 0, 0, 0);
    commands.endRendering();
  }

  std::vector<glm::vec4> rows(Commands& commands, std::uint32_t first, std::uint32_t count) {
    const Buffer pixels(*device_, "pixels", std::uint64_t{16} * width_ * count, useReadback);
    commands.copyToBuffer(resolve_ ? resolve_ : color_, first, count, pixels);
    commands.submitAndWait();
    return pixels.readAll<glm::vec4>();
  }

  std::vector<glm::vec4> image(const std::vector<Vertex>& vertices, const std::function<void(Commands&)>& before = {}) {
    Commands commands(*device_);
    commands.begin();
    draw(commands, targets(), vertices, before);
    return rows(commands, 0, color_.height());
  }

  GraphicsState state;

 private:
  const Device* device_;
  std::uint32_t width_;
  Image color_, depth_, resolve_;
  BindingLayout layout_;
  BindingSet set_;
  std::vector<GraphicsPipeline> pipelines_;
  std::vector<Buffer> buffers_;
};

const glm::vec4 kClear(0.25f, 0.5f, 0.75f, 1.0f);
const glm::vec4 kRed(1, 0, 0, 1);
const glm::vec4 kGreen(0, 1, 0, 1);

// Covers the pixels left of clip x = `right`, counterclockwise as it appears (y points down in clip space).
std::vector<Vertex> leftPart(float right, float depth, const glm::vec4& color) {
  const glm::vec4 a(-1, -1, depth, 1), b(right, -1, depth, 1), c(right, 1, depth, 1), d(-1, 1, depth, 1);
  return {{a, color}, {d, color}, {c, color}, {a, color}, {c, color}, {b, color}};
}

std::vector<Vertex> joined(std::vector<Vertex> first, const std::vector<Vertex>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

TEST_F(GpuTest, ATriangleCoversExactlyThePixelsWhoseCentersLieInIt) {
  Canvas canvas(device(), 8, 8);
  // Right angle at the top left; its hypotenuse passes between pixel centers, through x + y = 4 pixels.
  const std::vector<Vertex> triangle{{{-1, -1, 0.5f, 1}, kRed}, {{-1, 0, 0.5f, 1}, kRed}, {{0, -1, 0.5f, 1}, kRed}};
  const auto pixels = canvas.image(triangle);
  for (std::uint32_t y = 0; y < 8; ++y) {
    for (std::uint32_t x = 0; x < 8; ++x) {
      const float sum = static_cast<float>(x + y) + 1.0f;  // of the center's coordinates
      if (sum == 4.0f) continue;                           // on the edge: the tie rule decides
      EXPECT_EQ(pixels[8 * y + x], sum < 4.0f ? kRed : kClear) << x << ", " << y;
    }
  }
}

TEST_F(GpuTest, ColorsAreInterpolatedOverTheTriangle) {
  Canvas canvas(device(), 16, 4);
  auto quad = leftPart(1.0f, 0.5f, glm::vec4(0));
  for (Vertex& vertex : quad) vertex.color = glm::vec4(0.5f * (vertex.clipPos.x + 1.0f), -3.0f, 1e6f, 0.0f);
  const auto pixels = canvas.image(quad);
  // Fixed-point vertex positions (1/256 pixel) and barycentric weights of 8 bits or better.
  constexpr float kTolerance = 1.0f / 256.0f;
  for (std::uint32_t x = 0; x < 16; ++x) {
    EXPECT_NEAR(pixels[x].r, (static_cast<float>(x) + 0.5f) / 16.0f, kTolerance);
    EXPECT_NEAR(pixels[x].g, -3.0f, 3.0f * kTolerance) << "floating-point targets are not clamped";
  }
}

TEST_F(GpuTest, TheDepthTestKeepsTheGreaterDepth) {
  const auto near = leftPart(1.0f, 0.75f, kRed), far = leftPart(1.0f, 0.25f, kGreen);
  Canvas canvas(device(), 4, 4);
  EXPECT_THAT(canvas.image(joined(near, far)), testing::Each(kRed));
  EXPECT_THAT(canvas.image(joined(far, near)), testing::Each(kRed));
  canvas.state.depthTest = DepthTest::off;
  EXPECT_THAT(canvas.image(joined(near, far)), testing::Each(kGreen));
  canvas.state.depthTest = DepthTest::greater;
  EXPECT_THAT(canvas.image(joined(leftPart(1, 0.5f, kRed), leftPart(1, 0.5f, kGreen))), testing::Each(kRed));
  canvas.state.depthTest = DepthTest::greaterOrEqual;
  EXPECT_THAT(canvas.image(joined(leftPart(1, 0.5f, kRed), leftPart(1, 0.5f, kGreen))), testing::Each(kGreen));
}

TEST_F(GpuTest, ADepthPrepassLeavesTheNearestSurfaceToTheEqualTest) {
  Canvas canvas(device(), 4, 4);
  const auto scene = joined(leftPart(1.0f, 0.75f, kRed), leftPart(1.0f, 0.25f, kGreen));
  Commands commands(device());
  commands.begin();
  RenderTargets depthOnly = canvas.targets();
  depthOnly.color = nullptr;
  const ShaderCode fragment = canvas.state.fragment;
  canvas.state.fragment = {};
  canvas.state.colorTarget = false;
  canvas.draw(commands, depthOnly, scene);
  canvas.state.fragment = fragment;
  canvas.state.colorTarget = true;
  canvas.state.depthTest = DepthTest::equal;
  canvas.state.depthWrite = false;
  RenderTargets second = canvas.targets();
  second.clearDepth = false;
  canvas.draw(commands, second, scene);
  EXPECT_THAT(canvas.rows(commands, 0, 4), testing::Each(kRed));
}

TEST_F(GpuTest, DepthBiasMovesASurfaceNearer) {
  const auto first = leftPart(1.0f, 0.5f, kRed), second = leftPart(1.0f, 0.5f, kGreen);
  Canvas canvas(device(), 4, 4);
  Commands commands(device());
  commands.begin();
  canvas.draw(commands, canvas.targets(), first);
  canvas.state.depthBiasConstant = 4.0f;
  RenderTargets again = canvas.targets();
  again.colorBefore = ColorBefore::keep;
  again.clearDepth = false;
  canvas.draw(commands, again, second);
  EXPECT_THAT(canvas.rows(commands, 0, 4), testing::Each(kGreen));
}

TEST_F(GpuTest, BackFacesAreCulledByTheWindingThatTheCallerNames) {
  Canvas canvas(device(), 4, 4);
  const auto quad = leftPart(1.0f, 0.5f, kRed);
  const auto culled = [&](bool clockwiseIsFront) {
    return canvas.image(quad, [&](Commands& c) { c.cull(Commands::Cull::back, clockwiseIsFront); });
  };
  EXPECT_THAT(culled(false), testing::Each(kRed));
  EXPECT_THAT(culled(true), testing::Each(kClear));
  EXPECT_THAT(canvas.image(quad, [](Commands& c) { c.cull(Commands::Cull::none, true); }), testing::Each(kRed));
}

TEST_F(GpuTest, PremultipliedColorsAreBlendedOver) {
  Canvas canvas(device(), 4, 4);
  canvas.state.blend = Blend::overPremultiplied;
  const glm::vec4 source(0.5f, 0.125f, 0.0f, 0.5f);
  // Powers of two: exact in floating point.
  EXPECT_THAT(canvas.image(leftPart(1.0f, 0.5f, source)), testing::Each(source + 0.5f * kClear));
}

TEST_F(GpuTest, PrimitiveIdsAndSpecializationReachTheFragmentShader) {
  Canvas canvas(device(), 4, 4);
  canvas.state.constants = {{0, 1}};
  const auto pixels = canvas.image(leftPart(1.0f, 0.5f, kGreen));
  EXPECT_EQ(pixels[4 * 3 + 0].r, 0.0f);  // bottom left: the first triangle
  EXPECT_EQ(pixels[3].r, 1.0f);          // top right: the second one
}

TEST_F(GpuTest, WireframesDrawOnlyEdges) {
  Canvas canvas(device(), 16, 16);
  canvas.state.polygonMode = PolygonMode::line;
  const std::vector<Vertex> triangle{
      {{-0.9f, -0.9f, 0.5f, 1}, kRed}, {{-0.9f, 0.9f, 0.5f, 1}, kRed}, {{0.9f, -0.9f, 0.5f, 1}, kRed}};
  const auto pixels = canvas.image(triangle);
  EXPECT_EQ(pixels[16 * 0 + 6], kRed);    // the top edge, y = 0.8 pixels
  EXPECT_EQ(pixels[16 * 5 + 5], kClear);  // inside
  EXPECT_EQ(pixels[16 * 14 + 14], kClear);
}

TEST_F(GpuTest, ResolvingAveragesTheSamples) {
  for (const std::uint32_t samples : device().info().msaaCounts) {
    if (samples == 1) continue;
    Canvas canvas(device(), 4, 4, samples);
    // The edge halves the second column. The rules for standard sample locations put half of them on either side.
    const auto pixels = canvas.image(leftPart(-0.25f, 0.5f, kRed));
    for (std::uint32_t y = 0; y < 4; ++y) {
      EXPECT_EQ(pixels[4 * y + 0], kRed);
      EXPECT_EQ(pixels[4 * y + 2], kClear);
      const float covered = (pixels[4 * y + 1].r - kClear.r) / (kRed.r - kClear.r);
      EXPECT_GT(covered, 0.0f);
      EXPECT_LT(covered, 1.0f);
      const float sampleCount = covered * static_cast<float>(samples);
      EXPECT_NEAR(sampleCount, std::round(sampleCount), 1e-4f) << "an average of whole samples, up to rounding";
    }
  }
}

TEST_F(GpuTest, BandsOfRowsAreDrawnAndReadBackByThemselves) {
  Canvas canvas(device(), 4, 8);
  Commands commands(device());
  commands.begin();
  RenderTargets targets = canvas.targets();
  commands.beginRendering(targets);
  commands.endRendering();
  commands.barrier();
  targets.firstRow = 2;
  targets.rowCount = 3;
  targets.colorBefore = ColorBefore::keep;
  canvas.draw(commands, targets, leftPart(1.0f, 0.5f, kRed));
  const auto pixels = canvas.rows(commands, 1, 5);
  ASSERT_EQ(pixels.size(), 20u);
  for (std::uint32_t y = 0; y < 5; ++y) {
    const bool inBand = y + 1 >= 2 && y + 1 < 5;
    for (std::uint32_t x = 0; x < 4; ++x) EXPECT_EQ(pixels[4 * y + x], inBand ? kRed : kClear) << x << ", " << y;
  }
}

TEST_F(GpuTest, AViewportOfRowsShowsThatPartOfThePicture) {
  // The lower half of a picture of 8 rows is red; the target holds its rows 2 to 5.
  const glm::vec4 a(-1, 0, 0.5f, 1), b(-1, 1, 0.5f, 1), c(1, 1, 0.5f, 1), d(1, 0, 0.5f, 1);
  const std::vector<Vertex> lowerHalf{{a, kRed}, {b, kRed}, {c, kRed}, {a, kRed}, {c, kRed}, {d, kRed}};
  Canvas canvas(device(), 4, 4);
  const auto pixels = canvas.image(lowerHalf, [](Commands& commands) { commands.viewportRows(2, 8); });
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 0; x < 4; ++x) EXPECT_EQ(pixels[4 * y + x], y + 2 < 4 ? kClear : kRed) << x << ", " << y;
  }
}

TEST_F(GpuTest, AnImageOverABufferIsTheBuffersContents) {
  const Buffer pixels(device(), "pixels", 16 * 8 * 8, useStorage);
  const Image picture = Image::over(device(), "picture", ImageFormat::rgba32f, pixels, 8, 8);
  if (!picture) GTEST_SKIP() << device().info().name << " does not lay out an image as a buffer";
  Canvas canvas(device(), 8, 8);
  Commands commands(device());
  commands.begin();
  RenderTargets targets = canvas.targets();
  targets.color = &picture;
  canvas.draw(commands, targets, leftPart(0.0f, 0.5f, kRed));
  commands.submitAndWait();
  const auto contents = pixels.readAll<glm::vec4>();
  for (std::uint32_t i = 0; i < 64; ++i) EXPECT_EQ(contents[i], i % 8 < 4 ? kRed : kClear) << i;
}

TEST_F(GpuTest, AnImageWhoseRowsABufferCannotHoldIsNotMade) {
  // 3 pixels are 48 bytes: llvmpipe begins rows at multiples of 64.
  const Buffer pixels(device(), "pixels", 16 * 3 * 3, useStorage);
  if (!device().info().isSoftware) GTEST_SKIP() << "of software devices";
  EXPECT_FALSE(Image::over(device(), "picture", ImageFormat::rgba32f, pixels, 3, 3));
}

TEST_F(GpuTest, ATargetOfIntegersKeepsTheirBits) {
  const Buffer memory(device(), "pixels", 4 * 16 * 4, useStorage);
  Image targets[] = {Image(device(), "integers", ImageFormat::r32ui, 16, 4),
                     Image::over(device(), "integers", ImageFormat::r32ui, memory, 16, 4)};
  const float value = 0.7f;
  for (const Image& target : targets) {
    if (!target) continue;  // the device cannot lay it out so
    Canvas canvas(device(), 16, 4);
    canvas.state.fragment = embeddedShader("bits.frag");
    canvas.state.colorFormat = ImageFormat::r32ui;
    RenderTargets into = canvas.targets();
    into.color = &target;
    Commands commands(device());
    commands.begin();
    EXPECT_THROW(canvas.draw(commands, into, leftPart(1.0f, 0.5f, kRed)), InternalError) << "no clear value";
    into.colorBefore = ColorBefore::undefined;
    canvas.draw(commands, into, leftPart(1.0f, 0.5f, glm::vec4(value, 0.0f, 0.0f, 0.0f)));
    const Buffer pixels(device(), "copy", 4 * 16 * 4, useReadback);
    commands.copyToBuffer(target, 0, 4, pixels);
    commands.submitAndWait();
    EXPECT_THAT(pixels.readAll<std::uint32_t>(), testing::Each(std::bit_cast<std::uint32_t>(value)));
  }
}

TEST_F(GpuTest, ASecondBatchKeepsWhatTheFirstOneDrew) {
  Canvas canvas(device(), 4, 4);
  Commands commands(device());
  commands.begin();
  canvas.draw(commands, canvas.targets(), leftPart(1.0f, 0.5f, kRed));
  EXPECT_THAT(canvas.rows(commands, 0, 4), testing::Each(kRed));
  commands.begin();
  RenderTargets more = canvas.targets();
  more.colorBefore = ColorBefore::keep;
  more.clearDepth = false;
  canvas.draw(commands, more, leftPart(0.0f, 0.75f, kGreen));
  const auto pixels = canvas.rows(commands, 0, 4);
  EXPECT_EQ(pixels[1], kGreen);
  EXPECT_EQ(pixels[2], kRed);
}

TEST_F(GpuTest, DrawingMisuseIsABrokenInvariant) {
  Canvas canvas(device(), 4, 4);
  Commands commands(device());
  commands.begin();
  RenderTargets unset = canvas.targets();
  unset.colorBefore = ColorBefore::keep;
  EXPECT_THROW(commands.beginRendering(unset), InternalError) << "keeps contents that never were";
  const Image wider(device(), "wider", ImageFormat::rgba32f, 5, 4);
  RenderTargets mixed = canvas.targets();
  mixed.color = &wider;
  EXPECT_THROW(commands.beginRendering(mixed), InternalError);
  EXPECT_THROW(commands.drawIndexed(3, 0, 0, 0), InternalError) << "outside of a pass";
  EXPECT_THROW(commands.copyToBuffer(wider, 0, 5, Buffer(device(), "pixels", 400, useReadback)), InternalError);
}

TEST_F(GpuTest, APipelineWithAnUnsupportedSampleCountNamesTheSupportedOnes) {
  Canvas canvas(device(), 4, 4);
  canvas.state.samples = 3;
  const std::string message = messageOf<DeviceError>([&] { canvas.image({}); });
  EXPECT_THAT(message, testing::HasSubstr("3 samples"));
  for (const std::uint32_t samples : device().info().msaaCounts) {
    EXPECT_THAT(message, testing::HasSubstr(std::to_string(samples)));
  }
}

}  // namespace
}  // namespace crosslight::gpu
