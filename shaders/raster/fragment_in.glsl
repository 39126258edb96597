// The fragment's end of varyings.glsl: what was interpolated, and zero for what was left out.
#define CL_STAGE in
#include "raster/varyings.glsl"

// The geometric normal is left to the caller.
SurfaceInput interpolatedInput() {
  SurfaceInput at;
  vec4 texCoords = CL_VARIES(Uvs) ? passed[kUvs] : vec4(0.0);
  at.renderPos = CL_VARIES(Position) ? passed[kPosition].xyz : vec3(0.0);
  at.normal = CL_VARIES(Normal) ? passed[kNormal].xyz : vec3(0.0);
  at.geometricNormal = vec3(0.0, 0.0, 1.0);
  at.tangent = CL_VARIES(Tangent) ? passed[kTangent] : vec4(0.0);
  at.uv0 = texCoords.xy;
  at.uv1 = texCoords.zw;
  at.color = CL_VARIES(Color) ? passed[kColor] : vec4(1.0);
  at.materialId = pushed.materialId;
  at.frontFacing = gl_FrontFacing;
  at.colored = (pushed.drawFlags & kDrawHasColors) != 0u;
  at.bothSides = false;
  at.footprint = vec2(0.0);
  at.alongU = at.alongV = vec3(0.0);
  return at;
}
