// Walk of trees that instances share, one ray per lane: the tree of instances in render space, and within an instance
// the tree of its mesh in object space. Only boxes are met there. A triangle's corners are those of the flattened scene,
// its test is that of bvh.glsl and its slot its flattened index: hits are those of one tree over all triangles.
#ifndef CROSSLIGHT_INSTANCES_GLSL
#define CROSSLIGHT_INSTANCES_GLSL

const bool kInstances = (specVariant & kVariantInstances) != 0u;

// By how much boxes must be widened so that a ray that meets a flattened triangle meets the boxes of the mesh's. With L
// the instance's linear part, W and w the rounded inverse map, B the largest coordinates in its render-space box, o the
// ray's origin and x = o + t d a point in that box, |t d| <= B + |o| on every axis, and in object space, all per axis:
//   the origin's image is off by gamma_5 (|W||o| + |w|), that of t d by gamma_4 |W| (B + |o|);
//   flattened vertices are off by u B, points that the triangle test lets pass by gamma_8 (B + |o|), times |W|;
//   adding the margin to the origin rounds once more: u (|W||o| + |w|).
// The sum is below gamma_20 (|W| (B + |o|) + |w|); gamma_24 leaves room for computing it. The host gives the part
// without |o|. Boxes of instances are widened likewise, with W = 1.
const float kMarginRoundings = 24.0;

// A ray as boxes of one space see it.
struct SlabRay {
  vec3 nearOrigin, farOrigin;  // moved by the margin, so that near planes come nearer and far ones go farther
  vec3 inverse;
  bvec3 negative;
  float tMin;
};

struct SharedWalk {
  uint next;
  uint depth;
  uint steps;
  bool inside;  // an instance; what waits above `floor` is of its tree
  uint floor;
  uint firstVertex, firstTriangle, firstDraw, flags;  // of that instance
};

uint sharedWaiting_[2u * kBvhStackSize];  // a path through either tree has less than kBvhStackSize inner nodes

SlabRay slabRay(vec3 origin, vec3 direction, vec3 margin, float tMin) {
  vec3 inverse = 1.0 / direction;
  bvec3 negative = lessThan(inverse, vec3(0.0));
  vec3 above = origin + margin, below = origin - margin;
  return SlabRay(mix(above, below, negative), mix(below, above, negative), inverse, negative, tMin);
}

SlabRay slabsOutside(Ray ray) {
  return slabRay(ray.origin, ray.direction, gammaBound(kMarginRoundings) * abs(ray.origin), ray.tMin);
}

BoxTest hitWidened(vec3 lower, vec3 upper, SlabRay r, float tMax) {
  const float kWiden = 1.00000036;  // 1 + 2 gamma_3, as in hitSlabs()
  vec3 near = (mix(lower, upper, r.negative) - r.nearOrigin) * r.inverse;
  vec3 far = (mix(upper, lower, r.negative) - r.farOrigin) * r.inverse * kWiden;
  float t0 = greater(near.z, greater(near.y, greater(near.x, r.tMin)));
  float t1 = smaller(far.z, smaller(far.y, smaller(far.x, tMax)));
  return BoxTest(t0 <= t1, t0);
}

void popShared(SlabRay outside, inout SlabRay slabs, inout SharedWalk walk) {
  if (walk.inside && walk.depth == walk.floor) {
    walk.inside = false;
    slabs = outside;
  }
  bool empty = walk.depth == 0u;
  walk.depth -= empty ? 0u : 1u;
  walk.next = empty ? kWalkDone : sharedWaiting_[walk.depth];
}

void descendShared(SlabRay outside, float tMax, inout SlabRay slabs, inout SharedWalk walk) {
  int at = int(4u * walk.next);
  uvec4 a = texelFetch(bvhNodes, at);
  uvec4 b = texelFetch(bvhNodes, at + 1);
  uvec4 c = texelFetch(bvhNodes, at + 2);
  uvec4 d = texelFetch(bvhNodes, at + 3);
  BoxTest first = hitWidened(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), slabs, tMax);
  BoxTest second = hitWidened(uintBitsToFloat(c.xyz), uintBitsToFloat(d.xyz), slabs, tMax);
  bool hit0 = first.hit && a.w != kEmptyChild;
  bool hit1 = second.hit && b.w != kEmptyChild;
  bool swap = hit1 && (!hit0 || second.tNear < first.tNear);
  if (hit0 && hit1) {
    sharedWaiting_[min(walk.depth, 2u * kBvhStackSize - 1u)] = swap ? a.w : b.w;
    ++walk.depth;
  }
  if (hit0 || hit1) walk.next = swap ? b.w : a.w;
  else popShared(outside, slabs, walk);
}

bool atSharedInner(SharedWalk walk) { return (walk.next & kBvhLeaf) == 0u && walk.steps < kLargestWalk; }

void walkToSharedLeaf(SlabRay outside, float tMax, inout SlabRay slabs, inout SharedWalk walk) {
  do {
    if (atSharedInner(walk)) descendShared(outside, tMax, slabs, walk);
    ++walk.steps;
  } while (atSharedInner(walk));
}

vec4 rowOf(uint instance, uint row) { return uintBitsToFloat(texelFetch(instanceTexels, int(5u * instance + row))); }

// Goes on in the tree of the instance that is next.
void enterInstance(Ray ray, inout SlabRay slabs, inout SharedWalk walk) {
  uint instance = walk.next & kBvhFirstMask;
  vec4 x = rowOf(instance, 0u), y = rowOf(instance, 1u), z = rowOf(instance, 2u);
  uvec4 marginAndRoot = texelFetch(instanceTexels, int(5u * instance + 3u));
  uvec4 firsts = texelFetch(instanceTexels, int(5u * instance + 4u));
  vec3 o = ray.origin, d = ray.direction;
  vec3 origin = vec3(dot(x.xyz, o), dot(y.xyz, o), dot(z.xyz, o)) + vec3(x.w, y.w, z.w);
  vec3 direction = vec3(dot(x.xyz, d), dot(y.xyz, d), dot(z.xyz, d));
  vec3 reach = vec3(dot(abs(x.xyz), abs(o)), dot(abs(y.xyz), abs(o)), dot(abs(z.xyz), abs(o)));
  vec3 margin = uintBitsToFloat(marginAndRoot.xyz) + gammaBound(kMarginRoundings) * reach;
  slabs = slabRay(origin, direction, margin, ray.tMin);
  walk.next = marginAndRoot.w;
  walk.inside = true;
  walk.floor = walk.depth;
  walk.firstVertex = firsts.x;
  walk.firstTriangle = firsts.y;
  walk.firstDraw = firsts.z;
  walk.flags = firsts.w;
}

void leaveSharedLeaf(Ray ray, SlabRay outside, uint count, inout SlabRay slabs, inout SharedWalk walk) {
  walk.steps += count;
  bool enters = !walk.inside && walk.next != kWalkDone;
  if (enters) enterInstance(ray, slabs, walk);
  else if (walk.next != kWalkDone) popShared(outside, slabs, walk);
}

uint sharedLeafCount(SharedWalk walk) {
  return walk.inside && walk.next != kWalkDone ? (walk.next >> kBvhCountShift) & 15u : 0u;
}

// The same record as a tree over all triangles has.
PrimitiveTexels fetchShared(uint at, SharedWalk walk) {
  uvec4 corners = texelFetch(instanceTriangles, int(2u * at));
  uint draw = 0u;
  if (CL_HAS(alphaMask) || CL_HAS(transparency))
    draw = walk.firstDraw + texelFetch(instanceTriangles, int(2u * at + 1u)).x;
  return PrimitiveTexels(positionOf(walk.firstVertex + corners.x), positionOf(walk.firstVertex + corners.y),
                         positionOf(walk.firstVertex + corners.z), walk.firstTriangle + (corners.w & kTriangleMask), draw,
                         walk.flags | corners.w >> kTriangleFlagShift);
}

SharedWalk sharedWalk() { return SharedWalk(0u, 0u, 0u, false, 0u, 0u, 0u, 0u, 0u); }
bool sharedGoesOn(SharedWalk walk) { return walk.next != kWalkDone && walk.steps < kLargestWalk; }
void countSharedCapped(SharedWalk walk) { countCapped(Walk(walk.next, 0, walk.steps)); }

HitRecord closestOfInstances(Ray ray, bool cutBackFaces) {
  Closest best = Closest(kMiss, kNoId);
  SlabRay outside = slabsOutside(ray), slabs = outside;
  RayShear shear = shearOf(ray.direction);
  SharedWalk walk = sharedWalk();
  do {
    walkToSharedLeaf(outside, searchedTo(boundOf(best, ray)), slabs, walk);
    uint count = sharedLeafCount(walk);
    uint at = walk.next & kBvhFirstMask;
    uint end = at + count;
    do {
      PrimitiveTexels p = fetchShared(at, walk);
      if (at < end) considerFetched(p, p.id, ray, shear, cutBackFaces, best);
      ++at;
    } while (at < end);
    leaveSharedLeaf(ray, outside, count, slabs, walk);
  } while (sharedGoesOn(walk));
  countSharedCapped(walk);
  return best.hit;
}

float lightPassedInstances(Ray ray) {
  float passed = 1.0;
  SlabRay outside = slabsOutside(ray), slabs = outside;
  RayShear shear = shearOf(ray.direction);
  SharedWalk walk = sharedWalk();
  do {
    walkToSharedLeaf(outside, ray.tMax, slabs, walk);
    uint count = sharedLeafCount(walk);
    uint at = walk.next & kBvhFirstMask;
    uint end = at + count;
    do {
      PrimitiveTexels p = fetchShared(at, walk);
      if (at < end) passed *= lightPassedFetched(p, p.id, ray, shear);
      ++at;
    } while (at < end);
    leaveSharedLeaf(ray, outside, count, slabs, walk);
    if (passed == 0.0) walk.next = kWalkDone;
  } while (sharedGoesOn(walk));
  countSharedCapped(walk);
  return passed;
}

uint drawOfTriangle(uint triangle) {
  uint low = 0u, high = frame.meshDrawCount;  // the draw of `low` does not begin behind the triangle, that of `high` does
  do {
    uint middle = (low + high) / 2u;
    bool behind = texelFetch(drawTexels, int(2u * middle)).x > triangle;
    high = behind ? middle : high;
    low = behind ? low : middle;
  } while (high - low > 1u);
  return low;
}

// What a hit names: the slot of a tree over all triangles, or with shared trees the flattened triangle. Flags are those
// that the walk alone asks for: there are none.
PrimitiveTexels fetchTriangle(uint slot) {
  if (!kInstances) return fetchPrimitive(slot);
  uvec3 corners = cornerIndices(slot);
  return PrimitiveTexels(positionOf(corners.x), positionOf(corners.y), positionOf(corners.z), slot, drawOfTriangle(slot), 0u);
}
#endif
