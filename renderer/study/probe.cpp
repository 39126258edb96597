#include "study/probe.h"

#include "gpu/commands.h"

namespace crosslight::study {
namespace {

template <class Answer, class Argument>
std::vector<Answer> ask(const gpu::Device& device, const char* shader, std::uint32_t which,
                        const std::vector<Argument>& arguments, const std::vector<glm::vec3>& corners) {
  using gpu::BindingType;
  const gpu::BindingLayout layout(device,
                                  {{shared::kBindProbeArguments, BindingType::storageBuffer},
                                   {shared::kBindProbeAnswers, BindingType::storageBuffer},
                                   {shared::kBindProbeTriangles, BindingType::storageBuffer}},
                                  0);
  const gpu::ComputePipeline pipeline(device, layout, gpu::embeddedShader(shader), {{shared::kSpecProbe, which}});
  const gpu::Buffer in = gpu::Buffer::of(device, "probe arguments", arguments, gpu::useStorage);
  const gpu::Buffer triangles = gpu::Buffer::of(device, "probe triangles", corners, gpu::useStorage);
  const gpu::Buffer out(device, "probe answers", arguments.size() * sizeof(Answer), gpu::useStorage | gpu::useReadback);
  gpu::BindingSet set(device, layout);
  set.set(shared::kBindProbeArguments, in);
  set.set(shared::kBindProbeAnswers, out);
  set.set(shared::kBindProbeTriangles, triangles);
  gpu::Commands commands(device);
  commands.begin();
  commands.bind(pipeline, set);
  commands.dispatch(static_cast<std::uint32_t>((arguments.size() + shared::kProbeGroup - 1) / shared::kProbeGroup));
  commands.barrier();
  commands.submitAndWait();
  return out.readAll<Answer>();
}

}  // namespace

std::vector<float> askOperation(const gpu::Device& device, Operation operation,
                                const std::vector<glm::vec3>& arguments) {
  return ask<float>(device, "operations.comp", static_cast<std::uint32_t>(operation), arguments, {});
}

std::vector<ProbeAnswer> askFunction(const gpu::Device& device, Function function,
                                     const std::vector<ProbeArguments>& arguments,
                                     const std::vector<glm::vec3>& corners) {
  return ask<ProbeAnswer>(device, "functions.comp", static_cast<std::uint32_t>(function), arguments, corners);
}

}  // namespace crosslight::study
