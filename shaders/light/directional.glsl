// Parallel light from infinity: no falloff.
LightSample sampleDirectional(LightRecord light, vec3 renderPos) {
  return LightSample(-light.direction, kLargest, 1.0);
}
