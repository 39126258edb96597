// What trace/ray_tree.comp writes for the host to read: slots beyond bindings.h, and records of a few pixels' trees.
#ifndef CROSSLIGHT_SHARED_RAY_TREE_RECORDS_H
#define CROSSLIGHT_SHARED_RAY_TREE_RECORDS_H
#include "types.h"

CL_SHARED_BEGIN
CL_CONST uint kBindRayTree = 70;  // RayTreeRecord[], one per node
CL_CONST uint kBindRayTreeLights =
    71;  // RayTreeLightRecord[lights of the scene * nodes], the nodes of a light together

// A ray and what it met. Render space, scene units, linear colors.
struct RayTreeRecord {
  vec3 origin;
  float t;  // in units of `direction`; negative: nothing was hit, and what follows of the hit means nothing
  vec3 direction;
  uint kind;  // kRay*
  vec3 position;
  uint depth;   // rays before it
  vec3 normal;  // shading normal, unit
  uint medium;  // material that the ray travels in, or kNoRayNode
  vec3 own;     // what the surface sends back by itself, or the background
  float alpha;
  vec3 weight;  // share of what comes back along the ray in its parent's; of camera rays undefined
  uint materialId;
  uint reflected;  // nodes, or kNoRayNode
  uint transmitted;
  uint instanceId;
  uint primitiveId;
  uint transmittedCount;  // nodes from `transmitted` on
};
CL_SIZE(RayTreeRecord, 116)

// What one light brings to a hit, and how much of it arrives.
struct RayTreeLightRecord {
  vec3 value;     // its ambient, diffuse and specular parts as `own` contains them, before opacity
  float visible;  // negative: the hit lies within a refracting body, where no light is looked for
};
CL_SIZE(RayTreeLightRecord, 16)
CL_SHARED_END
#endif
