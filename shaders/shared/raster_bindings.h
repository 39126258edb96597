// What only the raster stages share with the host: slots beyond bindings.h, constants and the push of a draw.
#ifndef CROSSLIGHT_SHARED_RASTER_BINDINGS_H
#define CROSSLIGHT_SHARED_RASTER_BINDINGS_H
#include "types.h"

CL_SHARED_BEGIN
CL_CONST uint kBindDrawMaterial = 30;      // uniform MaterialRecord: a window onto that of the draw
CL_CONST uint kBindFewLights = 31;         // uniform LightRecord[kFewLights]
CL_CONST uint kBindDisplayCodes = 40;      // uint texels: displayCodeTable() of the image room; pictures of codes only
CL_CONST uint kBindVertexVisibility = 65;  // float[vertices * lights]: of methods that light vertices
CL_CONST uint kBindShadowTexels = 66;      // uint texels: bits of distances, see shadow_map.glsl
CL_CONST uint kBindShadowViews = 67;       // ShadowView[]
CL_CONST uint kBindShadowLights = 68;      // ShadowLight[], one per light

CL_CONST uint kSpecVaryings = 30;       // bits kVarying*: what the vertex stage passes on and fragments read
CL_CONST uint kSpecLightCount = 31;     // lights in kBindFewLights; kManyLights: read kBindLights instead
CL_CONST uint kSpecRasterShadows = 55;  // kShadows*
CL_CONST uint kSpecShadowFilter = 56;   // texels a side that a lookup averages; 0: as many as the penumbra is wide

CL_CONST uint kShadowsOff = 0u;
CL_CONST uint kShadowsByMaps = 1u;
CL_CONST uint kShadowsByRays = 2u;

// As many as fit into the 16 KiB that every device allows for a uniform block.
CL_CONST uint kFewLights = 170;
CL_CONST uint kManyLights = 0xffffffffu;

CL_CONST uint kVaryingPosition = 1u;
CL_CONST uint kVaryingNormal = 2u;
CL_CONST uint kVaryingTangent = 4u;
CL_CONST uint kVaryingUvs = 8u;
CL_CONST uint kVaryingColor = 16u;
CL_CONST uint kVaryingAll = 0xffffffffu;

// Bit 1 of the raster methods' variant (kSpecVariant): lighting per vertex is passed on in its parts even where one
// color would do. For AOVs.
CL_CONST uint kVariantSeparateSums = 2u;

struct RasterPush {
  uint firstTriangle;  // of the draw: added to gl_PrimitiveID
  uint firstPixel;     // AOV pass: subtracted from the target's pixel index to give that within the band
  uint drawId;         // AOV pass
  uint materialId;
  uint drawFlags;     // kDraw*
  float displayGain;  // pictures of codes only
};

// vertex_shadow.comp: visibility of one light from each vertex.
struct VertexShadowPush {
  uint vertexCount;
  uint light;
  uint lightCount;
  float reach;  // no coordinate of the scene is larger, render space
};
CL_SHARED_END
#endif
