// What materials tell the BVH's walk about surfaces that are cut away or let light pass.
#ifndef CROSSLIGHT_PASSED_LIGHT_GLSL
#define CROSSLIGHT_PASSED_LIGHT_GLSL
#include "shade/shade.glsl"
#include "accel/bvh.glsl"

float passedLight(MaterialRecord m, float alpha) {
  bool blends = (m.flags & kMaterialAlphaBlend) != 0u;
  float passed = 1.0 - (blends ? alpha : 1.0) * (1.0 - m.transmission);
  return cutByMask(m, alpha) ? 1.0 : passed;
}

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
  return passedLight(materialOf(drawOf(drawId).materialId), alphaAtTriangle(triangle, drawId, b1, b2));
}

float passedByShape(uint drawId, vec2 uv) {
  MaterialRecord m = materialOf(drawOf(drawId).materialId);
  return passedLight(m, baseAlphaAt(m, uv, uv, 1.0));
}

bool maskCutsTriangle(uint triangle, uint drawId, float b1, float b2) {
  MaterialRecord m = materialOf(drawOf(drawId).materialId);
  bool masked = (m.flags & kMaterialAlphaMask) != 0u;
  return masked && cutByMask(m, alphaAtTriangle(triangle, drawId, b1, b2));
}
#endif
