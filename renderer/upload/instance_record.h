// The way from render space into a mesh's object space, and how much boxes there must be widened. Private to the room.
#pragma once

#include <optional>

#include "accel/bvh.h"
#include "scene/scene.h"
#include "structs.h"

namespace crosslight {

// Of the primitives that have triangles.
DBounds boundsOf(const Mesh& mesh);
// Box of a box that is moved by linear * p + shift.
DBounds moved(const DBounds& box, const glm::dmat3& linear, const glm::dvec3& shift);

// `box` in object space. Only the map and the margin are filled in. Nothing where the transform has no inverse that
// floats can say, or where the margin would be more than 1/256 of the box.
std::optional<shared::InstanceRecord> objectMap(const glm::dmat4& worldFromObject, const glm::dvec3& origin,
                                                const DBounds& box);
// Of triangles that stay in render space.
shared::InstanceRecord renderSpaceMap(const Bounds& box);

// An instance's box for the tree of instances.
Bounds widened(const Bounds& box);

}  // namespace crosslight
