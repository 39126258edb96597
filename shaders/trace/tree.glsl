// The ray tree's storage and the step from a hit to a surface: shared by the kernels of the Whitted tracer.
#ifndef CROSSLIGHT_TREE_GLSL
#define CROSSLIGHT_TREE_GLSL

layout(push_constant, scalar) uniform PushBlock { TracePush pushed; };
layout(set = 0, binding = kBindRayNodes, scalar) buffer NodeBlock { RayNode nodes[]; };
layout(set = 0, binding = kBindHits, scalar) buffer HitBlock { HitRecord hits[]; };
layout(set = 0, binding = kBindVisibility, scalar) buffer VisibilityBlock { float visibilities[]; };

// What the camera sees directly or through surfaces that do not bend light: single-sided surfaces have no back there,
// as in the rasteriser. Mirrored and refracted rays meet bodies from inside too.
bool goesStraight(RayNode node) { return node.kind == kRayPrimary || node.kind == kRayPassThrough; }
#endif
