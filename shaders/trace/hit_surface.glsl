// From a hit record to the surface's attributes, as the rasteriser's interpolation would give them, and to the origin
// of rays that leave the surface.
#ifndef CROSSLIGHT_HIT_SURFACE_GLSL
#define CROSSLIGHT_HIT_SURFACE_GLSL
#include "shade/passed_light.glsl"
#include "shade/triangle.glsl"
#include "shade/place_textures.glsl"
#include "accel/leave_point.glsl"

struct HitSurface {
  SurfaceInput at;
  vec3 positionError;  // bound of the rounding error of at.renderPos, per axis
  uint drawId;
  uint primitiveId;
  TriangleUv uv;  // where kPlacesTextures
  uint slot;  // of the triangle in the tree; kNoHit for shapes, whose rays may meet them again
};

// Where on a triangle a ray has met it.
struct TrianglePoint {
  vec3 position;
  vec3 error;
};

TrianglePoint pointOnTriangle(PrimitiveTexels p, vec3 b) {
  vec3 x = b.x * p.v0;
  vec3 y = b.y * p.v1;
  vec3 z = b.z * p.v2;
  // gamma_7: Pharr, Jakob, Humphreys 2023, "Physically Based Rendering" 4th ed., Eq. 6.31.
  return TrianglePoint(x + y + z, gammaBound(7.0) * (abs(x) + abs(y) + abs(z)));
}

vec3 barycentricsOf(HitRecord hit) { return vec3(1.0 - hit.b1 - hit.b2, hit.b1, hit.b2); }

HitSurface triangleSurface(HitRecord hit) {
  PrimitiveTexels p = fetchTriangle(hit.primitive);
  uvec3 corners = cornerIndices(p.id);
  VertexAttributes a0 = attributesOf(corners.x);
  VertexAttributes a1 = attributesOf(corners.y);
  VertexAttributes a2 = attributesOf(corners.z);
  DrawRecord draw = drawOf(p.drawId);
  vec3 b = barycentricsOf(hit);
  TrianglePoint point = pointOnTriangle(p, b);
  HitSurface s;
  s.at.renderPos = point.position;
  s.positionError = point.error;
  s.at.normal = b.x * a0.renderNormal + b.y * a1.renderNormal + b.z * a2.renderNormal;
  s.at.geometricNormal = triangleNormal(p.v0, p.v1, p.v2, (draw.flags & kDrawFlipsWinding) != 0u);
  s.at.tangent = b.x * a0.renderTangent + b.y * a1.renderTangent + b.z * a2.renderTangent;
  s.at.uv0 = b.x * a0.uv0 + b.y * a1.uv0 + b.z * a2.uv0;
  s.at.uv1 = b.x * a0.uv1 + b.y * a1.uv1 + b.z * a2.uv1;
  s.at.color = b.x * a0.color + b.y * a1.color + b.z * a2.color;
  s.at.colored = (draw.flags & kDrawHasColors) != 0u;
  s.at.materialId = draw.materialId;
  s.drawId = p.drawId;
  s.primitiveId = draw.primitiveBase + p.id - draw.firstTriangle;
  s.slot = hit.primitive;
  s.uv = kNoTriangleUv;
  if (kPlacesTextures)
    s.uv = triangleUv(p.v0, p.v1, p.v2, vec4(a0.uv0, a0.uv1), vec4(a1.uv0, a1.uv1), vec4(a2.uv0, a2.uv1),
                      bumpReadsSecondSet(draw.materialId));
  s.at.footprint = vec2(0.0);
  s.at.alongU = s.at.alongV = vec3(0.0);
  return s;
}

HitSurface shapeSurface(HitRecord hit, Ray ray) {
  ShapeRecord shape = shapeOf(hit.primitive & ~kHitShape);
  ShapeHit found = hitShapeInstance(shape, ray);
  DrawRecord draw = drawOf(shape.drawId);
  HitSurface s;
  vec3 fromCenter = renderVector(shape, found.p);
  s.at.renderPos = shape.renderCenter + fromCenter;
  // Scale of the shape's own coordinates, not of the hit point: near the origin of a huge sphere the point is small but
  // its error is not. Five roundings: two of the point on the shape, three of the transform; one more of the sum.
  float extent = maxComponent(abs(fromCenter)) + maxComponent(abs(shape.renderCenter));
  s.positionError = vec3(gammaBound(6.0) * extent);
  s.at.geometricNormal = safeNormalize(renderNormal(shape, found.n), vec3(0.0, 1.0, 0.0));
  s.at.normal = s.at.geometricNormal;
  s.at.tangent = vec4(0.0);
  s.at.uv0 = found.uv;
  s.at.uv1 = found.uv;
  s.at.color = vec4(1.0);
  s.at.colored = false;
  s.at.materialId = draw.materialId;
  s.drawId = shape.drawId;
  s.primitiveId = 0u;
  s.slot = kNoHit;
  s.uv = kNoTriangleUv;
  s.at.footprint = vec2(0.0);
  s.at.alongU = s.at.alongV = vec3(0.0);
  return s;
}

// `bothSides`: what secondary rays meet is lit on the side that they see (camera rays keep to the material's rule).
HitSurface surfaceOfHit(HitRecord hit, Ray ray, bool bothSides) {
  HitSurface s;
  if (isShapeHit(hit)) s = shapeSurface(hit, ray);
  else s = triangleSurface(hit);
  s.at.frontFacing = dot(s.at.geometricNormal, ray.direction) < 0.0;
  s.at.bothSides = bothSides;
  return s;
}

// Within a refracting body.
bool isInterior(HitSurface s) {
  return CL_HAS(refraction) && !s.at.frontFacing && (materialOf(s.at.materialId).flags & kMaterialRefracts) != 0u;
}

vec3 leaveSurface(HitSurface s, vec3 direction) {
  return leavePoint(s.at.renderPos, s.positionError, s.at.geometricNormal, direction);
}

#endif
