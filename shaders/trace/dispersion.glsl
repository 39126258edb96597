// Bodies whose index of refraction differs by color: three rays, for red, green and blue, instead of one. From there on a
// ray carries one channel, which its weights show.
#ifndef CROSSLIGHT_DISPERSION_GLSL
#define CROSSLIGHT_DISPERSION_GLSL

// KHR_materials_dispersion: 20 / V with the Abbe number V = (n_d - 1) / (n_F - n_C); the lines C, d and F stand for red,
// green and blue.
vec3 spread(float ior, float dispersion) {
  float halfSpread = (ior - 1.0) * 0.025 * dispersion;
  return max(ior + vec3(-halfSpread, 0.0, halfSpread), vec3(1.0));
}

vec3 iorsOf(uint medium) {
  if (medium == kNoRayNode) return vec3(1.0);
  vec3 body = bodyOf(medium);
  return spread(body.x, body.z);
}

// Channels that the ray still carries, as a factor.
vec3 channelsOf(RayRecord ray, uint node) {
  if (ray.kind == kRayPrimary) return vec3(1.0);
  return vec3(notEqual(nodes[node].weight, vec3(0.0)));
}

vec3 onlyChannel(vec3 v, int channel) {
  return vec3(channel == 0 ? v.r : 0.0, channel == 1 ? v.g : 0.0, channel == 2 ? v.b : 0.0);
}

// Refracted rays at a boundary: three, or one where the indices are the same for all colors.
struct Dispersed {
  bool spreads;
  vec3 direction[3];
  vec3 passes;     // 1 - F per channel, 0 under total internal reflection
  vec3 reflected;  // F per channel
};

Dispersed disperse(vec3 d, vec3 n, float cosI, vec3 eta) {
  Dispersed result;
  result.spreads = eta.x != eta.y || eta.y != eta.z;
  for (int c = 0; c < 3; ++c) {
    bool passes = refractRay(d, n, eta[c], result.direction[c]);
    result.reflected[c] = fresnelDielectric(cosI, eta[c]);
    result.passes[c] = passes ? 1.0 - result.reflected[c] : 0.0;
  }
  return result;
}
#endif
