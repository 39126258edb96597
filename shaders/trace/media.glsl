// The bodies that a ray is in, and which of them counts: Schmidt, Budge 2002, "Simple Nested Dielectrics in Ray Traced
// Images". Bodies that overlap are given priorities; a boundary exists only where the one with the highest changes.
#ifndef CROSSLIGHT_MEDIA_GLSL
#define CROSSLIGHT_MEDIA_GLSL
#extension GL_EXT_control_flow_attributes : require

// kMostMedia of sixteen bits each, in the order in which the ray entered them: material + 1; 0: none.
uint entryOf(uvec4 media, uint place) { return (media[place >> 1u] >> (16u * (place & 1u))) & 0xffffu; }

// Empty until then.
void setEntry(inout uvec4 media, uint place, uint entry) { media[place >> 1u] |= entry << (16u * (place & 1u)); }

// What bodies need of a material: index of refraction, priority, dispersion.
vec3 bodyOf(uint material) {
  int at = int(kMaterialTexels * material);
  uvec4 end = texelFetch(materialTexels, at + kBodyTexel);
  return vec3(max(uintBitsToFloat(texelFetch(materialTexels, at + 6).y), 1.0), uintBitsToFloat(end.x),
              uintBitsToFloat(end.y));
}

uint countOf(uvec4 media) {
  uint count = 0u;
  [[unroll]] for (uint k = 0u; k < kMostMedia; ++k) count += entryOf(media, k) != 0u ? 1u : 0u;
  return count;
}

bool areIn(uvec4 media, uint material) {
  bool found = false;
  [[unroll]] for (uint k = 0u; k < kMostMedia; ++k) found = found || entryOf(media, k) == material + 1u;
  return found;
}

uvec4 entered(uvec4 media, uint material) {
  uint count = countOf(media);
  if (count == kMostMedia) atomicAdd(counters[kCounterMediaLost], 1u);
  else setEntry(media, count, material + 1u);
  return media;
}

// Without the last body of this material.
uvec4 left(uvec4 media, uint material) {
  uint gone = kMostMedia;
  [[unroll]] for (uint k = 0u; k < kMostMedia; ++k) gone = entryOf(media, k) == material + 1u ? k : gone;
  uvec4 kept = uvec4(0u);
  [[unroll]] for (uint k = 0u; k < kMostMedia; ++k) {
    if (k != gone) setEntry(kept, k < gone ? k : k - 1u, entryOf(media, k));
  }
  return kept;
}

// Material of the body with the highest priority, of equals the one entered last; kNoRayNode: in none.
uint mediumThatCounts(uvec4 media) {
  uint best = kNoRayNode;
  float highest = -1.0;
  [[unroll]] for (uint k = 0u; k < kMostMedia; ++k) {
    uint entry = entryOf(media, k);
    if (entry == 0u) continue;
    float priority = bodyOf(entry - 1u).y;
    best = priority >= highest ? entry - 1u : best;
    highest = max(priority, highest);
  }
  return best;
}

struct Boundary {
  bool exists;   // else the ray goes on as if the surface were not there
  uint before;   // media that count on both sides: materials, or kNoRayNode
  uint beyond;
  uvec4 media;  // beyond
};

// Who leaves a body without having entered it was in it all the time: an open mesh, or a camera that nobody placed.
Boundary boundaryAt(uvec4 media, uint material, bool entering) {
  uvec4 here = entering || areIn(media, material) ? media : entered(media, material);
  uvec4 there = entering ? entered(media, material) : left(here, material);
  uint before = mediumThatCounts(here), beyond = mediumThatCounts(there);
  return Boundary(before != beyond, before, beyond, there);
}

float iorOfMedium(uint medium) { return medium == kNoRayNode ? 1.0 : bodyOf(medium).x; }

// Of a hit.
struct SurfaceMedia {
  bool bounds;  // the surface is that of a body
  uvec4 here;   // bodies that the ray is in
  Boundary at;
  vec3 cameraRayKept;  // what absorption leaves of a camera's ray, which has no weight of its own
};
const SurfaceMedia kNoMedia =
    SurfaceMedia(false, uvec4(0u), Boundary(true, kNoRayNode, kNoRayNode, uvec4(0u)), vec3(1.0));

bool isHidden(SurfaceMedia media) { return CL_HAS(nestedMedia) && media.bounds && !media.at.exists; }

// Of this scene: a pipeline with everything compiled in must ask.
bool nestsMedia() { return CL_HAS(nestedMedia) && (frame.optics & kOpticsNestedMedia) != 0u; }

// The camera's rays begin where the frame says.
SurfaceMedia mediaAtHit(uint node, RayRecord ray, HitSurface h, vec3 kept) {
  SurfaceMedia media = kNoMedia;
  bool first = ray.kind == kRayPrimary;
  media.here = frame.cameraMedia;
  if (!first) media.here = mediaOfNodes[node];
  media.cameraRayKept = first ? kept : vec3(1.0);
  if (!nestsMedia()) return media;
  media.bounds = (materialOf(h.at.materialId).flags & (kMaterialRefracts | kMaterialThin)) == kMaterialRefracts;
  if (media.bounds) media.at = boundaryAt(media.here, h.at.materialId, h.at.frontFacing);
  return media;
}
#endif
