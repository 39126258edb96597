#include "scene/displacement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <unordered_map>

#include "base/error.h"
#include "base/hash.h"
#include "base/log.h"
#include "scene/displacement_parts.h"
#include "scene/load.h"
#include "scene/material_textures.h"
#include "scene/mesh_repair.h"

namespace crosslight {
namespace {

constexpr std::uint32_t kMostPasses = 7;
constexpr std::size_t kMostTriangles = std::size_t{1} << 26;  // 2.5 GB of vertices when none is shared

bool isDisplaced(const Scene& scene, const Primitive& p) {
  return scene.materials[static_cast<std::size_t>(p.material)].displacementTexture.present();
}

// Says of an edge of a mesh whether it is to be split.
class EdgeRule {
 public:
  EdgeRule(const Scene& scene, std::size_t mesh, const DisplacementOptions& options) : options_(options) {
    if (options.edgePixels <= 0.0f) return;
    const auto index = options.camera.empty() ? 0 : static_cast<std::size_t>(findCamera(scene, options.camera));
    const Camera& camera = scene.cameras[index];
    halfHeight_ = camera.orthographic ? camera.yMag : std::tan(0.5 * camera.yFov);
    orthographic_ = camera.orthographic;
    zNear_ = camera.zNear;
    for (const MeshInstance& instance : scene.instances) {
      if (static_cast<std::size_t>(instance.mesh) == mesh)
        cameraFromObject_.push_back(glm::inverse(camera.worldFromCamera) * instance.worldFromObject);
    }
  }

  std::uint32_t passes() const { return options_.edgePixels > 0.0f ? kMostPasses : options_.level; }

  // As many triangles at least as one becomes.
  std::size_t leastFactor() const { return options_.edgePixels > 0.0f ? 1 : std::size_t{1} << (2 * options_.level); }

  bool splits(const glm::vec3& a, const glm::vec3& b) const {
    if (options_.edgePixels <= 0.0f) return true;
    return std::any_of(cameraFromObject_.begin(), cameraFromObject_.end(),
                       [&](const glm::dmat4& m) { return pixels(m, a, b) > static_cast<double>(options_.edgePixels); });
  }

 private:
  // Length on the screen if the edge lay across the view at its nearer end: symmetric in the ends, and no edge that is
  // seen end on becomes too coarse to be displaced.
  double pixels(const glm::dmat4& cameraFromObject, const glm::vec3& a, const glm::vec3& b) const {
    const glm::dvec3 p(cameraFromObject * glm::dvec4(a, 1.0)), q(cameraFromObject * glm::dvec4(b, 1.0));
    const double depth = orthographic_ ? 1.0 : std::max(std::min(-p.z, -q.z), zNear_);
    return glm::length(q - p) / depth * options_.height / (2.0 * halfHeight_);
  }

  const DisplacementOptions& options_;
  std::vector<glm::dmat4> cameraFromObject_;
  double halfHeight_ = 1.0, zNear_ = 0.0;
  bool orthographic_ = false;
};

struct PlaceHash {
  std::size_t operator()(const std::array<std::uint32_t, 6>& key) const {
    return static_cast<std::size_t>(hashBytes(std::as_bytes(std::span(key))));
  }
};
using Place = std::array<std::uint32_t, 6>;

// +0 and -0 are one place.
Place placeOf(const glm::vec3& p, const glm::vec3& n) {
  Place key;
  for (int i = 0; i < 3; ++i) {
    key[static_cast<std::size_t>(i)] = std::bit_cast<std::uint32_t>(p[i] + 0.0f);
    key[static_cast<std::size_t>(i) + 3] = std::bit_cast<std::uint32_t>(n[i] + 0.0f);
  }
  return key;
}

// What vertices at one place have in common.
struct Meeting {
  glm::dvec3 normal{0.0};
  double height = 0.0;
  double count = 0.0;
};

class MeshDisplacer {
 public:
  MeshDisplacer(Scene& scene, std::size_t mesh) : scene_(scene), mesh_(scene.meshes[mesh]) {
    for (Primitive& p : mesh_.primitives) {
      if (isDisplaced(scene_, p)) displaced_.push_back(&p);
    }
  }

  void run(const EdgeRule& rule) {
    if (displaced_.empty()) return;
    checkSize(rule.leastFactor());
    for (std::uint32_t pass = 0; pass < rule.passes(); ++pass) {
      bool any = false;
      for (Primitive* p : displaced_) any = splitEdges(*p, [&](auto& a, auto& b) { return rule.splits(a, b); }) || any;
      checkSize(1);
      if (!any) break;
    }
    const std::vector<std::vector<glm::vec3>> before = move();
    makeNormals(before);
    for (Primitive* p : displaced_) makeOtherAttributes(*p);
  }

 private:
  void checkSize(std::size_t factor) const {
    std::size_t triangles = 0;
    for (const Primitive* p : displaced_) triangles += p->indices.size() / 3 * factor;
    if (triangles <= kMostTriangles) return;
    throw InputError(scene_.source.string(),
                     fmt::format("mesh '{}' is displaced with more than {} triangles; take a smaller "
                                 "--set displacement-level or a larger displacement-edge",
                                 mesh_.name, kMostTriangles));
  }

  double heightAt(const Primitive& p, std::size_t vertex) const {
    const Material& m = scene_.materials[static_cast<std::size_t>(p.material)];
    const TextureUse& use = m.displacementTexture;
    const std::vector<glm::vec2>& uv = use.texCoord == 1 ? p.uv1 : p.uv0;
    const glm::dvec2 at = uv.empty() ? glm::dvec2(0.0) : glm::dvec2(uv[vertex]);
    const double texel = sampleRed(scene_.images[static_cast<std::size_t>(use.image)], use, at);
    return static_cast<double>(m.displacementScale) * texel + static_cast<double>(m.displacementBias);
  }

  // Positions as they were.
  std::vector<std::vector<glm::vec3>> move() {
    std::unordered_map<Place, Meeting, PlaceHash> meetings;
    for (const Primitive* p : displaced_) {
      for (std::size_t i = 0; i < p->positions.size(); ++i) {
        Meeting& meeting = meetings[placeOf(p->positions[i], glm::vec3(0.0f))];
        meeting.normal += glm::dvec3(p->normals[i]);
        meeting.height += heightAt(*p, i);
        meeting.count += 1.0;
      }
    }
    std::vector<std::vector<glm::vec3>> before;
    for (Primitive* p : displaced_) {
      before.push_back(p->positions);
      for (glm::vec3& position : p->positions) {
        const Meeting& meeting = meetings.at(placeOf(position, glm::vec3(0.0f)));
        const double length = glm::length(meeting.normal);
        if (length > 0.0)
          position = glm::vec3(glm::dvec3(position) + meeting.normal * (meeting.height / meeting.count / length));
      }
    }
    return before;
  }

  // Triangles' normals, weighted by the corner's angle, over vertices that had place and normal in common.
  void makeNormals(const std::vector<std::vector<glm::vec3>>& before) {
    std::unordered_map<Place, glm::dvec3, PlaceHash> sums;
    const auto keyOf = [&](std::size_t which, std::uint32_t vertex) {
      return placeOf(before[which][vertex], displaced_[which]->normals[vertex]);
    };
    for (std::size_t which = 0; which < displaced_.size(); ++which) {
      const Primitive& p = *displaced_[which];
      for (std::size_t t = 0; t * 3 < p.indices.size(); ++t) {
        const glm::dvec3 cross = triangleCross(p, t);
        const double length = glm::length(cross);
        if (!(length > 0.0)) continue;
        for (std::size_t corner = 0; corner < 3; ++corner)
          sums[keyOf(which, p.indices[t * 3 + corner])] += cross / length * cornerAngle(p, t, corner);
      }
    }
    for (std::size_t which = 0; which < displaced_.size(); ++which) {
      Primitive& p = *displaced_[which];
      for (std::uint32_t i = 0; i < p.normals.size(); ++i) {
        const auto found = sums.find(keyOf(which, i));
        const double length = found == sums.end() ? 0.0 : glm::length(found->second);
        if (length > 0.0) p.normals[i] = glm::vec3(found->second / length);
      }
    }
  }

  void makeOtherAttributes(Primitive& p) const {
    const TextureUse* along = tangentTexture(scene_.materials[static_cast<std::size_t>(p.material)]);
    if (!p.tangents.empty()) repairTangents(p);
    if (p.tangents.empty() && along != nullptr) {
      const std::vector<glm::vec2> uv = along->texCoord == 1 ? p.uv1 : p.uv0;
      if (!uv.empty()) makeTangents(p, uv);
    }
    p.flatNormals = false;
  }

  Scene& scene_;
  Mesh& mesh_;
  std::vector<Primitive*> displaced_;
};

// Rays would see an undisplaced body where raster sees its mesh.
void replaceShapes(Scene& scene) {
  std::vector<ShapeInstance> kept;
  for (const ShapeInstance& shape : scene.shapes) {
    const bool displaced = scene.materials[static_cast<std::size_t>(shape.material)].displacementTexture.present();
    const auto mesh = std::find_if(scene.instances.begin(), scene.instances.end(), [&](const MeshInstance& m) {
      return m.replacedByShape && m.instanceId == shape.instanceId;
    });
    if (!displaced || mesh == scene.instances.end()) {
      if (displaced) logWarning("node '" + shape.name + "': an analytic shape without a mesh is not displaced");
      kept.push_back(shape);
      continue;
    }
    mesh->replacedByShape = false;
  }
  scene.shapes = std::move(kept);
}

}  // namespace

bool displaceMeshes(Scene& scene, const DisplacementOptions& options) {
  const bool any = std::any_of(scene.materials.begin(), scene.materials.end(),
                               [](const Material& m) { return m.displacementTexture.present(); });
  if (!any) return false;
  replaceShapes(scene);
  for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
    MeshDisplacer(scene, mesh).run(EdgeRule(scene, mesh, options));
  return true;
}

}  // namespace crosslight
