// The benchmarks' scenes in the words of other renderers: same triangles or spheres, same camera, lights and paint, as
// far as the other one's model of light has them. README.md says where it does not.
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace crosslight::bench {

// Five mirrors and five spheres of glass over an unbounded plane, all analytic; one point light. As glTF, and for
// POV-Ray: mirrorings and refractions to the same depth, five segments after the camera's.
std::filesystem::path writeSpheresScene(const std::filesystem::path& folder);
std::filesystem::path writePovSpheres(const Scene& spheres, const std::filesystem::path& folder);

// A scene of meshes with one classic material and one point light (knot_scene.h).
std::filesystem::path writePovMesh(const Scene& scene, const std::filesystem::path& folder);
std::filesystem::path writeTachyonMesh(const Scene& scene, std::uint32_t size, const std::filesystem::path& folder);

// mesh.json, and mesh.bin beside it, for blender_mesh.py.
std::filesystem::path writeBlenderMesh(const Scene& scene, const std::filesystem::path& folder);

// The glTF file without its lights and cameras, in a folder of its own: F3D's lighting knows candela but no distance,
// and its options place the camera.
std::filesystem::path writeWithoutLights(const std::filesystem::path& gltf, const std::filesystem::path& folder);

}  // namespace crosslight::bench
