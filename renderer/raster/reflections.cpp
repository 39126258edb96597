#include "raster/reflections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/log.h"
#include "raster/raster.h"
#include "upload/flat_bvh.h"

namespace crosslight {

using namespace shared;

namespace {

using glm::dmat3;
using glm::dvec3;

std::uint32_t modeOf(const Plan& plan, const RenderSettings& settings) {
  const bool lit = settings.method != Method::wireframe;
  if (!lit || !plan.has(Effect::reflection) || settings.rasterReflections == RasterReflections::off)
    return kReflectionsOff;
  return settings.rasterReflections == RasterReflections::environment ? kReflectionsOfBackground
                                                                      : kReflectionsByPictures;
}

Camera& cameraOf(Scene& scene, const RenderSettings& settings) {
  return scene.cameras[static_cast<std::size_t>(settings.camera)];
}

glm::dmat4 placed(const dvec3& right, const dvec3& up, const dvec3& back, const dvec3& at) {
  glm::dmat4 m(dmat3(right, up, back));
  m[3] = glm::dvec4(at, 1.0);
  return m;
}

// What mirrored rays meet they light on the side that they see, and they reflect no further.
RenderSettings secondarySettings(RenderSettings s) {
  s.rasterReflections = RasterReflections::off;
  s.twoSided = TwoSided::always;
  s.msaa = 1;
  s.shadesPerSample = false;
  s.adaptiveError = 0;
  s.aovs.clear();
  return s;
}

double total(const Tally& tally) {
  double ms = 0;
  for (const auto& [name, spanMs] : tally.spansMs()) ms += spanMs;
  return ms;
}

}  // namespace

// A scene as something else than the camera sees it. Its parts refer to each other: it never moves.
struct Reflections::View {
  Scene scene;
  RenderSettings settings;
  Plan plan;
  FilmBuffers buffers;
  std::unique_ptr<GpuScene> onDevice;
  std::unique_ptr<Technique> raster;
};

Reflections::~Reflections() = default;

Reflections::Reflections(const gpu::Device& device, const GpuScene& scene, const Plan& plan,
                         const RenderSettings& settings, const FilmBuffers& film)
    : device_(device),
      scene_(scene),
      settings_(settings),
      mode_(modeOf(plan, settings)),
      bandPixels_(film.sampleColor.sizeBytes() / sizeof(glm::vec4)),
      commands_(device) {
  if (mode_ != kReflectionsByPictures) return;
  const Camera& camera = scene.scene().cameras[static_cast<std::size_t>(settings.camera)];
  std::optional<dvec3> view;
  if (camera.orthographic) view = -glm::normalize(dvec3(camera.worldFromCamera[2]));
  plan_ = planReflectors(scene.flat(), scene.scene(), settings, view);
  if (plan_.leftOut > 0) {
    logWarning(fmt::format("{} mirrors beyond {} flat ones and {} others, the smallest, show the background alone",
                           plan_.leftOut, kMostPlanes, kMostProbes));
  }
  if (!plan_.planes.empty() && hasSmoke(scene.scene().atmosphere.smoke))
    logWarning("flat mirrors show no smoke; whitted does, and cube maps (raster-reflections=probes) about where it is");
  for (const MirrorPlane& plane : plan_.planes) pictures_.push_back(pictureOf(plane));
  const std::uint64_t texels = plan_.planes.size() * bandPixels_ + plan_.probes.size() * cubePixels();
  if (texels > device.info().maxTexelBufferElements) {
    throw DeviceError(
        fmt::format("the pictures of {} flat mirrors and {} probes of {} pixels take {} texels, '{}' reads "
                    "at most {}: a smaller picture, a smaller probe-size or raster-reflections=environment",
                    plan_.planes.size(), plan_.probes.size(), settings.probeSize, texels, device.info().name,
                    device.info().maxTexelBufferElements));
  }
  texels_ = gpu::Buffer(device, "mirror images", std::max<std::uint64_t>(texels, 1) * sizeof(glm::vec4),
                        gpu::useUniformTexel);
  makeRecords();
}

std::uint64_t Reflections::firstOfProbe(std::size_t probe) const {
  return plan_.planes.size() * bandPixels_ + probe * cubePixels();
}

void Reflections::makeRecords() {
  const FlatScene& flat = scene_.flat();
  std::vector<Reflector> records(std::max<std::size_t>(1, flat.draws.size()));
  for (std::size_t d = 0; d < plan_.ofDraw.size(); ++d) {
    const ReflectorPlan::Choice& choice = plan_.ofDraw[d];
    Reflector& r = records[d];
    if (choice.plane) {
      r.kind = kReflectorPicture;
      r.firstTexel = static_cast<std::uint32_t>(*choice.plane * bandPixels_);
    } else if (choice.probe) {
      r.kind = kReflectorCube;
      r.firstTexel = static_cast<std::uint32_t>(firstOfProbe(*choice.probe));
      r.size = settings_.probeSize;
      r.center = glm::vec3(plan_.probes[*choice.probe].center);
      r.lower = flat.bounds.lower;
      r.upper = flat.bounds.upper;
    }
  }
  records_ = gpu::Buffer::of(device_, "reflectors", records, gpu::useStorage);
}

std::unique_ptr<Reflections::View> Reflections::viewOf(Scene scene, RenderSettings settings,
                                                       std::uint64_t pixels) const {
  auto view = std::make_unique<View>();
  view->scene = std::move(scene);
  view->settings = std::move(settings);
  view->plan = makePlan(view->scene, view->settings, InView::all);  // for all faces of a probe
  FlatScene flat = flattenScene(view->scene, renderOrigin(cameraOf(view->scene, view->settings)), false,
                                view->plan.has(Effect::triangles));
  FlatBvh bvh;
  if (rasterSendsRays(view->plan, view->settings))
    bvh = buildFlatBvh(flat, view->scene, view->settings, {.wide = false, .quad = false});
  view->onDevice = std::make_unique<GpuScene>(device_, view->scene, view->settings, std::move(flat), &bvh);
  view->scene.meshes.clear();  // the device has it all
  view->scene.images.clear();
  view->buffers.sampleColor = gpu::Buffer(device_, "mirror image", pixels * sizeof(glm::vec4), gpu::useStorage);
  view->buffers.aovs = gpu::Buffer(device_, "AOV records", sizeof(AovRecord), gpu::useStorage);
  view->buffers.counters = gpu::Buffer::of(device_, "counters", std::vector<std::uint32_t>(kCounterCount, 0u),
                                           gpu::useStorage | gpu::useReadback);
  view->raster = makeRaster(device_, *view->onDevice, view->plan, view->settings, view->buffers);
  return view;
}

// The camera behind the mirror is no mirror image itself: its right is turned back, which turns the picture over.
std::unique_ptr<Reflections::View> Reflections::pictureOf(const MirrorPlane& plane) const {
  Scene scene = scene_.scene();
  Camera& camera = cameraOf(scene, settings_);
  const auto turned = [&](const dvec3& v) { return v - 2.0 * glm::dot(plane.normal, v) * plane.normal; };
  const dmat3 axes(camera.worldFromCamera);
  const dvec3 origin(camera.worldFromCamera[3]);
  // The eye is the origin of render space, and plane.offset its distance.
  camera.worldFromCamera =
      placed(-turned(axes[0]), turned(axes[1]), turned(axes[2]), origin + 2.0 * plane.offset * plane.normal);
  // The mirror itself, which lies in the plane, stays out of its picture.
  camera.clipPlane = glm::dvec4(plane.normal, glm::dot(plane.normal, origin) + plane.offset + plane.margin);
  scene.atmosphere.smoke = {};  // that behind the mirror would be before its picture
  return viewOf(std::move(scene), secondarySettings(settings_), bandPixels_);
}

std::unique_ptr<Reflections::View> Reflections::cubeOf(const ProbePlace& probe) const {
  Scene scene = scene_.scene();
  std::erase_if(scene.instances, [&](const MeshInstance& i) { return i.instanceId == probe.instanceId; });
  std::erase_if(scene.shapes, [&](const ShapeInstance& s) { return s.instanceId == probe.instanceId; });
  RenderSettings settings = secondarySettings(settings_);
  settings.width = settings.height = settings.probeSize;
  Camera& camera = cameraOf(scene, settings);
  camera.orthographic = false;
  camera.yFov = 2.0 * std::atan(settings.probeSize / (settings.probeSize - 2.0));  // a border of one pixel
  camera.worldFromCamera = placed({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, scene_.flat().origin + probe.center);
  return viewOf(std::move(scene), settings, facePixels());
}

std::vector<gpu::Binding> Reflections::bindings() const {
  if (mode_ != kReflectionsByPictures) return {};
  return {{kBindReflectors, gpu::BindingType::storageBuffer}, {kBindReflected, gpu::BindingType::texelBufferFloat4}};
}

gpu::Constants Reflections::constants() const { return {{kSpecReflections, mode_}}; }

void Reflections::bind(gpu::BindingSet& set) const {
  if (mode_ != kReflectionsByPictures) return;
  set.set(kBindReflectors, records_);
  set.set(kBindReflected, texels_);
}

void Reflections::copy(const View& view, std::uint64_t texel, std::uint64_t pixels, Tally& tally) {
  commands_.begin();
  commands_.barrier();
  commands_.beginSpan("copy");
  commands_.copy(view.buffers.sampleColor, 0, texels_, texel * sizeof(glm::vec4), pixels * sizeof(glm::vec4));
  commands_.endSpan();
  commands_.barrier();
  commands_.submitAndWait();
  tally.add(commands_.spans());
}

// One after the other, so that one copy of the scene at a time is there.
void Reflections::drawCube(std::size_t probe, Tally& tally) {
  const std::unique_ptr<View> view = cubeOf(plan_.probes[probe]);
  Camera& camera = cameraOf(view->scene, view->settings);
  const dvec3 at(camera.worldFromCamera[3]);
  for (int face = 0; face < 6; ++face) {
    const int a = face / 2;
    const double side = face % 2 == 0 ? 1.0 : -1.0;
    dvec3 forward(0.0), right(0.0), up(0.0);
    forward[a] = side;
    right[(a + 1) % 3] = 1.0;
    up[(a + 2) % 3] = -side;
    camera.worldFromCamera = placed(right, up, -forward, at);
    SampleRequest request{{0, settings_.probeSize}, settings_.probeSize};
    request.pixels = facePixels();
    view->raster->renderSample(request, tally);
    copy(*view, firstOfProbe(probe) + static_cast<std::uint64_t>(face) * facePixels(), facePixels(), tally);
  }
}

void Reflections::draw(const SampleRequest& request, Tally& tally) {
  if (mode_ != kReflectionsByPictures || !request.color) return;
  Tally own;
  for (std::size_t i = 0; !cubesDrawn_ && i < plan_.probes.size(); ++i) drawCube(i, own);
  cubesDrawn_ = true;
  SampleRequest turned = request;
  turned.aovs = false;
  turned.offset.x = 1.0f - request.offset.x;
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    pictures_[i]->raster->renderSample(turned, own);
    copy(*pictures_[i], i * bandPixels_, std::uint64_t{request.band.rowCount} * settings_.width, own);
  }
  tally.add({{"reflections", total(own)}});
}

std::string Reflections::promise() const {
  if (mode_ == kReflectionsOff) return "no reflection";
  if (mode_ == kReflectionsOfBackground) return "mirrors show the background, whatever stands before it";
  const std::string cubes = "by cube maps from their middle, taken to lie on the scene's box, without themselves";
  if (settings_.rasterReflections == RasterReflections::probes) return "mirrors " + cubes + ", one reflection deep";
  return "flat mirrors exactly, others " + cubes + ", one reflection deep";
}

std::map<std::string, std::uint64_t> Reflections::counters() const {
  return {{"mirrorPictures", plan_.planes.size()}, {"probes", plan_.probes.size()}};
}

}  // namespace crosslight
