#version 460
// Edges in the surface's own color, unlit.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "shade/shade.glsl"
#define CL_STAGE in
#include "raster/varyings.glsl"

layout(location = 0) out vec4 outColor;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

void main() {
  SurfaceInput at = SurfaceInput(renderPos, renderNormal, vec3(0.0, 0.0, 1.0), renderTangent, uvs.xy, uvs.zw,
                                 vertexColor, draws[drawId].materialId, gl_FrontFacing,
                                 (draws[drawId].flags & kDrawHasColors) != 0u, false);
  outColor = vec4(surfaceAt(at).albedo, 1.0);
}
