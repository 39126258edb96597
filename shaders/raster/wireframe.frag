#version 460
// Edges in the surface's own color, unlit.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "material/surface.glsl"
#define CL_STAGE in
#include "raster/varyings.glsl"

layout(location = 0) out vec4 outColor;

void main() {
  SurfaceInput at = SurfaceInput(renderPos, renderNormal, vec3(0.0, 0.0, 1.0), renderTangent, uvs.xy, uvs.zw,
                                 vertexColor, draws[drawId].materialId, gl_FrontFacing, false);
  outColor = vec4(surfaceAt(at).albedo, 1.0);
}
