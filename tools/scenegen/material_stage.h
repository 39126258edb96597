// What the scenes of models, layers and surfaces stand on: a floor, a camera, lights, two balls.
#pragma once

#include <string>

#include "scenegen/gltf_builder.h"

namespace crosslight::scenegen {

inline constexpr int kLinear = 9729, kRepeat = 10497;  // glTF's filter and wrap mode
inline constexpr int kBallSegments = 32;

// Gray and without lights; eye level with balls that stand on it.
void addFloorAndCamera(GltfBuilder& gltf, Json floor);
// With classic lights for classic models, as in the feature scenes of the others; with lamps in candela.
void addClassicStage(GltfBuilder& gltf);
void addPbrStage(GltfBuilder& gltf);
void addKhrPoint(GltfBuilder& gltf, const std::string& name, const glm::dvec3& position, const glm::dvec3& color,
                 double candela);

// Two balls side by side, as shapes and as meshes; as meshes alone, with tangents by increasing u: what is mapped along
// tangents needs them.
void addBalls(GltfBuilder& gltf, Json left, Json right);
void addBallMeshes(GltfBuilder& gltf, Json left, Json right);

Json withExtension(Json material, const char* name, Json extension);
inline Json textureInfo(int index) { return {{"index", index}}; }
// Four channels that differ, smooth and periodic: whichever of them a property reads, it varies.
int wavesTexture(GltfBuilder& gltf);

}  // namespace crosslight::scenegen
