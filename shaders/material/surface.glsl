// From a material and a point's attributes to what illumination needs. The same function serves vertices, fragments
// and ray hits; CL_UNTEXTURED (per-vertex lighting) leaves textures to the fragments that follow.
#ifndef CROSSLIGHT_SURFACE_GLSL
#define CROSSLIGHT_SURFACE_GLSL
#include "math/numeric.glsl"
#include "material/texture.glsl"

// Where the record comes from: a list by index (rays), unless the includer has it at hand (raster, a draw's own).
#ifndef CL_MATERIAL
#define CL_MATERIAL(id) materialOf(id)
#endif

// Smallest GGX alpha that is evaluated: below it a lobe is narrower than fp32 directions resolve (NoH within 2^-24 of 1).
const float kSmallestAlpha = 1e-3;

struct SurfaceInput {
  vec3 renderPos;
  vec3 normal;           // interpolated, of any length, as the mesh has it
  vec3 geometricNormal;  // unit, of the front side
  vec4 tangent;
  vec2 uv0;
  vec2 uv1;
  vec4 color;
  uint materialId;
  bool frontFacing;
  bool colored;    // `color` counts
  bool bothSides;  // lit on the side that is seen whatever the material says: secondary rays
};

struct SurfacePoint {
  vec3 position;
  vec3 n;    // unit, on the viewer's side where the surface is two-sided
  vec3 ng;   // unit, the same side as the viewer where two-sided
  uint model;
  vec3 ambientColor;
  vec3 diffuseColor;
  vec3 specularColor;  // ks, or F0
  vec3 albedo;
  vec3 emission;
  float shininess;
  float alpha;             // GGX
  float dielectricF0;
  float opacity;           // coverage and 1 - kt: how much of what is behind is hidden
  vec3 transmissionColor;  // weight of light that passes, Fresnel aside
};

vec3 mappedNormal(MaterialRecord m, vec3 n, vec4 tangent, vec2 uv0, vec2 uv1) {
  // 8-bit 128 is zero exactly: (b - 128) / 127 instead of 2 b / 255 - 1, which would tilt a flat map by 0.3 degrees.
  vec3 texel = sampleTexture(m.normalTexture, uv0, uv1).xyz;
  vec3 local = max((texel * 255.0 - 128.0) / 127.0, vec3(-1.0)) * vec3(m.normalScale, m.normalScale, 1.0);
  vec3 t = safeNormalize(tangent.xyz - n * dot(n, tangent.xyz), vec3(0.0));
  vec3 b = cross(n, t) * tangent.w;
  return safeNormalize(t * local.x + b * local.y + n * local.z, n);
}

void setClassic(MaterialRecord m, vec3 base, inout SurfacePoint s) {
  s.ambientColor = m.ambientColor * base;
  s.diffuseColor = m.diffuseColor * base;
  s.specularColor = m.specularColor;
  s.albedo = s.diffuseColor;
  s.shininess = m.shininess;
}

// glTF 2.0, Appendix B.2: mix of a dielectric (F0 from the index of refraction) and a metal (F0 = base color).
void setMetallicRoughness(MaterialRecord m, vec3 base, vec2 uv0, vec2 uv1, inout SurfacePoint s) {
  float metallic = m.metallic;
  float roughness = m.perceptualRoughness;
#ifndef CL_UNTEXTURED
  if (CL_HAS(metallicRoughnessTexture) && hasTexture(m.metallicRoughnessTexture)) {
    vec4 texel = sampleTexture(m.metallicRoughnessTexture, uv0, uv1);
    metallic *= texel.b;
    roughness *= texel.g;
  }
#endif
  float ior = m.indexOfRefraction;
  float r = (ior - 1.0) / (ior + 1.0);
  s.dielectricF0 = ior == 0.0 ? 1.0 : r * r;
  s.alpha = max(roughness * roughness, kSmallestAlpha);
  s.albedo = base;
  s.ambientColor = base * (1.0 - m.transmission * (1.0 - metallic));
  s.diffuseColor = base * (1.0 - metallic) * (1.0 - m.transmission);
  s.specularColor = interpolate(vec3(s.dielectricF0), base, metallic);
  s.transmissionColor = base * m.transmission * (1.0 - metallic);
}

SurfacePoint surfaceAt(SurfaceInput at) {
  MaterialRecord m = CL_MATERIAL(at.materialId);
  SurfacePoint s;
  s.position = at.renderPos;
  s.model = m.model;
  s.shininess = 0.0;
  s.alpha = 1.0;
  s.dielectricF0 = 0.04;
  s.transmissionColor = vec3(m.transmission);

  bool flip = CL_HAS(twoSided) && !at.frontFacing &&
              (at.bothSides || ((m.flags & kMaterialDoubleSided) | frame.twoSided) != 0u);
  s.ng = flip ? -at.geometricNormal : at.geometricNormal;
  vec3 n = safeNormalize(at.normal, at.geometricNormal);
#ifndef CL_UNTEXTURED
  if (CL_HAS(normalMap) && hasTexture(m.normalTexture) && at.tangent.w != 0.0)
    n = mappedNormal(m, n, at.tangent, at.uv0, at.uv1);
#endif
  s.n = flip ? -n : n;

  vec4 base = m.baseColor;
  if (CL_HAS(vertexColors) && at.colored) base *= at.color;
  s.emission = m.emission;
#ifndef CL_UNTEXTURED
  if (CL_HAS(baseColorTexture) && hasTexture(m.baseColorTexture)) base *= sampleTexture(m.baseColorTexture, at.uv0, at.uv1);
  if (CL_HAS(emissiveTexture) && hasTexture(m.emissiveTexture)) s.emission *= sampleTexture(m.emissiveTexture, at.uv0, at.uv1).rgb;
#endif
  bool blends = (m.flags & kMaterialAlphaBlend) != 0u;
  bool physical = m.model == kModel_cookTorrance || m.model == kModel_unlit;
  s.opacity = (blends ? base.a : 1.0) * (physical ? 1.0 : 1.0 - m.transmission);

  setClassic(m, base.rgb, s);
  if ((specModels & (1u << kModel_cookTorrance)) != 0u && m.model == kModel_cookTorrance)
    setMetallicRoughness(m, base.rgb, at.uv0, at.uv1, s);
  if (m.model == kModel_unlit) {  // unlit: the base color stands for all light
    s.emission = base.rgb;
    s.albedo = base.rgb;
    s.ambientColor = vec3(0.0);
    s.diffuseColor = vec3(0.0);
    s.specularColor = vec3(0.0);
  }
#ifndef CL_UNTEXTURED
  if (CL_HAS(occlusionTexture) && hasTexture(m.occlusionTexture)) {
    float occlusion = sampleTexture(m.occlusionTexture, at.uv0, at.uv1).r;
    s.ambientColor *= 1.0 + m.occlusionStrength * (occlusion - 1.0);
  }
#endif
  return s;
}

// Share of light that an occlusion test lets pass, and whether the surface is there at all (alpha mask).
// `vertexAlpha` is 1 where the mesh has no colors.
float baseAlphaAt(MaterialRecord m, vec2 uv0, vec2 uv1, float vertexAlpha) {
  float alpha = m.baseColor.a;
  if (CL_HAS(vertexColors)) alpha *= vertexAlpha;
  if (CL_HAS(baseColorTexture) && hasTexture(m.baseColorTexture)) alpha *= sampleTexture(m.baseColorTexture, uv0, uv1).a;
  return alpha;
}

bool cutByMask(MaterialRecord m, float alpha) {
  return (m.flags & kMaterialAlphaMask) != 0u && alpha < m.alphaCutoff;
}
#endif
