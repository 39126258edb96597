// What materials tell the BVH's walk about surfaces that are cut away or let light pass.
#ifndef CROSSLIGHT_PASSED_LIGHT_GLSL
#define CROSSLIGHT_PASSED_LIGHT_GLSL
#include "shade/shade.glsl"
#include "accel/bvh.glsl"

// `tint`: of what glass lets pass.
float passedLight(MaterialRecord m, float alpha, float tint) {
  bool blends = (m.flags & kMaterialAlphaBlend) != 0u;
  float passed = 1.0 - (blends ? alpha : 1.0) * (1.0 - m.transmission * tint);
  return cutByMask(m, alpha) ? 1.0 : passed;
}

// Shadows in color are looked for one channel at a time: CL_SHADOW_CHANNEL says which.
#ifdef CL_SHADOW_CHANNEL
bool inColor() { return CL_HAS(coloredShadows) && (frame.optics & kOpticsColoredShadows) != 0u; }

float tintOf(MaterialRecord m, vec2 uv0, vec2 uv1, vec4 color) {
  if (!inColor() || m.model != kModel_cookTorrance) return 1.0;
  float tint = m.baseColor[CL_SHADOW_CHANNEL];
  if (CL_HAS(vertexColors)) tint *= color[CL_SHADOW_CHANNEL];
  if (CL_HAS(baseColorTexture) && hasTexture(m.baseColorTexture))
    tint *= sampleTexture(m.baseColorTexture, uv0, uv1)[CL_SHADOW_CHANNEL];
  return tint;
}

float tintAtTriangle(MaterialRecord m, uint triangle, bool colored, float b1, float b2) {
  if (!inColor()) return 1.0;
  uvec3 corners = cornerIndices(triangle);
  VertexAttributes a0 = attributesOf(corners.x);
  VertexAttributes a1 = attributesOf(corners.y);
  VertexAttributes a2 = attributesOf(corners.z);
  float b0 = 1.0 - b1 - b2;
  vec4 color = colored ? b0 * a0.color + b1 * a1.color + b2 * a2.color : vec4(1.0);
  return tintOf(m, b0 * a0.uv0 + b1 * a1.uv0 + b2 * a2.uv0, b0 * a0.uv1 + b1 * a1.uv1 + b2 * a2.uv1, color);
}

// Optical depth of what the ray has crossed: a body's way out counts as far as it lies along the ray, its way in is
// taken away again, whichever of them the tree finds first.
float crossedDepth_ = 0.0;

// The same for the length of the way in the body that it begins in, CL_BODY_OF_WAY, where that scatters; shadows in
// color have it in their depth.
float crossedLength_ = 0.0;
#ifdef CL_BODY_OF_WAY
bool followsBody() { return CL_HAS_TOO(volumeScatter) && CL_BODY_OF_WAY != kNoRayNode; }
void noteLength(uint material, bool leaves, float length) {
  if (followsBody() && material == CL_BODY_OF_WAY) crossedLength_ += leaves ? length : -length;
}
#else
bool followsBody() { return false; }
void noteLength(uint material, bool leaves, float length) {}
#endif

bool countsCrossings() { return inColor() || followsBody(); }

void noteCrossing(uint drawId, bool leaves, Ray ray, float t) {
  uint material = drawOf(drawId).materialId;
  if (!inColor()) {
    noteLength(material, leaves, t * safeLength(ray.direction));
    return;
  }
  MaterialRecord m = materialOf(material);
  if (!(m.attenuationDistance > 0.0) || (m.flags & kMaterialThin) != 0u) return;
  float perUnit = -log(max(m.attenuationColor[CL_SHADOW_CHANNEL], 1.0 / kLargest)) / m.attenuationDistance;
  float depth = perUnit * t * safeLength(ray.direction);
  crossedDepth_ += leaves ? depth : -depth;
}
// Of the crossings since the last time.
float crossedLength() {
  float length = greater(crossedLength_, 0.0);
  crossedLength_ = 0.0;
  return length;
}
float crossedShare() {
  float share = exp(-greater(crossedDepth_, 0.0));
  crossedDepth_ = 0.0;
  return share;
}
#else
float tintOf(MaterialRecord m, vec2 uv0, vec2 uv1, vec4 color) { return 1.0; }
float tintAtTriangle(MaterialRecord m, uint triangle, bool colored, float b1, float b2) { return 1.0; }
bool inColor() { return false; }
bool countsCrossings() { return false; }
void noteCrossing(uint drawId, bool leaves, Ray ray, float t) {}
float crossedShare() { return 1.0; }
#endif

float alphaAtTriangle(uint triangle, uint drawId, float b1, float b2) {
  uvec3 corners = cornerIndices(triangle);
  VertexAttributes a0 = attributesOf(corners.x);
  VertexAttributes a1 = attributesOf(corners.y);
  VertexAttributes a2 = attributesOf(corners.z);
  DrawRecord draw = drawOf(drawId);
  float b0 = 1.0 - b1 - b2;
  bool colored = (draw.flags & kDrawHasColors) != 0u;
  float vertexAlpha = b0 * a0.color.a + b1 * a1.color.a + b2 * a2.color.a;
  return baseAlphaAt(materialOf(draw.materialId), b0 * a0.uv0 + b1 * a1.uv0 + b2 * a2.uv0,
                     b0 * a0.uv1 + b1 * a1.uv1 + b2 * a2.uv1, colored ? vertexAlpha : 1.0);
}

float passedByTriangle(uint triangle, uint drawId, float b1, float b2) {
  DrawRecord draw = drawOf(drawId);
  MaterialRecord m = materialOf(draw.materialId);
  return passedLight(m, alphaAtTriangle(triangle, drawId, b1, b2),
                     tintAtTriangle(m, triangle, (draw.flags & kDrawHasColors) != 0u, b1, b2));
}

float passedByShape(uint drawId, vec2 uv) {
  MaterialRecord m = materialOf(drawOf(drawId).materialId);
  return passedLight(m, baseAlphaAt(m, uv, uv, 1.0), tintOf(m, uv, uv, vec4(1.0)));
}

bool maskCutsTriangle(uint triangle, uint drawId, float b1, float b2) {
  MaterialRecord m = materialOf(drawOf(drawId).materialId);
  bool masked = (m.flags & kMaterialAlphaMask) != 0u;
  return masked && cutByMask(m, alphaAtTriangle(triangle, drawId, b1, b2));
}
#endif
