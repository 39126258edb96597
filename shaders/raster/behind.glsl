// Where a pixel looks, as the tracer's camera rays do.
#ifndef CROSSLIGHT_BEHIND_GLSL
#define CROSSLIGHT_BEHIND_GLSL
// On the image plane, off its middle. The push's first pixel is the row of the picture that is the target's first.
vec3 acrossImagePlane() {
  vec2 at = floor(gl_FragCoord.xy) + vec2(0.0, pushed.firstPixel) + frame.sampleOffset;
  vec2 plane = (2.0 * at / vec2(frame.resolution) - 1.0) * vec2(1.0, -1.0) * frame.imagePlaneHalf;
  return plane.x * frame.cameraRight + plane.y * frame.cameraUp;
}
vec3 directionOfPixel() {
  return frame.orthographic != 0u ? frame.cameraForward : frame.cameraForward + acrossImagePlane();
}
#endif
