// Isotropic point light.
LightSample samplePoint(LightRecord light, vec3 renderPos) {
  vec3 toLight = light.renderPosition - renderPos;
  float d = safeLength(toLight);
  return LightSample(safeNormalize(toLight, vec3(0.0)), d, distanceFalloff(light, d));
}
