// Where textures lie on a triangle and how large a pixel is on it: what levels and bumps go by, in both worlds. The rule
// stands in material/texture.glsl.
#ifndef CROSSLIGHT_PLACE_TEXTURES_GLSL
#define CROSSLIGHT_PLACE_TEXTURES_GLSL
#include "material/surface.glsl"

// How the texture coordinates lie on a triangle, for levels and bumps.
struct TriangleUv {
  vec2 perLength;  // square root of texture area per area, uv0 and uv1
  vec3 alongU;     // by one of the sets
  vec3 alongV;
};

// a/b where b may be zero: none, rather than infinity.
float ratioOrZero(float a, float b) { return b != 0.0 ? a / b : 0.0; }

TriangleUv triangleUv(vec3 v0, vec3 v1, vec3 v2, vec4 uvs0, vec4 uvs1, vec4 uvs2, bool secondSet) {
  vec3 e1 = v1 - v0, e2 = v2 - v0;
  vec4 d1 = uvs1 - uvs0, d2 = uvs2 - uvs0;
  vec2 area = d1.xz * d2.yw - d1.yw * d2.xz;
  float size = length(cross(e1, e2));
  vec2 a = secondSet ? d1.zw : d1.xy, b = secondSet ? d2.zw : d2.xy;
  float inverse = ratioOrZero(1.0, secondSet ? area.y : area.x);
  return TriangleUv(vec2(sqrt(ratioOrZero(abs(area.x), size)), sqrt(ratioOrZero(abs(area.y), size))),
                    (e1 * b.y - e2 * a.y) * inverse, (e2 * a.x - e1 * b.x) * inverse);
}

vec4 uvsOf(uint vertex) { return texelFetch(attributeTexels, int(4u * vertex + 2u)); }

const TriangleUv kNoTriangleUv = TriangleUv(vec2(0.0), vec3(0.0), vec3(0.0));
const bool kPlacesTextures = (specEffects & (kEffect_mipmaps | kEffect_bumpMap)) != 0u;

// `acrossPixel`: width of the pixel at the point, in scene units; `direction`: of the light's way to it, unit; `ng`: the
// triangle's own normal.
void placeTextures(TriangleUv uv, float acrossPixel, vec3 direction, vec3 ng, inout SurfaceInput at) {
  float cosine = max(abs(dot(ng, direction)), kUnitRoundoff);
  at.footprint = uv.perLength * (acrossPixel / cosine);
  at.alongU = uv.alongU;
  at.alongV = uv.alongV;
}

// Width of a pixel at distance 1, and where it begins: orthographic pixels do not widen.
float pixelSpread() { return frame.orthographic != 0u ? 0.0 : 2.0 * frame.imagePlaneHalf.y / float(frame.resolution.y); }
float pixelWidthAtCamera() { return frame.orthographic != 0u ? 2.0 * frame.imagePlaneHalf.y / float(frame.resolution.y) : 0.0; }

bool bumpReadsSecondSet(uint material) { return (CL_MATERIAL(material).bumpTexture.flags & kTextureUv1) != 0u; }
#endif
