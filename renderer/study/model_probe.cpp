#include "study/model_probe.h"

#include <cmath>
#include <numbers>

#include "bindings.h"
#include "effects/effects.h"
#include "gpu/commands.h"
#include "upload/gpu_scene.h"

namespace crosslight::study {
Scene carrierOf(const Material& material) {
  Scene scene;
  scene.source = "made for a probe";
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

Material classicOf(IlluminationModel model, float kd, float ks, float shininess) {
  Material m;
  m.model = model;
  m.classic.ambientFactor = glm::vec3(0.0f);
  m.classic.diffuseFactor = glm::vec3(kd);
  m.classic.specularFactor = glm::vec3(ks);
  m.classic.shininess = shininess;
  return m;
}

glm::vec3 directionAt(double thetaDegrees, double phiDegrees) {
  const double t = thetaDegrees * std::numbers::pi / 180, p = phiDegrees * std::numbers::pi / 180;
  return glm::vec3(glm::dvec3(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)));
}

ModelQuestion questionOf(const glm::vec3& wo, const glm::vec3& wi) {
  ModelQuestion q;
  q.wo = {wo, 0.0f};
  q.wi = {wi, 0.0f};
  return q;
}

std::vector<glm::dvec3> askModel(const gpu::Device& device, const Material& material,
                                 const std::vector<ModelQuestion>& questions, const RenderSettings& settings,
                                 std::vector<TextureImage> images) {
  Scene scene = carrierOf(material);
  scene.images = std::move(images);
  const Plan plan = makePlan(scene, settings);
  GpuScene gpuScene(device, scene, settings, flattenScene(scene, glm::dvec3(0.0), false), nullptr);
  gpuScene.setSample(glm::vec2(0.5f));
  const gpu::BindingLayout layout(device, sceneBindings({shared::kBindRays, shared::kBindSampleColor}), 0);
  const gpu::ComputePipeline pipeline(device, layout, gpu::embeddedShader("model_probe.comp"), constantsOf(plan));
  const gpu::Buffer in = gpu::Buffer::of(device, "probes", questions, gpu::useStorage);
  const gpu::Buffer out(device, "answers", questions.size() * sizeof(glm::vec4), gpu::useStorage | gpu::useReadback);
  gpu::BindingSet set(device, layout);
  gpuScene.bind(set);
  set.set(shared::kBindRays, in);
  set.set(shared::kBindSampleColor, out);
  gpu::Commands commands(device);
  commands.begin();
  commands.bind(pipeline, set);
  commands.dispatch(static_cast<std::uint32_t>((questions.size() + 63) / 64));
  commands.barrier();
  commands.submitAndWait();
  std::vector<glm::dvec3> values;
  for (const glm::vec4& v : out.readAll<glm::vec4>()) values.emplace_back(glm::vec3(v));
  return values;
}

}  // namespace crosslight::study
