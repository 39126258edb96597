// Analytic shapes as meshes with analytic normals: what raster draws where a node has a shape but no mesh, and what
// tools/scenegen writes as a fallback.
#pragma once

#include "scene/scene.h"

namespace crosslight {

// `segments` around the axis (>= 3); rings follow from it so that faces are about square. Closed, outward normals,
// counter-clockwise front faces. A plane becomes a square of side 2 * planeHalfSize.
Primitive tessellateShape(ShapeKind kind, const glm::vec4& params, int segments, double planeHalfSize = 100.0);

// Bounds in object space; nothing for the plane, which has none.
std::optional<DBounds> shapeBounds(ShapeKind kind, const glm::vec4& params);

const char* nameOf(ShapeKind kind);
const char* nameOf(LightType type);
const char* nameOf(IlluminationModel model);
const char* nameOf(ShadingMethod method);

}  // namespace crosslight
