// Slots of descriptor set 0, the same for every shader, and the ids of the specialisation constants.
#ifndef CROSSLIGHT_SHARED_BINDINGS_H
#define CROSSLIGHT_SHARED_BINDINGS_H
#include "types.h"

// What a scene may call for beyond its models, lights and shapes: X(bit, name). Analysis gives each a reason;
// a bit that is off removes the code from every pipeline.
#define CL_EFFECTS(X)            \
  X(0, baseColorTexture)         \
  X(1, metallicRoughnessTexture) \
  X(2, normalMap)                \
  X(3, occlusionTexture)         \
  X(4, emissiveTexture)          \
  X(5, vertexColors)             \
  X(6, alphaMask)                \
  X(7, transparency)             \
  X(8, twoSided)                 \
  X(9, shadows)                  \
  X(10, reflection)              \
  X(11, refraction)              \
  X(12, absorption)              \
  X(13, shapes)                  \
  X(14, triangles)               \
  X(15, turnedShapes)            \
  X(16, fog)                     \
  X(17, smoke)                   \
  X(18, environment)             \
  X(19, softShadows)             \
  X(20, dispersion)              \
  X(21, nestedMedia)             \
  X(22, coloredShadows)          \
  X(23, bumpMap)                 \
  X(24, clearcoat)               \
  X(25, sheen)                   \
  X(26, anisotropy)              \
  X(27, iridescence)             \
  X(28, diffuseTransmission)     \
  X(29, mipmaps)

// The same, beyond the 32 bits of the first word: X(bit of the plan, name); shaders ask for them by CL_HAS_TOO.
#define CL_MORE_EFFECTS(X)   \
  X(32, specularLayer)       \
  X(33, transmissionTexture) \
  X(34, diffuseRoughness)    \
  X(35, angularSpecular)     \
  X(36, exactFresnel)        \
  X(37, energyCompensation)  \
  X(38, volumeScatter)

CL_SHARED_BEGIN
CL_CONST uint kBindFrame = 0;            // uniform FrameRecord
CL_CONST uint kBindMaterials = 1;        // MaterialRecord[]
CL_CONST uint kBindLights = 2;           // LightRecord[]
CL_CONST uint kBindDraws = 3;            // DrawRecord[]
CL_CONST uint kBindPositions = 4;        // texel buffer, RGBA32UI: vec3[], render space, packed
CL_CONST uint kBindAttributes = 5;       // texel buffer, RGBA32F, 4 per vertex
CL_CONST uint kBindIndices = 6;          // texel buffer, RGBA32UI: uint[3 * triangles], packed
CL_CONST uint kBindShapes = 7;           // ShapeRecord[]
CL_CONST uint kBindTexels = 8;           // texel buffer, RGBA32F, linear
CL_CONST uint kBindBvhNodes = 9;         // texel buffer, RGBA32UI, 4 per node
CL_CONST uint kBindBvhPrimitives = 10;   // texel buffer, RGBA32UI, 3 per primitive
CL_CONST uint kBindRays = 11;            // RayRecord[]
CL_CONST uint kBindHits = 12;            // HitRecord[], one per ray
CL_CONST uint kBindVisibility = 13;      // float[nodes of the level * lights of the batch]
CL_CONST uint kBindCounters = 14;        // uint[kCounterCount]
CL_CONST uint kBindSampleColor = 15;     // vec4[pixels of the band]: one sample of the picture
CL_CONST uint kBindAovs = 16;            // AovRecord[pixels of the band], or one dummy
CL_CONST uint kBindFilm = 17;            // FilmPixel[pixels of the band]
CL_CONST uint kBindFilmParts = 18;       // FilmParts[pixels of the band], or one dummy
CL_CONST uint kBindWideNodes = 19;       // texel buffer, RGBA32UI, 16 per node
CL_CONST uint kBindMaterialTexels = 20;  // the records once more, as RGBA32UI texels: one load brings 16 bytes
CL_CONST uint kBindLightTexels = 21;
CL_CONST uint kBindDrawTexels = 22;
CL_CONST uint kBindShapeTexels = 23;
CL_CONST uint kBindHitTexels = 24;  // kBindHits, kBindRays, kBindRayNodes, to be read: RGBA32UI
CL_CONST uint kBindRayTexels = 25;
CL_CONST uint kBindNodeTexels = 26;
CL_CONST uint kBindRayNodes = 27;   // RayNode[], one per ray
CL_CONST uint kBindRest = 28;       // groups whose packet gave up, behind the dispatch arguments that count them
CL_CONST uint kBindQuadNodes = 29;  // texel buffer, RGBA32UI, 4 per node
CL_CONST uint kBindQueues = 30;  // hits of the level by class: arguments of indirect dispatches, then rays of the level
CL_CONST uint kBindHitClasses = 31;         // texel buffer, RGBA32UI, one per material: class as a mesh's, as a shape's
CL_CONST uint kBindInstances = 32;          // texel buffer, RGBA32UI, 5 per InstanceRecord
CL_CONST uint kBindInstanceTriangles = 33;  // texel buffer, RGBA32UI, 2 per InstanceTriangle
CL_CONST uint kBindShapeBoxes = 34;     // texel buffer, RGBA32UI, 2 per bounded shape, in fours: lower and upper corner
CL_CONST uint kBindTriangleBoxes = 35;  // acceleration structure, a box per triangle: of family ray-query
CL_CONST uint kBindTileList = 72;       // uint texels: tiles of the band that get a sample; kVariantTiles
CL_CONST uint kBindActiveTiles = 73;    // uint[tiles of the band]: 1 where the tile is in that list
CL_CONST uint kBindTileErrors = 74;     // float[tiles of the band]
CL_CONST uint kBindMoments = 75;        // PixelMoments[pixels of the band]
CL_CONST uint kBindEnvironment = 55;    // texel buffer, RGBA32F: see shaders/shade/environment.glsl
CL_CONST uint kBindMedia = 53;          // uvec4 per ray node: the bodies that the ray is in (trace/media.glsl)
CL_CONST uint kMostMedia = 8u;          // at once
CL_CONST uint kBindSmokeGrid = 54;      // texel buffer, RGBA32F: densities, four to a texel
CL_CONST uint kBindAlbedoTables = 60;   // texel buffer, RGBA32F: shaders/illum/albedo.glsl
CL_CONST int kAlbedoTableSize = 32;
// Set in a pixel of the film's codes whose color is finite.
CL_CONST uint kFiniteCode = 0xff000000u;

// Specialisation constants; their defaults in the shaders are "everything".
CL_CONST uint kSpecModels = 0;        // bit i: illumination model i may occur
CL_CONST uint kSpecLights = 1;        // bit i: light type i may occur
CL_CONST uint kSpecShapes = 2;        // bit i: shape kind i may occur
CL_CONST uint kSpecEffects = 3;       // bits of CL_EFFECTS
CL_CONST uint kSpecVariant = 4;       // of one shader; documented there
CL_CONST uint kSpecMoreEffects = 50;  // bits of CL_MORE_EFFECTS, less 32
// Of raster methods (bit 0) and of accumulate.
CL_CONST uint kVariantClampVertexColors = 1u;
CL_CONST uint kVariantFilmParts = 1u;    // FilmParts too
CL_CONST uint kVariantActiveTiles = 2u;  // only active tiles, and moments
// Of the kernels of rays, of which one may have several.
CL_CONST uint kVariantOrthographic = 2u;   // rays of the camera do not begin at one point
CL_CONST uint kVariantManyLights = 4u;     // lights come in several batches
CL_CONST uint kVariantRest = 8u;           // only the groups that kBindRest lists
CL_CONST uint kVariantAovs = 16u;          // shade: the primary level writes AovRecords
CL_CONST uint kVariantTree = 32u;          // surfaces send rays on, nodes are kept
CL_CONST uint kVariantQueue = 64u;         // only the rays in the queue of TracePush::hitClass
CL_CONST uint kVariantFewShapes = 128u;    // a list of the shapes' boxes instead of a tree
CL_CONST uint kVariantSharedLoads = 256u;  // subgroups of 8 lanes may load together
CL_CONST uint kVariantInstances = 512u;    // instances share trees; hits name flattened triangles
CL_CONST uint kVariantTiles = 4096u;       // only the tiles of kBindTileList
CL_CONST uint kMostBoxedShapes = 32u;      // bounded ones at most for kVariantFewShapes: one bit each

// kBindQueues: per class kQueueWords, the three of an indirect dispatch and how many there are; then per class as many
// words as there are nodes, rays by their place in the level.
CL_CONST uint kHitClasses = 4u;
CL_CONST uint kQueueWords = 4u;
CL_CONST uint kRaysPerGroup = 64u;      // that a workgroup of every kernel of rays works on, but for
CL_CONST uint kClassifiedPerLane = 4u;  // classify, whose lanes have several

// The list at kBindRest: the three words of an indirect dispatch, one unused, then the groups.
CL_CONST uint kRestGroups = 4u;

// Counters that shaders add to.
CL_CONST uint kCounterRayNodes = 0;  // ray nodes allocated
CL_CONST uint kCounterOverflow = 1;  // ray nodes that found no room
CL_CONST uint kCounterShadowRays = 2;
CL_CONST uint kCounterReflection = 3;
CL_CONST uint kCounterRefraction = 4;
CL_CONST uint kCounterPassThrough = 5;
CL_CONST uint kCounterNonfinite = 6;
CL_CONST uint kCounterFirstNonfinite = 7;  // 2^32 - 1 - (first image pixel whose sample is not finite); 0: none
CL_CONST uint kCounterCapped = 8;          // traversals that met the stack's or the loop's limit
CL_CONST uint kCounterGaveUp = 9;          // packets that left their rays to be done one by one
CL_CONST uint kCounterMediaLost = 10;      // rays that entered more bodies at once than are kept
CL_CONST uint kCounterCount = 16;

// A ray that is stored: mirrored, refracted or passed on, at the place of its node. Camera rays are computed where they
// are needed. Three texels.
struct RayRecord {
  vec3 origin;  // render space
  float tMin;
  vec3 direction;  // camera rays: component along cameraForward is 1, so t is the depth; others unit
  float tMax;
  uint from;    // BVH slot of the triangle that the ray leaves; kNoHit: none, or a shape
  uint medium;  // material that the ray travels in, or kNoRayNode for the surrounding
  uint kind;    // kRay*
  uint depth;   // rays before it
};
CL_SIZE(RayRecord, 48)

// What comes back along a ray. Three texels; kept only when the plan's surfaces send rays on.
struct RayNode {
  vec3 value;             // radiance; once gathered with the children's and times the weight
  float alpha;            // coverage of what the ray meets
  vec3 weight;            // share of the value in the parent's
  float travelled;        // scene units through fog before the ray's origin: of the rays that it goes straight on from
  uint reflected;         // node of the reflected child, or kNoRayNode
  uint transmitted;       // node of the refracted or straight-through child, or kNoRayNode
  float path;             // with mipmaps: length of the light's way from the camera to the ray's origin
  uint transmittedCount;  // with dispersion: 1, or 3 nodes from `transmitted` on, for red, green and blue
};
CL_SIZE(RayNode, 48)
CL_CONST uint kNoRayNode = 0xffffffffu;
CL_CONST uint kNoPixel = 0xffffffffu;
CL_CONST uint kTileSize = 8u;  // pixels: camera rays are listed tile by tile
CL_CONST uint kRayPrimary = 0u;
CL_CONST uint kRayReflection = 1u;
CL_CONST uint kRayRefraction = 2u;
CL_CONST uint kRayPassThrough = 3u;  // straight on from the camera
CL_CONST uint kRayOnward = 4u;       // straight on from a mirrored or refracted ray

struct HitRecord {
  float t;         // in units of the ray's direction
  uint primitive;  // slot in the BVH's primitive list, or kHitShape | shape index; kNoHit
  float b1;        // barycentric coordinates of the triangle's second and third corner
  float b2;
};
CL_SIZE(HitRecord, 16)
CL_CONST uint kNoHit = 0xffffffffu;
CL_CONST uint kHitShape = 0x80000000u;

// Compensated sums over the samples of a pixel (Kahan 1965): sum - compensation is closer to the exact sum.
struct FilmPixel {
  vec4 sum;
  vec4 compensation;
};
CL_SIZE(FilmPixel, 32)

// The AOVs that are averaged, summed over the samples.
struct FilmParts {
  vec3 albedo;
  vec3 ambient;
  vec3 diffuse;
  vec3 specular;
  vec3 emission;
};
CL_SIZE(FilmParts, 60)

// Of a pixel's samples: the first, and how the others deviate from it.
struct PixelMoments {
  vec3 first;
  vec3 sum;
  vec3 squares;
};
CL_SIZE(PixelMoments, 36)

// Push constants of the compute kernels.
struct TracePush {
  uint firstNode;     // of the level; 0: the camera's rays
  uint nodeCount;     // of the level
  uint firstLight;    // of the batch
  uint lightCount;    // of the batch
  uint lightInBatch;  // shadow: which one
  uint firstRow;      // of the band, in the image
  uint bandRows;
  uint firstInTiles;  // generate: first ray of the chunk, in the band's tile order
  uint nodeCapacity;
  uint maxDepth;
  uint hitClass;       // whose queue is worked on
  uint smokeStep;      // smoke: which one, of the light lightInBatch
  uint shadowChannel;  // shadow: 0..2, the color whose share is looked for
};
struct FilmPush {
  uint pixelCount;
  uint firstPixel;
  uint firstSample;  // 1: start the sums, do not add to them
  float weight;      // of the sample
  uint width;        // of the band, for tiles
  uint samples;      // so far
};
CL_SHARED_END

#ifdef __cplusplus
namespace crosslight {
#define CL_EFFECT_ROW(bit, name) name = bit,
enum class Effect : std::uint32_t { CL_EFFECTS(CL_EFFECT_ROW) CL_MORE_EFFECTS(CL_EFFECT_ROW) };
#undef CL_EFFECT_ROW
}  // namespace crosslight
#endif
#endif
