// The lecture's sphere exercise against its closed form, and what tessellation costs.
//
// P = (0, 2, 0), N = V = (0, 1, 0), L = (-+1, 1, 0) / sqrt 2, so N.L = cos 45 deg. Ambient 0.5 * 0.1; diffuse 0.5 N.L =
// sqrt 2 / 4; R.V = 0 + cos 45 deg * sqrt 2 * ... = cos 45 deg, to the tenth 1/32; N.H = cos 22.5 deg, to the tenth
// (58 + 41 sqrt 2) / 256. Each light reaches one channel; green has the ambient term alone.
#include <cmath>

#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

const double kAmbient = 0.05;
const double kDiffuse = std::sqrt(2.0) / 4.0;
const double kPhong = kAmbient + kDiffuse + 0.6 / 32.0;
const double kBlinnPhong = kAmbient + kDiffuse + 0.6 * (58.0 + 41.0 * std::sqrt(2.0)) / 256.0;
constexpr double kRequired = 1e-6;   // of the issue: 17 ulp of 0.42
constexpr std::uint32_t kSize = 65;  // odd: a pixel's center lies on P

std::array<float, 4> centerOf(const std::string& scene, Method method) {
  const RenderResult result = render(device(), sceneNamed(scene), settingsFor(method, kSize, kSize));
  return pixelAt(result.image, kSize / 2, kSize / 2);
}

void expectExercise(const std::array<float, 4>& pixel, double redAndBlue) {
  EXPECT_NEAR(pixel[0], redAndBlue, kRequired);
  EXPECT_NEAR(pixel[1], kAmbient, kRequired);
  EXPECT_NEAR(pixel[2], redAndBlue, kRequired);
  EXPECT_EQ(pixel[3], 1.0f);
}

TEST(Exercise, analyticSphereGivesTheClosedFormWithPhong) {
  EXPECT_NEAR(kPhong, 0.422303390593273762, 1e-15);
  expectExercise(centerOf("analytic/exercise_phong", Method::whitted), kPhong);
}

TEST(Exercise, analyticSphereGivesTheClosedFormWithBlinnPhong) {
  EXPECT_NEAR(kBlinnPhong, 0.675387975102563365, 1e-15);
  expectExercise(centerOf("analytic/exercise_blinn_phong", Method::whitted), kBlinnPhong);
}

// Root mean square of (mesh - sphere) over the pixels in the middle third, where both see the sphere.
double meshError(const std::string& scene, Method method) {
  constexpr std::uint32_t kImage = 129;
  const Image exact =
      render(device(), sceneNamed("analytic/exercise_phong"), settingsFor(Method::whitted, kImage, kImage)).image;
  const Image mesh = render(device(), sceneNamed(scene), settingsFor(method, kImage, kImage)).image;
  double sum = 0;
  std::size_t count = 0;
  for (std::uint32_t y = kImage / 3; y < 2 * kImage / 3; ++y) {
    for (std::uint32_t x = kImage / 3; x < 2 * kImage / 3; ++x) {
      for (std::size_t c = 0; c < 3; ++c, ++count) sum += std::pow(pixelAt(mesh, x, y)[c] - pixelAt(exact, x, y)[c], 2);
    }
  }
  return std::sqrt(sum / static_cast<double>(count));
}

class MeshOrder : public ::testing::TestWithParam<Method> {};

// Error of an interpolating method falls with the square of the edge length: four times the segments, sixteen times
// less. Half of the ideal factor leaves room for the coarsest mesh, which is not yet in the asymptotic range.
TEST_P(MeshOrder, isQuadraticInTheEdgeLength) {
  const double coarse = meshError("analytic/exercise_phong_16", GetParam());
  const double middle = meshError("analytic/exercise_phong_64", GetParam());
  const double fine = meshError("analytic/exercise_phong_256", GetParam());
  RecordProperty("rmse16", std::to_string(coarse));
  RecordProperty("rmse64", std::to_string(middle));
  RecordProperty("rmse256", std::to_string(fine));
  EXPECT_GT(coarse, 8 * middle) << coarse << " " << middle << " " << fine;
  EXPECT_GT(middle, 8 * fine) << coarse << " " << middle << " " << fine;
  EXPECT_GT(fine, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Interpolating, MeshOrder, ::testing::Values(Method::gouraud, Method::phong),
                         [](const auto& i) { return std::string(nameOf(i.param)); });

// Flat shading takes one vertex's color for a whole triangle: first order only, which is why it is the coarsest.
TEST(Exercise, flatShadingConvergesLinearly) {
  const double middle = meshError("analytic/exercise_phong_64", Method::flat);
  const double fine = meshError("analytic/exercise_phong_256", Method::flat);
  EXPECT_GT(middle, 2 * fine);
  EXPECT_LT(middle, 8 * fine);
}

// On a plane with a directional light and an infinite viewer nothing varies: the lecture's three conditions for flat
// shading to be exact. All methods then agree.
class PlaneMethods : public ::testing::TestWithParam<Method> {};

TEST_P(PlaneMethods, agreeWithPhongUnderTheThreeConditions) {
  const auto draw = [](Method method) {
    RenderSettings s = settingsFor(method, 96, 64);
    s.infiniteViewer = true;
    return render(device(), sceneNamed("analytic/plane_directional"), s).image;
  };
  const Image phong = draw(Method::phong);
  const Image other = draw(GetParam());
  const Difference d = largestDifference(phong, other, [&](std::uint32_t x, std::uint32_t y) {
    return pixelAt(phong, x, y)[3] == 1.0f && pixelAt(other, x, y)[3] == 1.0f;
  });
  EXPECT_GT(d.compared, 1000u);
  EXPECT_TRUE(d.maximum <= kRequired) << d;
}

INSTANTIATE_TEST_SUITE_P(Each, PlaneMethods, ::testing::Values(Method::flat, Method::gouraud, Method::whitted),
                         [](const auto& i) { return std::string(nameOf(i.param)); });

}  // namespace
}  // namespace crosslight::testing
