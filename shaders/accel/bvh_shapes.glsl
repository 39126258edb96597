// Rays against the analytic shapes of the scene: through their tree, and those without bounds one by one. Part of
// bvh.glsl, which has the walk.
#ifndef CROSSLIGHT_BVH_SHAPES_GLSL
#define CROSSLIGHT_BVH_SHAPES_GLSL
#include "accel/shape.glsl"

bool isShapeHit(HitRecord hit) {
  return CL_HAS(shapes) && (!CL_HAS(triangles) || (hit.primitive & kHitShape) != 0u);
}

// A shape's own coordinates and the scene's; where no shape is turned or scaled they differ by its center alone. The
// zero makes -0 into 0, as the product with a matrix does.
vec3 objectVector(ShapeRecord s, vec3 v) { return CL_HAS(turnedShapes) ? s.objectFromRender * v : v + 0.0; }
vec3 renderVector(ShapeRecord s, vec3 v) { return CL_HAS(turnedShapes) ? s.renderFromObject * v : v + 0.0; }
// Normals go by the transpose of the inverse; cofactors are that up to a positive factor and the determinant's sign.
vec3 renderNormal(ShapeRecord s, vec3 n) { return CL_HAS(turnedShapes) ? n * s.objectFromRender : n + 0.0; }

ShapeHit hitShapeInstance(ShapeRecord s, Ray ray) {
  return hitShape(s.kind, s.params, objectVector(s, ray.origin - s.renderCenter), objectVector(s, ray.direction),
                  ray.tMin, ray.tMax);
}

// Shapes without bounds stand outside of the tree, first in the list. Planes are the only ones (the host checks), so the
// other kinds' code is not inlined once more here.
ShapeHit hitUnboundedShape(ShapeRecord s, Ray ray) {
  return hitPlane(s.params, objectVector(s, ray.origin - s.renderCenter), objectVector(s, ray.direction), ray.tMin,
                  ray.tMax);
}

uint shapeInSlot(uint slot) { return texelFetch(bvhPrimitives, int(3u * slot)).w & ~kPrimitiveIsShape; }

void considerShapeHit(ShapeRecord s, ShapeHit h, uint shape, Ray ray, bool cutBackFaces, inout Closest best) {
  uint id = kPrimitiveIsShape | shape;
  bool cuts = cutBackFaces && frame.twoSided == 0u && (s.flags & kPrimitiveCutsBackFaces) != 0u;
  bool cut = cuts && dot(h.n, objectVector(s, ray.direction)) > 0.0;
  bool closer = h.hit && !cut && isCloser(h.t, id, boundOf(best, ray), best.id);
  if (closer) best = Closest(HitRecord(h.t, kHitShape | shape, 0.0, 0.0), id);
}

Ray endingAt(Ray ray, float tMax) { return Ray(ray.origin, ray.direction, ray.tMin, tMax, ray.from); }

void considerShape(uint shape, Ray ray, bool cutBackFaces, inout Closest best) {
  ShapeRecord s = shapeOf(shape);
  considerShapeHit(s, hitShapeInstance(s, endingAt(ray, boundOf(best, ray))), shape, ray, cutBackFaces, best);
}

void considerUnboundedShapes(Ray ray, bool cutBackFaces, inout Closest best) {
  for (uint i = 0u; i < frame.unboundedShapeCount; ++i) {
    ShapeRecord s = shapeOf(i);
    considerShapeHit(s, hitUnboundedShape(s, endingAt(ray, boundOf(best, ray))), i, ray, cutBackFaces, best);
  }
}

// Nearest shape, or the triangle met so far where no shape is nearer; of a triangle and a shape that are equally near,
// the triangle counts (ids of shapes are greater).
HitRecord closestShape(Ray ray, bool cutBackFaces, HitRecord sofar) {
  Closest best = Closest(sofar, sofar.primitive == kNoHit ? kNoId : 0u);
  if (!isValid(ray)) return sofar;
  considerUnboundedShapes(ray, cutBackFaces, best);
  WalkRay w = walkRayOf(ray);
  Walk walk = Walk(frame.shapeRoot, 0, 0u);
  do {
    walkToLeaf(w, boundOf(best, ray), walk);
    uint count = leafCount(walk);
    uint slot = walk.next & kBvhFirstMask;
    uint end = slot + count;
    do {
      if (slot < end) considerShape(shapeInSlot(slot), ray, cutBackFaces, best);
      ++slot;
    } while (slot < end);
    leaveLeaf(count, walk);
  } while (goesOn(walk));
  countCapped(walk);
  return best.hit;
}

bool mayPass(ShapeRecord s) {
  return (CL_HAS(alphaMask) || CL_HAS(transparency)) && (s.flags & kPrimitiveMayPass) != 0u;
}

// A torus is crossed four times.
const int kMostCrossings = 4;

float passedAtHit(ShapeRecord s, ShapeHit h, Ray ray) {
  if (countsCrossings()) noteCrossing(s.drawId, dot(renderNormal(s, h.n), ray.direction) > 0.0, ray, h.t);
  return passedByShape(s.drawId, h.uv);
}

float lightPassedShape(uint shape, Ray ray) {
  ShapeRecord s = shapeOf(shape);
  ShapeHit h = hitShapeInstance(s, ray);
  float passed = 0.0;
  if (mayPass(s) && h.hit) passed = passedAtHit(s, h, ray);
  passed = h.hit ? passed : 1.0;
  if (countsCrossings()) {
    for (int k = 1; k < kMostCrossings && h.hit && passed > 0.0; ++k) {
      ray.tMin = h.t;  // the same root again is not greater than itself
      h = hitShapeInstance(s, ray);
      if (h.hit) passed *= passedAtHit(s, h, ray);
    }
  }
  return passed;
}

float lightPassedUnbounded(Ray ray) {
  float passed = 1.0;
  for (uint i = 0u; i < frame.unboundedShapeCount; ++i) {
    ShapeRecord shape = shapeOf(i);
    ShapeHit h = hitUnboundedShape(shape, ray);
    float through = 0.0;
    if (mayPass(shape) && h.hit) through = passedAtHit(shape, h, ray);
    if (h.hit) passed *= through;
  }
  return passed;
}

// `passed`: what triangles leave.
float lightPassedShapesByTree(Ray ray, float passed) {
  passed *= lightPassedUnbounded(ray);
  WalkRay w = walkRayOf(ray);
  Walk walk = Walk(passed == 0.0 ? kWalkDone : frame.shapeRoot, 0, 0u);
  do {
    walkToLeaf(w, ray.tMax, walk);
    uint count = leafCount(walk);
    uint slot = walk.next & kBvhFirstMask;
    uint end = slot + count;
    do {
      if (slot < end) passed *= lightPassedShape(shapeInSlot(slot), ray);
      ++slot;
    } while (slot < end);
    leaveLeaf(count, walk);
    if (passed == 0.0) walk.next = kWalkDone;
  } while (goesOn(walk));
  countCapped(walk);
  return passed;
}
#endif
