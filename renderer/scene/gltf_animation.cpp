// The state of every node at one time: as stored, then animations on top. Where several channels drive one property
// the first one in the file wins, so that the order of animations decides and not chance.
#include <tiny_gltf.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "scene/gltf_build.h"

namespace crosslight::gltf {
namespace {

glm::dvec3 vec3Of(const std::vector<double>& values, const glm::dvec3& fallback) {
  return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : fallback;
}

// glTF stores x, y, z, w. Never zero: the validation refuses that.
glm::dquat quaternionOf(const std::vector<double>& v) {
  if (v.size() != 4) return {1.0, 0.0, 0.0, 0.0};
  return glm::normalize(glm::dquat(v[3], v[0], v[1], v[2]));
}

enum class Interpolation { step, linear, cubic };

struct Track {
  std::vector<float> times;
  std::vector<float> values;
  std::size_t width = 0;  // numbers per key
  Interpolation interpolation = Interpolation::linear;

  // One key's value, or its in-tangent (part 0), value (1) or out-tangent (2) with cubic interpolation.
  const float* key(std::size_t index, std::size_t part = 1) const {
    return interpolation == Interpolation::cubic ? &values[(index * 3 + part) * width] : &values[index * width];
  }
};

struct Segment {
  std::size_t from = 0;
  std::size_t to = 0;
  double fraction = 0.0;  // 0..1 between them
  double seconds = 0.0;   // length
};

Segment segmentAt(const std::vector<float>& times, double seconds) {
  if (seconds <= double{times.front()}) return {0, 0, 0.0, 0.0};
  if (seconds >= double{times.back()}) return {times.size() - 1, times.size() - 1, 0.0, 0.0};
  const auto next =
      std::upper_bound(times.begin(), times.end(), seconds, [](double t, float key) { return t < double{key}; });
  const auto to = static_cast<std::size_t>(next - times.begin());
  const double start = times[to - 1];
  const double length = double{times[to]} - start;
  return {to - 1, to, (seconds - start) / length, length};
}

glm::dquat asQuaternion(const double* v) { return {v[3], v[0], v[1], v[2]}; }

// glTF 2.0, C.4: along the shorter arc; close to parallel the linear form is the limit and does not divide by ~0.
glm::dquat slerp(const glm::dquat& a, glm::dquat b, double t) {
  double cosine = glm::dot(a, b);
  if (cosine < 0.0) {
    b = -b;
    cosine = -cosine;
  }
  const double angle = std::acos(std::min(cosine, 1.0));
  // sin(x)/x differs from 1 by less than half an ulp of double below sqrt(6 * 2^-53) = 2.6e-8.
  constexpr double kParallel = 2.6e-8;
  if (angle < kParallel) return glm::normalize(a * (1.0 - t) + b * t);
  return (a * std::sin((1.0 - t) * angle) + b * std::sin(t * angle)) / std::sin(angle);
}

// glTF 2.0, C.5.
double hermite(double p0, double m0, double p1, double m1, double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * p0 + (t3 - 2.0 * t2 + t) * m0 + (-2.0 * t3 + 3.0 * t2) * p1 + (t3 - t2) * m1;
}

std::vector<double> sample(const Track& track, double seconds, bool isRotation) {
  const Segment segment = segmentAt(track.times, seconds);
  std::vector<double> result(track.key(segment.from), track.key(segment.from) + track.width);
  if (segment.from == segment.to || track.interpolation == Interpolation::step) return result;
  const std::vector<double> end(track.key(segment.to), track.key(segment.to) + track.width);
  if (track.interpolation == Interpolation::linear && isRotation) {
    const glm::dquat q =
        slerp(glm::normalize(asQuaternion(result.data())), glm::normalize(asQuaternion(end.data())), segment.fraction);
    return {q.x, q.y, q.z, q.w};
  }
  for (std::size_t i = 0; i < track.width; ++i) {
    if (track.interpolation == Interpolation::linear) {
      result[i] += (end[i] - result[i]) * segment.fraction;
    } else {
      const double out = double{track.key(segment.from, 2)[i]} * segment.seconds;
      const double in = double{track.key(segment.to, 0)[i]} * segment.seconds;
      result[i] = hermite(result[i], out, end[i], in, segment.fraction);
    }
  }
  return result;
}

Track readTrack(const Source& source, const tinygltf::AnimationSampler& sampler, const JsonAt& at) {
  Track track;
  track.times = readFinite(source, static_cast<std::size_t>(sampler.input), 1);
  for (std::size_t i = 1; i < track.times.size(); ++i) {
    if (!(track.times[i] > track.times[i - 1])) at.at("input").fail(fmt::format("times must rise; key {} does not", i));
  }
  const auto output = static_cast<std::size_t>(sampler.output);
  track.values =
      readFinite(source, output, componentCount(source.document.entry("accessors", output).at("type").string()));
  if (sampler.interpolation == "STEP") track.interpolation = Interpolation::step;
  if (sampler.interpolation == "CUBICSPLINE") track.interpolation = Interpolation::cubic;
  track.width = track.values.size() / track.times.size() / (track.interpolation == Interpolation::cubic ? 3 : 1);
  return track;
}

void apply(const std::vector<double>& value, const std::string& path, NodePose& pose, const JsonAt& at) {
  if (path == "weights") {
    pose.weights = value;
  } else if (path == "rotation") {
    const glm::dquat rotation = asQuaternion(value.data());
    if (!(glm::length(rotation) > 0.0)) at.fail("drives a rotation to a quaternion of length 0");
    pose.rotation = glm::normalize(rotation);
  } else {
    (path == "translation" ? pose.translation : pose.scale) = {value[0], value[1], value[2]};
  }
}

}  // namespace

glm::dmat4 NodePose::parentFromNode() const {
  if (isMatrix) return matrix;
  glm::dmat4 result = glm::mat4_cast(rotation);
  for (int axis = 0; axis < 3; ++axis) result[axis] *= scale[axis];
  result[3] = glm::dvec4(translation, 1.0);
  return result;
}

std::vector<NodePose> restPose(const Source& source) {
  std::vector<NodePose> poses;
  for (const tinygltf::Node& node : source.model.nodes) {
    NodePose pose;
    if (node.matrix.size() == 16) {
      pose.isMatrix = true;
      for (int i = 0; i < 16; ++i) pose.matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    }
    pose.translation = vec3Of(node.translation, glm::dvec3(0.0));
    pose.rotation = quaternionOf(node.rotation);
    pose.scale = vec3Of(node.scale, glm::dvec3(1.0));
    if (node.mesh >= 0) {
      const auto mesh = static_cast<std::size_t>(node.mesh);
      // Three copies: this one, the key of the shared mesh, and the one on its way.
      source.document.budget.charge(targetCount(source, mesh) * sizeof(double) * 3, source.document.root());
      pose.weights = !node.weights.empty() ? node.weights : source.model.meshes[mesh].weights;
      pose.weights.resize(targetCount(source, mesh), 0.0);
    }
    poses.push_back(std::move(pose));
  }
  return poses;
}

void animate(const Source& source, int only, double timeSeconds, std::vector<NodePose>& poses) {
  std::set<std::pair<int, std::string>> driven;
  for (std::size_t a = 0; a < source.model.animations.size(); ++a) {
    if (only >= 0 && a != static_cast<std::size_t>(only)) continue;
    const tinygltf::Animation& animation = source.model.animations[a];
    const JsonAt at = source.document.entry("animations", a);
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
      const tinygltf::AnimationChannel& channel = animation.channels[c];
      const std::string& path = channel.target_path;
      const bool known = path == "translation" || path == "rotation" || path == "scale" || path == "weights";
      if (!known || channel.target_node < 0) continue;
      NodePose& pose = poses[static_cast<std::size_t>(channel.target_node)];
      if (path == "weights" && pose.weights.empty()) continue;
      if (pose.isMatrix && path != "weights") {
        at.warn(fmt::format("drives node {}, which has a matrix; the channel is left out", channel.target_node));
        continue;
      }
      if (!driven.emplace(channel.target_node, path).second) continue;
      const auto sampler = static_cast<std::size_t>(channel.sampler);
      const JsonAt samplerAt = at.at("samplers").item(sampler);
      const Track track = readTrack(source, animation.samplers[sampler], samplerAt);
      apply(sample(track, timeSeconds, path == "rotation"), path, pose, samplerAt);
    }
  }
}

}  // namespace crosslight::gltf
