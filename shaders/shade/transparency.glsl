// How much of what lies behind a surface shows, where nothing bends the light: I = (1 - kt) Irefl + kt Itrans.
#ifndef CROSSLIGHT_TRANSPARENCY_GLSL
#define CROSSLIGHT_TRANSPARENCY_GLSL

struct Layer {
  vec3 color;   // what the surface adds, times what it hides
  vec3 passed;  // share of what lies behind, per channel
};

// `lit`: light that leaves the surface. Where it covers, glass lets its own color pass; the classic kt is in the opacity.
Layer layerOf(SurfacePoint s, vec3 lit) {
  float opacity = CL_HAS(transparency) ? s.opacity : 1.0;
  vec3 through = CL_HAS(transparency) && s.model == kModel_cookTorrance ? s.transmissionColor : vec3(0.0);
  return Layer(lit * opacity, (1.0 - opacity) + opacity * through);
}
#endif
