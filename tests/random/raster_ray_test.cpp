// Raster against rays on random scenes, of what both compute alike: the same objects in the same pixels, in the same
// light. Meshes instead of analytic shapes, no shadows, nothing that bends or mirrors light.
#include <glm/gtc/matrix_transform.hpp>

#include "app/render_session.h"
#include "cross/same_picture.h"
#include "random/random_pictures.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 72;
constexpr double kSameObject = 0.999;  // of interior pixels
constexpr double kSameLight = 2e-3;    // of the picture's largest value; half of it is where 8 bits of a display begin
// Of interior pixels; the others lie at edges of textures or of what shows through.
constexpr double kLeastCompared = 0.9;
constexpr std::uint64_t kFirst = 300;  // beyond those of the soundness test
constexpr std::uint64_t kScenes = 5, kAllScenes = 40;

std::uint64_t sceneCount() {
  const char* wanted = std::getenv("CROSSLIGHT_RANDOM");
  return wanted != nullptr && wanted == std::string("all") ? kAllScenes : kScenes;
}

RandomPicture picture(std::uint64_t number) {
  RandomPicture drawn = randomPicture(number, "whitted");
  drawn.scene = asMeshes(std::move(drawn.scene));
  drawn.scene.shapes.clear();  // those without a mesh: raster would tessellate them
  RenderSettings& s = drawn.settings;
  s.width = kWidth;
  s.height = kHeight;
  s.spp = 1;
  s.filter = PixelFilter::box;
  s.maxDepth = 24;  // rays go straight on through as many surfaces as raster blends
  s.shadows = s.reflection = s.refraction = false;
  s.aovs = {"instanceId", "primitiveId", "materialId", "normal",  "albedo",
            "ambient",    "diffuse",     "specular",   "emission"};
  return drawn;
}

// The four pictures by rays of a camera that is turned, or moved if it is orthographic, by a 256th of a pixel. Raster
// rounds corners to that grid: an edge moves by up to sqrt(2) / 512 pixels across itself, which one of the four
// exceeds.
constexpr double kGrid = 1.0 / 256.0;

struct Pictures {
  Image raster, rays;
  std::vector<Image> aside;
};

Scene movedAside(Scene scene, const RenderSettings& settings, double x, double y) {
  Camera& camera = scene.cameras[static_cast<std::size_t>(settings.camera)];
  const double halfY = camera.orthographic ? camera.yMag : std::tan(0.5 * camera.yFov);
  const double pixel = 2.0 * halfY / settings.height;  // in the middle; at a distance of 1
  glm::dmat4 moved(1.0);
  if (camera.orthographic) {
    moved[3] = glm::dvec4(x * pixel, y * pixel, 0.0, 1.0);
  } else {
    moved = glm::rotate(moved, x * pixel, glm::dvec3(0, 1, 0));
    moved = glm::rotate(moved, y * pixel, glm::dvec3(1, 0, 0));
  }
  camera.worldFromCamera = camera.worldFromCamera * moved;
  return scene;
}

Pictures draw(const RandomPicture& of) {
  RenderSession session(device());
  Pictures pictures;
  const auto drawnBy = [&](Method method, Scene scene) {
    RenderSettings settings = of.settings;
    settings.method = method;
    return session.render({std::make_shared<const Scene>(std::move(scene)), settings}).image;
  };
  pictures.raster = drawnBy(Method::phong, of.scene);
  pictures.rays = drawnBy(Method::whitted, of.scene);
  for (const auto& [x, y] : {std::pair(kGrid, 0.0), {-kGrid, 0.0}, {0.0, kGrid}, {0.0, -kGrid}})
    pictures.aside.push_back(drawnBy(Method::whitted, movedAside(of.scene, of.settings, x, y)));
  return pictures;
}

double largestValue(const Image& image) {
  double largest = 1.0;
  for (const float v : image.picture().samples) largest = std::max(largest, static_cast<double>(v));
  return largest;
}

// There is no edge so near that rounding decides on which side of it the pixel lies: of an object, also behind a
// transparent one, of a texture of any kind, of a shadow.
bool isSteady(const Pictures& pictures, std::uint32_t x, std::uint32_t y, double most) {
  const auto here = pixelAt(pictures.rays, x, y);
  return std::all_of(pictures.aside.begin(), pictures.aside.end(), [&](const Image& image) {
    const auto there = pixelAt(image, x, y);
    double largest = 0.0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(double{there[c]} - double{here[c]}));
    return largest <= most;
  });
}

// What both have of the pixel where they differ most, to be told apart by.
std::string partsAt(const Image& raster, const Image& rays, const Difference& d) {
  std::ostringstream text;
  const std::size_t at = std::size_t{d.y} * raster.width + d.x;
  text << "material " << rays.find("materialId")->integers[at];
  for (const char* part : {"normal", "albedo", "ambient", "diffuse", "specular", "emission"}) {
    for (const Image* image : {&raster, &rays}) {
      const float* v = image->find(part)->samples.data() + 3 * at;
      text << (image == &raster ? std::string("; ") + part + " " : " and ") << v[0] << " " << v[1] << " " << v[2];
    }
  }
  return text.str();
}

struct Compared {
  std::size_t interior = 0, sameObject = 0, light = 0;
};

void compare(const RandomPicture& drawn, Compared& all) {
  const Pictures pictures = draw(drawn);
  const Image &raster = pictures.raster, &rays = pictures.rays;
  const Interior insideRaster(raster), insideRays(rays);
  const double most = kSameLight * largestValue(rays);
  const auto counts = [&](std::uint32_t x, std::uint32_t y) {
    if (!insideRaster(x, y) || !insideRays(x, y)) return false;
    ++all.interior;
    if (insideRaster.idAt(x, y) != insideRays.idAt(x, y)) return false;
    ++all.sameObject;
    return isSteady(pictures, x, y, most);
  };
  const Difference d = largestDifference(raster, rays, counts);
  EXPECT_TRUE(d.maximum <= most) << d << "; " << partsAt(raster, rays, d);
  all.light += d.compared;
}

TEST(RandomRasterRay, showTheSameObjectsInTheSameLight) {
  setenv("GALLIVM_PERF", "nopt", 0);
  Compared all;
  for (std::uint64_t number = kFirst; number < kFirst + sceneCount(); ++number) {
    const RandomPicture drawn = picture(number);
    SCOPED_TRACE(drawn.command);
    compare(drawn, all);
  }
  EXPECT_TRUE(static_cast<double>(all.sameObject) >= kSameObject * static_cast<double>(all.interior))
      << all.sameObject << " of " << all.interior << " interior pixels show the same object";
  EXPECT_GT(static_cast<double>(all.light), kLeastCompared * static_cast<double>(all.interior))
      << "too little was compared";
}

}  // namespace
}  // namespace crosslight::testing
