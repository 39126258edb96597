// Blinn 1978, "Simulation of Wrinkled Surfaces", Eq. 5: the normal of a surface moved along its normal by a height h,
// for heights small against the surface's curvature: n |Pu x Pv| + hu (n x Pv) - hv (n x Pu). Pu and Pv are the triangle's
// own; heights are differences over two texels of level 0, so that both worlds compute the same.
float heightAt(TextureSlot slot, vec2 uv) {
  slot.uvFromUvXy = vec4(1.0, 0.0, 0.0, 1.0);
  slot.uvOffset = vec2(0.0);
  return sampleTexture(slot, uv, uv).r;
}

vec3 bumpedNormal(MaterialRecord m, SurfaceInput at, vec3 n) {
  TextureSlot slot = m.bumpTexture;
  vec2 place = placeInTexture(slot, at.uv0, at.uv1);
  vec2 texel = 1.0 / vec2(slot.width, slot.height);
  vec2 rise = vec2(0.0);
  for (uint i = 0u; i < 4u; ++i) {  // a loop: the code of one lookup
    vec2 axis = i < 2u ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    float side = (i & 1u) == 0u ? 1.0 : -1.0;
    rise += axis * (side * heightAt(slot, place + axis * texel * side));
  }
  vec2 slope = 0.5 * m.bumpFactor * rise / texel;  // against the texture's coordinates, then the mesh's
  float hu = slope.x * slot.uvFromUvXy.x + slope.y * slot.uvFromUvXy.y;
  float hv = slope.x * slot.uvFromUvXy.z + slope.y * slot.uvFromUvXy.w;
  vec3 across = cross(at.alongU, at.alongV);
  float side = dot(across, n) < 0.0 ? -1.0 : 1.0;  // mirrored texture coordinates
  vec3 tilt = hu * cross(n, at.alongV) - hv * cross(n, at.alongU);
  return safeNormalize(n * length(across) + side * tilt, n);
}
