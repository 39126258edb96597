// What only the raster stages share with the host: slots beyond bindings.h, constants and the push of a draw.
#ifndef CROSSLIGHT_SHARED_RASTER_BINDINGS_H
#define CROSSLIGHT_SHARED_RASTER_BINDINGS_H
#include "types.h"

CL_SHARED_BEGIN
CL_CONST uint kBindDrawMaterial = 30;  // uniform MaterialRecord: a window onto that of the draw
CL_CONST uint kBindFewLights = 31;     // uniform LightRecord[kFewLights]
CL_CONST uint kBindDisplayCodes = 40;  // uint texels: displayCodeTable() of the image room; pictures of codes only
CL_CONST uint kBindLayerHeads = 50;    // uint per sample of the rows that are drawn: its last LayerRecord, or kNoLayer
CL_CONST uint kBindLayers = 51;        // LayerRecord[], in the order in which fragments came
CL_CONST uint kBindLayerCounts = 52;   // uint[kLayerCounts]
CL_CONST uint kBindVertexVisibility = 65;  // float[vertices * lights]: of methods that light vertices
CL_CONST uint kBindShadowTexels = 66;      // uint texels: bits of distances, see shadow_map.glsl
CL_CONST uint kBindShadowViews = 67;       // ShadowView[]
CL_CONST uint kBindShadowLights = 68;      // ShadowLight[], one per light
CL_CONST uint kBindReflectors = 69;        // Reflector[], one per DrawRecord
CL_CONST uint kBindReflected = 71;         // texels: pictures of mirrors, then the cubes of probes

CL_CONST uint kSpecVaryings = 30;       // bits kVarying*: what the vertex stage passes on and fragments read
CL_CONST uint kSpecLightCount = 31;     // lights in kBindFewLights; kManyLights: read kBindLights instead
CL_CONST uint kSpecSamples = 40;        // per pixel
CL_CONST uint kSpecLoopPasses = 41;     // at most, through all loops of an invocation
CL_CONST uint kSpecRasterShadows = 55;  // kShadows*
CL_CONST uint kSpecShadowFilter = 56;   // texels a side that a lookup averages; 0: as many as the penumbra is wide

CL_CONST uint kSpecReflections = 57;  // kReflections*

CL_CONST uint kReflectionsOff = 0u;
CL_CONST uint kReflectionsOfBackground = 1u;
CL_CONST uint kReflectionsByPictures = 2u;

CL_CONST uint kShadowsOff = 0u;
CL_CONST uint kShadowsByMaps = 1u;
CL_CONST uint kShadowsByRays = 2u;

// As many as fit into the 16 KiB that every device allows for a uniform block.
CL_CONST uint kFewLights = 128;
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

// A transparent fragment of one sample.
struct LayerRecord {
  float depth;    // gl_FragCoord.z: nearer is greater
  uint triangle;  // of the flattened list: of equal depths the first lies in front
  uint next;      // kNoLayer: none
  vec3 color;     // what it adds, times what it hides
  vec3 passed;    // share of what lies behind that shows
};
CL_SIZE(LayerRecord, 36)
CL_CONST uint kNoLayer = 0xffffffffu;

CL_CONST uint kLayersWanted = 0;    // fragments, those included for which there was no room
CL_CONST uint kLayersTooMany = 1;   // 1: more than can be counted
CL_CONST uint kLayersCutShort = 2;  // 1: a sample has more than the loops of this driver can sort
CL_CONST uint kLayerCounts = 3;

struct RasterPush {
  uint firstTriangle;  // of the draw: added to gl_PrimitiveID
  uint firstPixel;     // subtracted from the target's pixel index to give that within the band; background: row of the
                       // picture that is the target's first
  uint drawId;
  uint materialId;
  uint drawFlags;      // kDraw*
  float displayGain;   // pictures of codes only
  uint layerFirstRow;  // of the target: where the rows begin that have lists
  uint layerCapacity;
};

// How a light sees the scene: one map. In the list of texels a view has layers of size * size words: distances along
// `forward` of the nearest blocker; then, only where something transparent is in the scene, those of the nearest
// transparent surface, and four words per texel of which the first is the share that all of them together let pass.
struct ShadowView {
  vec3 right;  // unit, render space
  vec3 up;
  vec3 forward;   // the way the light looks
  vec3 origin;    // the light, or of parallel light the middle of the near side; render space
  vec2 halfSize;  // of the map: tangents, or of parallel light scene units
  float zNear;    // nothing nearer to the light casts a shadow; not of parallel light
  float zFar;     // of parallel light: everything lies between the origin and here
  float reach;    // no coordinate of the scene, relative to camera or origin, is larger
  float guard;    // texels between the part of the map that is asked for and its border
  uint firstTexel;
  uint size;    // texels a side
  uint layers;  // 1, or 2 with transparent surfaces
  uint orthographic;
};
CL_SIZE(ShadowView, 88)
CL_CONST uint kShadowNone = 0u;
CL_CONST uint kShadowSingle = 1u;    // one view
CL_CONST uint kShadowCube = 2u;      // six views along +x, -x, +y, -y, +z, -z of render space
CL_CONST uint kShadowCascades = 3u;  // from fine to coarse; the last one has all of the scene
struct ShadowLight {
  uint kind;
  uint firstView;
  uint viewCount;
  float radius;  // for soft shadows: scene units, of parallel light radians
};

// Where a draw's mirror image comes from: the background, the picture of a flat mirror (of the band, as the mirror
// shows it: column x of the picture is column width - 1 - x of what is drawn), or a cube of six faces of size * size
// pixels, along +x, -x, +y, -y, +z, -z. A face along s e_a has e_b to its right and -s e_c up, (a, b, c) a turn of (x,
// y, z); one pixel all around belongs to its neighbors.
struct Reflector {
  uint kind;
  uint firstTexel;
  uint size;
  vec3 center;  // of the cube; render space
  vec3 lower;   // what the cube shows is taken to lie on this box; render space
  vec3 upper;
};
CL_CONST uint kReflectorBackground = 0u;
CL_CONST uint kReflectorPicture = 1u;
CL_CONST uint kReflectorCube = 2u;

// Passes that draw a view.
struct ShadowPush {
  uint view;
  uint firstTriangle;
  uint materialId;
  uint drawFlags;  // kDraw*
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
