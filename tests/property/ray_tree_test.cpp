// A pixel's ray tree is the picture's own: its parts add up to the pixel, bit for bit, whatever the scene.
#include <glm/geometric.hpp>

#include "app/ray_tree_files.h"
#include "app/render_session.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 30;

class Trees {
 public:
  explicit Trees(const Scene& scene) : scene_(std::shared_ptr<const Scene>(), &scene), session_(device()) {}

  RenderResult at(const RenderSettings& settings, const glm::uvec2& pixel) {
    RenderRequest request{scene_, settings};
    request.rayTreePixel = pixel;
    return session_.render(request);
  }

 private:
  std::shared_ptr<const Scene> scene_;
  RenderSession session_;
};

class RayTrees : public ::testing::TestWithParam<std::string> {};

TEST_P(RayTrees, addUpToThePixelsBits) {
  const Scene scene = sceneNamed(GetParam());
  Trees trees(scene);
  for (const glm::uvec2& pixel : {glm::uvec2(20, 15), glm::uvec2(11, 22), glm::uvec2(39, 29)}) {
    const RenderResult result = trees.at(settingsFor(Method::whitted, kWidth, kHeight), pixel);
    const RayTree& tree = result.rayTree.value();
    const std::array<float, 4> shown = pixelAt(result.image, pixel.x, pixel.y);
    const std::array<float, 4> summed{tree.color.x, tree.color.y, tree.color.z, tree.color.w};
    EXPECT_EQ(shown, summed) << "pixel (" << pixel.x << ", " << pixel.y << "), " << tree.nodes.size() << " rays";
    // Each contribution is a product along the path, the pixel a sum of them: the same number but for rounding, at
    // most depth + 1 products and as many sums as there are rays.
    glm::dvec3 sum(0.0);
    for (const RayTreeNode& node : tree.nodes) sum += glm::dvec3(node.pathWeight * node.own);
    const double roundings = static_cast<double>(tree.nodes.size()) + 6.0;
    EXPECT_LE(glm::length(sum - glm::dvec3(tree.color)), roundings * 0x1p-23 * glm::length(sum));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RayTrees, ::testing::ValuesIn(allSceneNames()), [](const auto& i) {
  std::string name = i.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

// What a tree says of itself holds: rays begin where the one before met something, mirrors keep the angle, and what
// reaches a light is what the lights add.
TEST(RayTree, raysFollowOneAnother) {
  const Scene scene = sceneNamed("feature/refraction");
  const RenderResult result = Trees(scene).at(settingsFor(Method::whitted, 256, 192), {128, 110});
  const RayTree& tree = *result.rayTree;
  ASSERT_GT(tree.nodes.size(), 5u);
  EXPECT_EQ(tree.nodes[0].kind, RayKind::primary);
  for (std::size_t i = 1; i < tree.nodes.size(); ++i) {
    const RayTreeNode& node = tree.nodes[i];
    const RayTreeNode& parent = tree.nodes.at(node.parent.value());
    ASSERT_TRUE(parent.hit.has_value());
    EXPECT_EQ(node.depth, parent.depth + 1);
    EXPECT_EQ(node.kind == RayKind::reflection ? parent.reflected : parent.transmitted, i);
    // The offset against self-intersection: gamma_8 of coordinates below 8 in magnitude.
    EXPECT_LE(glm::length(node.origin - parent.hit->position), 8.0 * 8.0 * 0x1p-23);
    if (node.kind != RayKind::reflection) continue;
    const glm::dvec3 n(parent.hit->normal);
    EXPECT_NEAR(glm::dot(node.direction, n), -glm::dot(parent.direction, n), 8 * 0x1p-23);
  }
}

TEST(RayTree, jsonAndDrawingHoldEveryRay) {
  const Scene scene = sceneNamed("feature/mirror");
  const RenderResult result = Trees(scene).at(settingsFor(Method::whitted, 64, 48), {32, 24});
  const Json json = rayTreeJson(*result.rayTree, scene);
  ASSERT_EQ(json["nodes"].size(), result.rayTree->nodes.size());
  const std::string svg = rayTreeSvg(*result.rayTree, scene);
  std::size_t cards = 0;
  for (std::size_t at = svg.find("<g><rect"); at != std::string::npos; at = svg.find("<g><rect", at + 1)) ++cards;
  EXPECT_EQ(cards, result.rayTree->nodes.size());
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(RayTree, namesOfTheFileAreNoMarkup) {
  Scene scene = sceneNamed("feature/mirror");
  for (MeshInstance& m : scene.instances) m.name = "<script>&\"";
  for (ShapeInstance& s : scene.shapes) s.name = "<script>&\"";
  const RenderResult result = Trees(scene).at(settingsFor(Method::whitted, 64, 48), {32, 24});
  EXPECT_EQ(rayTreeSvg(*result.rayTree, scene).find("<script"), std::string::npos);
}

}  // namespace
}  // namespace crosslight::testing
