// Which of few analytic shapes may a ray meet? All their boxes are tried, then the shapes in question, in the order of the
// list: no stack and few branches, cheaper than a tree where there are few. Subgroups of 8 lanes load four boxes at once and
// pass them on by shuffles: control flow must be uniform where shapesAhead is called.
#ifndef CROSSLIGHT_FEW_SHAPES_GLSL
#define CROSSLIGHT_FEW_SHAPES_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "accel/bvh.glsl"
#include "accel/lanes.glsl"

layout(set = 0, binding = kBindShapeBoxes) uniform usamplerBuffer shapeBoxTexels;

const bool kFewShapes = (specVariant & kVariantFewShapes) != 0u;

const bool kSharesLoads = (specVariant & kVariantSharedLoads) != 0u;

vec3 boxCorner(uvec4 own, uint first, uint corner) {
  if (!kSharesLoads) return uintBitsToFloat(texelFetch(shapeBoxTexels, int(2u * first + corner)).xyz);
  return vectorFromLane(own, corner);
}

// Bit i: the box of bounded shape i.
uint shapesAhead(Ray ray) {
  WalkRay w = walkRayOf(ray);
  uint ahead = 0u;
  for (uint first = 0u; first < frame.boundedShapeCount; first += 4u) {
    uvec4 own = uvec4(0u);
    if (kSharesLoads) own = texelFetch(shapeBoxTexels, int(2u * first + (gl_SubgroupInvocationID & 7u)));
    [[unroll]] for (uint i = 0u; i < 4u; ++i) {
      vec3 lower = boxCorner(own, first, 2u * i), upper = boxCorner(own, first, 2u * i + 1u);
      ahead |= hitSlabs(lower, upper, w.ray, w.inverse, w.negative).hit ? 1u << (first + i) : 0u;
    }
  }
  return isValid(ray) ? ahead : 0u;
}

uint firstOf(uint ahead) { return frame.unboundedShapeCount + uint(max(findLSB(ahead), 0)); }

// As closestShape: the bits are shapes that the ray may meet.
HitRecord closestOfShapes(Ray ray, bool cutBackFaces, HitRecord sofar, uint ahead) {
  Closest best = Closest(sofar, sofar.primitive == kNoHit ? kNoId : 0u);
  if (isValid(ray)) considerUnboundedShapes(ray, cutBackFaces, best);
  do {
    if (ahead != 0u) considerShape(firstOf(ahead), ray, cutBackFaces, best);
    ahead &= ahead - min(ahead, 1u);
  } while (ahead != 0u);
  return best.hit;
}

// As lightPassedShapesByTree.
float lightPassedShapes(Ray ray, float passed, uint ahead) {
  passed *= lightPassedUnbounded(ray);
  ahead = passed == 0.0 ? 0u : ahead;
  do {
    if (ahead != 0u) passed *= lightPassedShape(firstOf(ahead), ray);
    ahead = passed == 0.0 ? 0u : ahead & (ahead - min(ahead, 1u));
  } while (ahead != 0u);
  return passed;
}
#endif
