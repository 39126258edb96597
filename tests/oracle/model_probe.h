// Asks the shaders' illumination models, on the device, for single values: what a surface sends towards wo of a white
// light of unit intensity from wi.
#pragma once

#include <cstring>
#include <numbers>

#include "base/check.h"
#include "bindings.h"
#include "gpu/commands.h"
#include "support/render_fixture.h"
#include "upload/gpu_scene.h"

namespace crosslight::testing {

struct Probe {
  glm::vec4 normal{0, 0, 1, 0};  // w: bits of the material's index
  glm::vec4 tangent{1, 0, 0, 1};
  glm::vec4 wo{0, 0, 1, 0};  // w: u
  glm::vec4 wi{0, 0, 1, 0};  // w: v
};

// Unit, about z; rounded to floats, which is what both sides then compute with.
inline glm::vec3 directionAt(double thetaDegrees, double phiDegrees) {
  const double t = thetaDegrees * std::numbers::pi / 180, p = phiDegrees * std::numbers::pi / 180;
  return glm::vec3(glm::dvec3(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)));
}

inline Probe probeOf(const glm::vec3& wo, const glm::vec3& wi) {
  Probe p;
  p.wo = {wo, 0.0f};
  p.wi = {wi, 0.0f};
  return p;
}

// A triangle that nobody looks at carries the material.
inline Scene carrierOf(const Material& material) {
  Scene scene;
  scene.source = "made in a test";
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  p.normals.assign(3, {0, 0, 1});
  p.indices = {0, 1, 2};
  scene.meshes.push_back({"mesh", {p}});
  scene.materials.push_back(material);
  scene.instances.emplace_back();
  scene.instanceCount = 1;
  scene.cameras.emplace_back();
  scene.lights.emplace_back();
  return scene;
}

inline std::vector<glm::dvec3> probeModel(const Material& material, const std::vector<Probe>& probes,
                                          RenderSettings settings = settingsFor(Method::phong, 8, 8),
                                          std::vector<TextureImage> images = {}) {
  Scene scene = carrierOf(material);
  scene.images = std::move(images);
  const Plan plan = makePlan(scene, settings);
  GpuScene gpuScene(device(), scene, settings, flattenScene(scene, glm::dvec3(0.0), false), nullptr);
  gpuScene.setSample(glm::vec2(0.5f));
  const gpu::BindingLayout layout(device(), sceneBindings({shared::kBindRays, shared::kBindSampleColor}), 0);
  const gpu::ComputePipeline pipeline(device(), layout, gpu::embeddedShader("model_probe.comp"), constantsOf(plan));
  const gpu::Buffer in = gpu::Buffer::of(device(), "probes", probes, gpu::useStorage);
  const gpu::Buffer out(device(), "answers", probes.size() * sizeof(glm::vec4), gpu::useStorage | gpu::useReadback);
  gpu::BindingSet set(device(), layout);
  gpuScene.bind(set);
  set.set(shared::kBindRays, in);
  set.set(shared::kBindSampleColor, out);
  gpu::Commands commands(device());
  commands.begin();
  commands.bind(pipeline, set);
  commands.dispatch(static_cast<std::uint32_t>((probes.size() + 63) / 64));
  commands.barrier();
  commands.submitAndWait();
  std::vector<glm::dvec3> values;
  for (const glm::vec4& v : out.readAll<glm::vec4>()) values.emplace_back(glm::vec3(v));
  return values;
}

}  // namespace crosslight::testing
