// The archived KHR_materials_pbrSpecularGlossiness, turned into the metallic-roughness parameters that come closest.
#include <algorithm>
#include <cmath>

#include "scene/gltf_build.h"

namespace crosslight::gltf {
namespace {

constexpr Range kUnit{0.0, 1.0, false};
constexpr double kDielectricF0 = 0.04;  // glTF 2.0, B.3.1: index of refraction 1.5

// Both models have a diffuse color D and a reflectance at normal incidence S. Metallic-roughness makes them from a
// base color c and metalness m = 1 - k as D = c k and S = F0 k + c (1 - k). Without c: F0 k^2 - (S + D) k + D = 0,
// whose smaller root is the one in [0, 1] for S >= F0. The root is written so that small F0 does not cancel.
double dielectricShare(double diffuse, double specular) {
  if (specular <= kDielectricF0) return 1.0;
  const double sum = specular + diffuse;
  const double root = std::sqrt(std::max(sum * sum - 4.0 * kDielectricF0 * diffuse, 0.0));
  return std::clamp(2.0 * diffuse / (sum + root), 0.0, 1.0);
}

// The base color follows from D where the material is dielectric and from S where it is metal.
float baseColor(double diffuse, double specular, double k) {
  const double m = 1.0 - k;
  const double fromDiffuse = k > 0.0 ? diffuse / k : 0.0;
  const double fromSpecular = m > 0.0 ? (specular - kDielectricF0 * k) / m : 0.0;
  const double weight = k > 0.0 ? m * m : 1.0;
  return static_cast<float>(std::clamp(fromDiffuse * (1.0 - weight) + fromSpecular * weight, 0.0, 1.0));
}

}  // namespace

void readSpecularGlossiness(const JsonAt& extension, Material& material) {
  std::vector<double> diffuse{1.0, 1.0, 1.0, 1.0};
  if (const auto factor = extension.find("diffuseFactor")) diffuse = factor->numbers(4, kUnit);
  const glm::dvec3 specular(vec3Or(extension, "specularFactor", glm::vec3(1.0f), kUnit));
  const double strongest = std::max({specular.x, specular.y, specular.z});
  // The extension's diffuse color is scaled by what the strongest specular channel leaves.
  glm::dvec3 remaining(0.0);
  for (int i = 0; i < 3; ++i) remaining[i] = diffuse[static_cast<std::size_t>(i)] * (1.0 - strongest);
  const double k = dielectricShare(std::max({remaining.x, remaining.y, remaining.z}), strongest);
  for (int i = 0; i < 3; ++i) material.baseColorFactor[i] = baseColor(remaining[i], specular[i], k);
  material.baseColorFactor[3] = static_cast<float>(diffuse[3]);
  material.metallicFactor = static_cast<float>(1.0 - k);
  material.perceptualRoughnessFactor = static_cast<float>(1.0 - numberOr(extension, "glossinessFactor", 1.0, kUnit));
  extension.warn("is archived by Khronos; its factors are converted to metallic-roughness");
}

}  // namespace crosslight::gltf
