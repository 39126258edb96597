#include "effects/approximations.h"

#include <fmt/format.h>

#include <algorithm>

#include "effects/material_traits.h"
#include "scene/material_textures.h"

namespace crosslight {
namespace {

// Directions on the surface that only a mesh has.
bool followsTangents(const Material& m) {
  return m.normalTexture.present() || m.bumpTexture.present() || m.layers.clearcoatNormalTexture.present() ||
         (m.model == IlluminationModel::cookTorrance && m.layers.anisotropy > 0);
}

bool hasMips(const Material& m) {
  const auto uses = texturesOf(m);
  return std::any_of(uses.begin(), uses.end(), [](const TextureUse* u) { return u->present() && u->mip != Mip::none; });
}

// Textures that change more than the colors that light is multiplied by.
bool variesLobes(const Material& m) {
  const MaterialLayers& l = m.layers;
  const auto any = {&l.diffuseRoughnessTexture,    &l.specularTexture,
                    &l.specularColorTexture,       &l.clearcoatTexture,
                    &l.clearcoatRoughnessTexture,  &l.sheenColorTexture,
                    &l.sheenRoughnessTexture,      &l.anisotropyTexture,
                    &l.iridescenceTexture,         &l.filmThicknessTexture,
                    &l.diffuseTransmissionTexture, &l.diffuseTransmissionColorTexture};
  return std::any_of(any.begin(), any.end(), [](const TextureUse* u) { return u->present(); });
}

template <class Test>
const Material* first(const Scene& scene, const Test& test) {
  const auto found = std::find_if(scene.materials.begin(), scene.materials.end(), test);
  return found == scene.materials.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> approximationsOf(const Scene& scene, const RenderSettings& s) {
  std::vector<std::string> all;
  if (s.method == Method::flat || s.method == Method::gouraud) {
    if (const Material* m = first(scene, [](const Material& x) { return followsTangents(x) || variesLobes(x); })) {
      all.push_back(fmt::format(
          "material '{}': {} lights vertices; normal and bump maps and the textures of material layers do not count",
          m->name, s.method == Method::flat ? "flat" : "gouraud"));
    }
  }
  if (scene.atmosphere.environment.present() && s.method != Method::wireframe) {
    const auto brushed = [](const Material& x) {
      return x.model == IlluminationModel::cookTorrance && x.layers.anisotropy > 0;
    };
    if (const Material* m = first(scene, brushed)) {
      all.push_back(fmt::format(
          "material '{}': the environment is mirrored as by an isotropic surface of the mean roughness", m->name));
    }
  }
  if (const Material* m = first(scene, scatters)) {
    all.push_back(
        s.method == Method::whitted
            ? fmt::format("material '{}': light within the body is scattered once on its way, not many times{}",
                          m->name, s.shadows ? "" : "; without shadows it arrives there unweakened")
            : fmt::format("material '{}': raster methods show none of the light that a body scatters within; "
                          "whitted does",
                          m->name));
  }
  if (s.method != Method::whitted) return all;
  for (const ShapeInstance& shape : scene.shapes) {
    const Material& m = scene.materials[static_cast<std::size_t>(shape.material)];
    if (!followsTangents(m) && !hasMips(m)) continue;
    all.push_back(
        fmt::format("node '{}': an analytic shape has no tangents and no texture levels; its material '{}' asks for "
                    "them, and a mesh would show them",
                    shape.name, m.name));
    break;
  }
  return all;
}

}  // namespace crosslight
