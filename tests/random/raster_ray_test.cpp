// Raster against rays on random scenes, of what both compute alike: the same objects in the same pixels, in the same
// light. Meshes instead of analytic shapes, no shadows, nothing that bends or mirrors light.
#include "cross/same_picture.h"
#include "random/random_pictures.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 72;
constexpr double kSameObject = 0.999;  // of interior pixels
constexpr double kSameLight = 2e-3;    // of the picture's largest value; half of it is where 8 bits of a display begin
constexpr std::uint64_t kFirst = 300;  // beyond those of the soundness test
constexpr std::uint64_t kScenes = 5, kAllScenes = 40;

// Known to differ, by up to 0.03: what shows through a transparent surface, all parts of its own light being equal. In
// 308 and 326 the environment shows through blended surfaces, in 332 bodies lie behind bodies in fog by depth. The
// cause is not found yet; that they differ is expected, so that their healing shows.
constexpr std::uint64_t kKnown[] = {308, 326, 332};

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

Image drawnBy(Method method, const RandomPicture& of) {
  RenderSettings settings = of.settings;
  settings.method = method;
  return render(device(), of.scene, settings).image;
}

double largestValue(const Image& image) {
  double largest = 1.0;
  for (const float v : image.picture().samples) largest = std::max(largest, static_cast<double>(v));
  return largest;
}

// Where a picture changes between a pixel and the four beside it by more than light does, there is an edge: of an
// object, of a texture of any kind, of what shows through. A position's last bits decide there.
constexpr double kEdge = 0.05;

bool isSmooth(const Image& image, std::uint32_t x, std::uint32_t y) {  // inside
  const auto here = pixelAt(image, x, y);
  for (const auto& [u, v] : {std::pair(x - 1, y), {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
    const auto there = pixelAt(image, u, v);
    for (std::size_t c = 0; c < 3; ++c) {
      if (!(std::abs(there[c] - here[c]) <= kEdge)) return false;
    }
  }
  return true;
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

void compare(std::uint64_t number, const RandomPicture& drawn, std::size_t& interior, std::size_t& same,
             std::size_t& compared) {
  const Image raster = drawnBy(Method::phong, drawn), rays = drawnBy(Method::whitted, drawn);
  const Interior insideRaster(raster), insideRays(rays);
  const Steady isSteady(raster, rays);
  std::size_t interiorHere = 0, sameHere = 0;
  const auto counts = [&](std::uint32_t x, std::uint32_t y) {
    if (!insideRaster(x, y) || !insideRays(x, y)) return false;
    ++interiorHere;
    if (insideRaster.idAt(x, y) != insideRays.idAt(x, y)) return false;
    ++sameHere;
    return isSteady(x, y) && isSmooth(raster, x, y) && isSmooth(rays, x, y);
  };
  const Difference d = largestDifference(raster, rays, counts);
  const bool agree = d.maximum <= kSameLight * largestValue(rays);
  const bool known = std::find(std::begin(kKnown), std::end(kKnown), number) != std::end(kKnown);
  EXPECT_NE(agree, known) << d << "; " << partsAt(raster, rays, d);
  interior += interiorHere;
  same += sameHere;
  compared += d.compared;
}

TEST(RandomRasterRay, showTheSameObjectsInTheSameLight) {
  setenv("GALLIVM_PERF", "nopt", 0);
  std::size_t interior = 0, same = 0, compared = 0;
  for (std::uint64_t number = kFirst; number < kFirst + sceneCount(); ++number) {
    const RandomPicture drawn = picture(number);
    SCOPED_TRACE(drawn.command);
    compare(number, drawn, interior, same, compared);
  }
  EXPECT_TRUE(static_cast<double>(same) >= kSameObject * static_cast<double>(interior))
      << same << " of " << interior << " interior pixels show the same object";
  EXPECT_GT(2 * compared, interior) << "too little was compared";
}

}  // namespace
}  // namespace crosslight::testing
