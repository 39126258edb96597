// The Utah teapot as patches and as a mesh.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "scenegen/bezier.h"

namespace crosslight::scenegen {

// All 32 patches, z up as in the data: rim to bottom, lid, handle, spout.
std::vector<BezierPatch> teapotPatches();

// Each patch edge cut into `steps`; y up, standing on y = 0, spout towards +x. Patches share their edges' vertices or,
// at the seams of the texture coordinates, at least their positions.
Primitive tessellateTeapot(int steps);

}  // namespace crosslight::scenegen
