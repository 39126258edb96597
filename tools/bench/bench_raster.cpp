// One frame by each raster method against OSMesa on the same mesh, wall time of both: ours from recording to the
// picture in a buffer, OSMesa's from the clear to glFinish. Codes of 8 bits, as a picture for a display has them (ours
// sRGB, OSMesa's linear), against OSMesa's 8-bit RGBA; floats against its float RGBA. That all draw the same picture is
// checked first.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "base/time.h"
#include "bench/bench.h"
#include "bench/knot_scene.h"
#include "bench/osmesa_peer.h"
#include "raster/raster.h"
#include "scene/load.h"
#include "upload/records.h"

namespace crosslight::bench {
namespace {

struct Row {
  Method method;
  const char* name;
  GlShading shading;
};
constexpr Row kRows[] = {{Method::flat, "flat", GlShading::flat},
                         {Method::gouraud, "gouraud", GlShading::gouraud},
                         {Method::phong, "phong", GlShading::phong}};

// A channel rounded to 8 bits is off by half a step, and both sides' arithmetic may tip it once more. A pixel further
// off lies at an edge that the two rasterizers place differently: coordinates are rounded to 8 bits below a pixel, so
// edges differ by 1/256 pixel on either side, and silhouettes cross fewer than one pixel in ten: one pixel in 1000 at
// most.
constexpr double kOneStep = 1.0 / 255.0;
constexpr double kMostAtEdges = 1e-3;

// Vulkan's clip space (y down, depth 1 at the near plane and 0 far away) to OpenGL's (y up, -1 and +1).
glm::mat4 glFromVulkanClip() {
  glm::mat4 m(1.0f);
  m[1][1] = -1.0f;
  m[2][2] = -2.0f;
  m[3][2] = 1.0f;
  return m;
}

// One method ready to draw, in floats or as codes.
class OurFrame {
 public:
  OurFrame(const gpu::Device& device, const Scene& scene, Method method, std::uint32_t size,
           const std::optional<DisplayTransform>& shownBy)
      : settings_(settingsFor(method, size)),
        plan_(makePlan(scene, settings_)),
        gpuScene_(device, scene, settings_, flattenScene(scene, renderOrigin(scene.cameras[0]), false), nullptr),
        film_(device, {size, size, samplePattern(1, FilterShape::box, 0), false, {}, shownBy}),
        technique_(makeRaster(device, gpuScene_, plan_, settings_, film_.buffers())) {}

  // Wall milliseconds, and the device's own figure for the drawing, as `name` and `name`.device.
  Measured draw(const std::string& name) {
    Tally tally;
    const Stopwatch watch;
    technique_->renderSample({{0, settings_.height}, settings_.width, glm::vec2(0.5f), true, false}, tally);
    const double wallMs = watch.elapsedMs();
    double deviceMs = 0;
    for (const auto& [span, ms] : tally.spansMs()) deviceMs += ms;
    return {{name, wallMs}, {name + ".device", deviceMs}};
  }

  std::vector<std::uint32_t> codes() { return film_.buffers().sampleColor.readAll<std::uint32_t>(); }
  std::vector<glm::vec4> pixels() { return film_.buffers().sampleColor.readAll<glm::vec4>(); }

  static RenderSettings settingsFor(Method method, std::uint32_t size) {
    RenderSettings s = knotSettings(method, size, size);
    s.twoSided = TwoSided::material;  // back faces are culled on both sides
    return s;
  }

 private:
  RenderSettings settings_;
  Plan plan_;
  GpuScene gpuScene_;
  Film film_;
  std::unique_ptr<Technique> technique_;
};

// The spans point into `flat` and `normals`.
GlScene glSceneOf(const Scene& scene, const FlatScene& flat, const std::vector<glm::vec3>& normals,
                  const RenderSettings& settings) {
  const glm::dvec3 origin = renderOrigin(scene.cameras[0]);
  const ClassicMaterial& m = scene.materials[flat.draws[0].materialId].classic;
  const Light& light = scene.lights.front();
  GlScene gl;
  gl.positions = flat.positions;
  gl.normals = normals;
  gl.indices = flat.indices;
  gl.glClipFromRender = glFromVulkanClip() * makeFrameRecord(scene, settings, glm::vec2(0.5f)).clipFromRender;
  gl.sceneAmbient = scene.atmosphere.ambient;
  gl.ka = m.ambientFactor, gl.kd = m.diffuseFactor, gl.ks = m.specularFactor, gl.shininess = m.shininess;
  gl.lightPosition = glm::vec3(light.worldPosition - origin);
  gl.lightDiffuse = light.classic->diffuse;
  gl.lightSpecular = light.classic->specular;
  gl.lightAttenuation = light.classic->attenuation;
  return gl;
}

struct Difference {
  double rmse = 0;
  std::size_t pixelsApart = 0;
};

Difference differenceOf(const std::vector<glm::vec4>& ours, const std::vector<glm::vec4>& theirs) {
  Difference result;
  double sum = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    bool close = true;
    for (int c = 0; c < 3; ++c) {
      const double difference = std::clamp<double>(ours[i][c], 0.0, 1.0) - static_cast<double>(theirs[i][c]);
      close = close && std::abs(difference) <= kOneStep;
      sum += difference * difference;
    }
    if (!close) ++result.pixelsApart;
  }
  result.rmse = std::sqrt(sum / (3.0 * static_cast<double>(ours.size())));
  return result;
}

// Share of pixels that are not black: a check on two black pictures checks nothing.
double coverageOf(const std::vector<glm::vec4>& pixels) {
  const auto lit = std::count_if(pixels.begin(), pixels.end(), [](const glm::vec4& p) { return p.x > 0; });
  return static_cast<double>(lit) / static_cast<double>(pixels.size());
}

struct Peer {
  std::unique_ptr<OsmesaPeer> gl;
  const char* suffix;
  GlPixels format;
};
constexpr std::pair<GlPixels, const char*> kFormats[] = {{GlPixels::bytes, ".osmesa"},
                                                         {GlPixels::floats, ".osmesaFloat"}};

// Codes are what the display transform makes of the floats, bit for bit.
void checkCodes(Bench& bench, const std::string& name, OurFrame& shown, OurFrame& floats) {
  const std::vector<glm::vec4> pixels = floats.pixels();
  const std::vector<std::uint32_t> codes = shown.codes();
  std::size_t different = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) different += srgbCodeFromLinear(pixels[i][c]) == (codes[i] >> 8 * c & 0xffu) ? 0 : 1;
  }
  bench.report.addCheck(name, different == 0, {{"differentCodes", different}});
}

void checkPicture(Bench& bench, const std::string& name, OurFrame& frame, const std::vector<glm::vec4>& theirs) {
  const std::vector<glm::vec4> pixels = frame.pixels();
  const Difference d = differenceOf(pixels, theirs);
  const double coverage = coverageOf(pixels), most = kMostAtEdges * static_cast<double>(pixels.size());
  bench.report.addCheck(name, static_cast<double>(d.pixelsApart) <= most && coverage > 0.1,
                        {{"pixelsApart", d.pixelsApart}, {"rmse", d.rmse}, {"coverage", coverage}});
}

void timeFrames(Bench& bench, const std::string& ours, OurFrame& shown, OurFrame& floats, GlShading shading,
                const std::vector<Peer>& peers) {
  const std::string oursFloat = ours + "Float";
  std::vector<Contender> contenders{[&] { return shown.draw(ours); }, [&] { return floats.draw(oursFloat); }};
  shown.draw(ours);
  floats.draw(oursFloat);
  checkCodes(bench, ours + ".codes", shown, floats);
  for (const Peer& peer : peers) {
    const std::string theirs = ours + peer.suffix;
    contenders.push_back([&peer, shading, theirs] { return Measured{{theirs, peer.gl->frame(shading)}}; });
    peer.gl->frame(shading);
    checkPicture(bench, theirs + ".picture", floats, peer.gl->pixels());
  }
  const Rounds rounds = interleave(contenders, bench.rounds);
  for (const std::string& name : {ours, oursFloat}) {
    bench.report.addTime(name, rounds);
    bench.report.addTime(name + ".device", rounds);
  }
  for (const Peer& peer : peers) {
    bench.report.compare(peer.format == GlPixels::bytes ? ours : oursFloat, ours + peer.suffix, rounds, Quantity::time);
  }
}

void drawFrames(Bench& bench, std::uint32_t triangles, std::uint32_t size) {
  const std::string prefix = "raster." + shortCount(triangles) + ".";
  const Scene scene = loadScene(writeKnotScene(bench.scratch, triangles));
  const FlatScene flat = flattenScene(scene, renderOrigin(scene.cameras[0]), false);
  std::vector<glm::vec3> normals;
  for (const shared::VertexAttributes& a : flat.attributes) normals.push_back(a.renderNormal);
  std::vector<Peer> peers;
  for (const auto& [format, suffix] : kFormats) {
    if (!osmesaAvailable()) break;
    const GlScene gl = glSceneOf(scene, flat, normals, OurFrame::settingsFor(Method::flat, size));
    peers.push_back({std::make_unique<OsmesaPeer>(gl, size, size, format), suffix, format});
  }
  if (!peers.empty()) bench.report.addCheck(prefix + "osmesa", true, {{"renderer", peers.front().gl->renderer()}});
  for (const Row& row : kRows) {
    OurFrame shown(bench.device(), scene, row.method, size, DisplayTransform{});
    OurFrame floats(bench.device(), scene, row.method, size, std::nullopt);
    timeFrames(bench, prefix + row.name, shown, floats, row.shading, peers);
  }
}

}  // namespace

void benchRaster(Bench& bench) {
  if (!osmesaAvailable()) bench.report.omit("raster against OSMesa", kNoOsmesa);
  if (bench.quick) return drawFrames(bench, 2'000, 64);
  for (const std::uint32_t triangles : {10'000u, 100'000u}) drawFrames(bench, triangles, 1024);
  if (bench.large) drawFrames(bench, 1'000'000, 1024);
}

}  // namespace crosslight::bench
