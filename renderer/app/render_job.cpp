#include "app/render_job.h"

#include <fmt/format.h>

#include <array>

#include "app/render_session.h"
#include "base/error.h"

namespace crosslight {
namespace {

struct MethodName {
  Method method;
  const char* name;
};
constexpr std::array kMethods{MethodName{Method::wireframe, "wireframe"}, MethodName{Method::flat, "flat"},
                              MethodName{Method::gouraud, "gouraud"}, MethodName{Method::phong, "phong"},
                              MethodName{Method::whitted, "whitted"}};

}  // namespace

RenderResult render(gpu::Device& device, const Scene& scene, const RenderSettings& settings,
                    const ProgressFunction& progress) {
  RenderSession session(device);
  // The caller's: nothing of the session outlives it.
  const std::shared_ptr<const Scene> borrowed(std::shared_ptr<const Scene>(), &scene);
  return session.render({borrowed, settings}, progress);
}

const char* nameOf(Method method) {
  for (const MethodName& m : kMethods) {
    if (m.method == method) return m.name;
  }
  return "unknown";
}

Method methodOf(const std::string& name) {
  std::string all;
  for (const MethodName& m : kMethods) {
    if (name == m.name) return m.method;
    all += (all.empty() ? "" : ", ") + std::string(m.name);
  }
  throw UsageError(fmt::format("no method '{}'; there are: {}", name, all));
}

bool isTraced(Method method) { return method == Method::whitted; }

std::vector<Method> allMethods() {
  std::vector<Method> methods;
  for (const MethodName& m : kMethods) methods.push_back(m.method);
  return methods;
}

}  // namespace crosslight
