// The same search by the device: it says whose boxes a ray meets, nearest first where it likes, and the test and the
// choice of the nearest are those of bvh.glsl, so that hits are too. A box's number is its triangle's slot. Boxes are
// widened by the host for the device's rounding (upload/query_boxes.cpp). Of kernels that are made with CL_RAY_QUERY.
#ifndef CROSSLIGHT_RAY_QUERY_GLSL
#define CROSSLIGHT_RAY_QUERY_GLSL
#extension GL_EXT_ray_query : require

layout(set = 0, binding = kBindTriangleBoxes) uniform accelerationStructureEXT triangleBoxes;

// Vulkan leaves rays undefined that are not finite or end before they begin.
bool canBeQueried(Ray ray) { return isValid(ray) && ray.tMin >= 0.0 && ray.tMax >= ray.tMin; }

HitRecord closestByQuery(Ray ray, bool cutBackFaces) {
  Closest best = Closest(kMiss, kNoId);
  if (!canBeQueried(ray)) return kMiss;
  RayShear shear = shearOf(ray.direction);
  float searched = ray.tMax;
  rayQueryEXT query;
  rayQueryInitializeEXT(query, triangleBoxes, gl_RayFlagsNoneEXT, 0xffu, ray.origin, ray.tMin, ray.direction, ray.tMax);
  while (rayQueryProceedEXT(query)) {
    considerTriangle(uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)), ray, shear, cutBackFaces, best);
    float bound = searchedTo(boundOf(best, ray));
    if (bound < searched) rayQueryGenerateIntersectionEXT(query, bound);  // nothing beyond is asked for
    searched = smaller(searched, bound);
  }
  return best.hit;
}

// Surfaces are asked in the device's order: of several transparent ones the last bits of the product depend on it.
float lightPassedByQuery(Ray ray) {
  float passed = 1.0;
  if (!canBeQueried(ray)) return passed;
  RayShear shear = shearOf(ray.direction);
  rayQueryEXT query;
  rayQueryInitializeEXT(query, triangleBoxes, gl_RayFlagsNoneEXT, 0xffu, ray.origin, ray.tMin, ray.direction, ray.tMax);
  while (passed > 0.0 && rayQueryProceedEXT(query)) {
    uint slot = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
    passed *= lightPassedFetched(fetchPrimitive(slot), slot, ray, shear);
  }
  return passed;
}
#endif
