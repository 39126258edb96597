// Records that the host writes and the shaders read (or the other way round). Lengths in scene units (meters for
// glTF), angles in radians, colors linear Rec.709. "render space" is world space moved so that the camera stands at
// the origin, computed in double on the host: nothing here loses precision far from the world's origin.
#ifndef CROSSLIGHT_SHARED_STRUCTS_H
#define CROSSLIGHT_SHARED_STRUCTS_H
#include "types.h"

CL_SHARED_BEGIN

// One vertex as lighting needs it; its render-space position is in a buffer of its own (BVH and raster share it).
// Four RGBA32F texels: shaders read it as a texel buffer, which may be sixteen times a storage buffer on llvmpipe.
struct VertexAttributes {
  vec3 renderNormal;  // unit, or zero when the source had none that can be used
  float unused;
  vec4 renderTangent;  // xyz unit, w = handedness of the bitangent (+1 or -1); all zero: none
  vec2 uv0;
  vec2 uv1;
  vec4 color;  // linear RGBA, multiplies the base color; 1 when the mesh has none
};
CL_SIZE(VertexAttributes, 64)

// Materials, lights, draws and shapes are read as storage buffers where the index is the same for a whole draw, and as
// RGBA32UI texel buffers by kernels (scene_bindings.glsl takes them apart): hence whole texels.

// One primitive of one mesh instance (raster: one draw), or one analytic shape.
struct DrawRecord {
  uint firstTriangle;  // in the flattened triangle list
  uint triangleCount;
  uint materialId;
  uint instanceId;     // index of the node instance; a shape and its fallback mesh share it
  uint primitiveBase;  // added to the triangle's index within this record to give the primitive id of the AOVs
  uint flags;          // kDraw*
  uint unused0;
  uint unused1;
};
CL_SIZE(DrawRecord, 32)
CL_CONST uint kDrawFlipsWinding = 1u;  // the node's transform mirrors: front faces are clockwise
CL_CONST uint kDrawHasColors = 2u;     // else the color is 1 exactly, which interpolation need not give back

CL_CONST uint kNoTexture = 0xffffffffu;

// A texture as a material refers to it: where its texels are, how coordinates reach it, how they wrap and filter.
struct TextureSlot {
  uint firstTexel;  // in the texel buffer; kNoTexture: the slot is empty
  uint width;
  uint height;
  uint flags;       // kTexture*
  vec4 uvFromUvXy;  // column-major 2x2 part of KHR_texture_transform
  vec2 uvOffset;
};
CL_SIZE(TextureSlot, 40)
CL_CONST uint kTextureUv1 = 1u;         // reads uv1 instead of uv0
CL_CONST uint kTextureNearest = 2u;     // magnification filter NEAREST (else LINEAR)
CL_CONST uint kTextureWrapShiftU = 2u;  // two bits: 0 repeat, 1 mirrored repeat, 2 clamp to edge
CL_CONST uint kTextureWrapShiftV = 4u;

// Textures of material layers by their place in MaterialRecord::layerTextures, each with the channels that count.
CL_CONST uint kLayerSpecular = 0u;            // A
CL_CONST uint kLayerSpecularTint = 1u;        // RGB
CL_CONST uint kLayerClearcoat = 2u;           // R
CL_CONST uint kLayerClearcoatRoughness = 3u;  // G
CL_CONST uint kLayerClearcoatNormal = 4u;     // RGB
CL_CONST uint kLayerSheenColor = 5u;          // RGB
CL_CONST uint kLayerSheenRoughness = 6u;      // A
CL_CONST uint kLayerAnisotropy = 7u;          // RG direction, B strength
CL_CONST uint kLayerIridescence = 8u;         // R
CL_CONST uint kLayerFilmThickness = 9u;       // G
CL_CONST uint kLayerTransmitted = 10u;        // A: diffuse transmission
CL_CONST uint kLayerTransmittedColor = 11u;   // RGB
CL_CONST uint kLayerTransmission = 12u;       // R
CL_CONST uint kLayerDiffuseRoughness = 13u;   // R
CL_CONST uint kLayerTextures = 14u;

// All models read this record; `model` says which fields count. Ranges are those of glTF unless said otherwise.
struct MaterialRecord {
  uint model;      // CL_ILLUMINATION_MODELS
  uint flags;      // kMaterial*
  vec4 baseColor;  // cookTorrance, unlit: linear RGBA. Classic models: (1,1,1, opacity)
  float metallic;
  float perceptualRoughness;
  vec3 ambientColor;   // ka, classic models
  vec3 diffuseColor;   // kd, classic models
  vec3 specularColor;  // ks, classic models
  float shininess;     // n >= 0, classic models
  vec3 emission;       // radiance (or the classic model's unitless emission), strength included
  float alphaCutoff;
  float normalScale;
  float occlusionStrength;
  float transmission;            // share of light that passes, 0..1: KHR_materials_transmission or the classic kt
  float indexOfRefraction;       // >= 1; 0 means "infinite F0" as KHR_materials_ior says
  vec3 mirror;                   // kr of the classic models: weight of the reflected ray (no Fresnel term)
  vec3 attenuationColor;         // KHR_materials_volume, per attenuationDistance
  float attenuationDistance;     // <= 0: no absorption
  uint unused;                   // textures begin in the middle of a texel: five texels hold two
  TextureSlot baseColorTexture;  // classic: multiplies ka and kd
  TextureSlot metallicRoughnessTexture;
  TextureSlot normalTexture;
  TextureSlot occlusionTexture;
  TextureSlot emissiveTexture;
  float priority;    // nestedMedia: the highest counts where bodies overlap
  float dispersion;  // KHR_materials_dispersion: 20 / Abbe number
  uint unused1, unused2;

  // Read only where the effect that needs them is on.
  float roughnessAngle;      // orenNayar: standard deviation of the facets' slope angle, radians; cookTorrance1982: m
  float diffuseRoughness;    // KHR_materials_diffuse_roughness, 0..1
  float clearcoat;           // KHR_materials_clearcoat, as the following three
  float clearcoatRoughness;  // perceptual
  vec3 refractiveIndex;      // cookTorrance1982: n of n + ik, with kMaterialIndexed
  float clearcoatNormalScale;
  vec3 extinction;       // k of n + ik
  float specularFactor;  // KHR_materials_specular
  vec3 specularTint;     // its color factor
  float sheenRoughness;  // KHR_materials_sheen, perceptual
  vec3 sheenColor;
  float anisotropy;  // KHR_materials_anisotropy: strength
  vec3 diffuseTransmissionColor;
  float diffuseTransmission;  // KHR_materials_diffuse_transmission
  vec2 anisotropyDirection;   // cosine and sine of the rotation
  float iridescence;          // KHR_materials_iridescence, as the following three
  float filmIndex;
  float filmThinnest;  // nanometers
  float filmThickest;
  float bumpFactor;  // EXT_materials_bump: scene units of height per texel value
  uint spare;
  TextureSlot layerTextures[kLayerTextures];
  TextureSlot bumpTexture;  // R
  uint unused3, unused4;    // slots come in pairs, of which the second begins in the middle of a texel
  vec3 scatterAlbedo;  // KHR_materials_volume_scatter: share of the extinction that is scattering, of single scattering
  float scatterAnisotropy;  // g of Henyey and Greenstein 1941, -1..1
  uint unused5, unused6, unused7, unused8;
};
CL_SIZE(MaterialRecord, 1120)
CL_CONST uint kMaterialTexels = 70u;
CL_CONST int kBodyTexel = 21;     // the one that holds `priority` and `dispersion`
CL_CONST int kScatterTexel = 68;  // the one that holds `scatterAlbedo` and `scatterAnisotropy`
CL_CONST uint kMaterialDoubleSided = 1u;
CL_CONST uint kMaterialAlphaMask = 2u;
CL_CONST uint kMaterialAlphaBlend = 4u;
CL_CONST uint kMaterialMirror = 8u;  // sends a reflected ray in whitted
CL_CONST uint kMaterialRefracts =
    16u;                              // sends a refracted ray in whitted (KHR_materials_transmission or kt with an ior)
CL_CONST uint kMaterialThin = 32u;    // no volume: the transmitted ray goes straight on
CL_CONST uint kMaterialVolume = 64u;  // KHR_materials_volume is present
CL_CONST uint kMaterialAngularSpecular = 65536u;  // ks is W(0); W(theta) rises to 1 at grazing angles
CL_CONST uint kMaterialIndexed = 131072u;         // refractiveIndex and extinction count
CL_CONST uint kMaterialSpecularLayer = 524288u;   // KHR_materials_specular is present
CL_CONST uint kMaterialCoatMirrors = 262144u;     // the clear coat, not the base, sends the mirrored ray

// One light. Classic lights keep separate ambient, diffuse and specular intensities; glTF lights put the same
// candela (point, spot), lux (directional) or radiance (area) into diffuse and specular and nothing into ambient.
struct LightRecord {
  uint type;            // CL_LIGHT_TYPES
  uint flags;           // kLight*
  vec3 renderPosition;  // point, spot; center of a rectangle, disk or sphere; first corner of a triangle
  vec3 direction;       // unit, the way the light travels: directional, spot; area: the middle of it
  vec3 ambient;
  vec3 diffuse;
  vec3 specular;
  vec3 attenuation;    // kc, kl, kq of 1 / (kc + kl d + kq d^2); d in scene units
  float range;         // glTF: window ends here; <= 0: unbounded
  float innerVersine;  // spot: 1 - cos(angle), which keeps the digits of narrow cones
  float outerVersine;  // spot: beyond it nothing
  float spotExponent;  // classic spot: max(-L.D, 0)^exponent
  vec3 areaU;          // half edge of a rectangle, edge of a triangle; areaU x areaV points against `direction`
  vec3 areaV;
  float areaRadius;  // disk, sphere
  uint unused;
};
CL_SIZE(LightRecord, 128)
CL_CONST uint kAreaLightTypes = 0x78u;  // bits of CL_LIGHT_TYPES: diffuse and specular are radiance, without falloff
CL_CONST uint kLightClassic = 1u;   // attenuation and exponent as OpenGL has them; else inverse square and smooth cone
CL_CONST uint kLightTwoSided = 2u;  // rectangle, disk, triangle: radiates to both sides

// A shape of the ray tracer; object space as in CL_SHAPE_KINDS.
struct ShapeRecord {
  uint kind;
  uint drawId;            // DrawRecord that carries its ids and material
  vec3 renderCenter;      // image of the object space's origin
  mat3 renderFromObject;  // linear part, column-major
  mat3 objectFromRender;
  vec4 params;  // sphere: radius; disk: radius; box: size xyz; cylinder, cone: radius, height; torus: center circle's
                // radius, tube's radius
  uint flags;   // kPrimitive*
};
CL_SIZE(ShapeRecord, 112)

// Everything that is constant for one sample of one frame.
struct FrameRecord {
  mat4 clipFromRender;  // reversed Z, y down as Vulkan has it, sample offset included
  vec3 cameraRight;     // unit, render space
  vec3 cameraUp;        // unit
  vec3 cameraForward;   // unit
  vec2 imagePlaneHalf;  // perspective: (tan(xfov/2), tan(yfov/2)); orthographic: half sizes in scene units
  vec2 sampleOffset;    // within the pixel, [0,1)^2; (0.5, 0.5) is its center
  float zNear;          // distance along cameraForward
  float zFar;           // infinity: none
  uint orthographic;    // 0 or 1
  uint infiniteViewer;  // 1: V is the same for every point (OpenGL's default): -cameraForward
  uvec2 resolution;     // pixels
  uint lightCount;
  uint unboundedShapeCount;  // planes: the first ones in the shape list, outside the BVH
  uint boundedShapeCount;    // the others
  uint shapeRoot;            // node at which the shapes' tree begins; the triangles' begins at 0
  uint twoSided;             // 1: light and show both sides of every surface
  uint meshDrawCount;        // DrawRecords of triangles: the first ones
  vec3 ambient;              // Ia
  vec3 background;           // covered by the fog where that reaches it
  vec3 fogColor;
  uint fogMode;           // kFog*
  float fogScale;         // exp, exp2: density per scene unit; linear: 1 / (end - start)
  float fogEnd;           // linear: distance from which on nothing else is seen
  uint fogByDepth;        // 1: by the distance along cameraForward, as OpenGL has it; 0: along the ray
  uint sampleIndex;       // of the picture's samples
  uint sampleSeed;        // of all random numbers
  uint lightSamples;      // shadow rays to a light with an area, and into the environment
  uvec2 environmentSize;  // texels of the map
  vec2 environmentTurn;   // cosine and sine of its rotation about +Y
  float environmentGain;  // radiance of a texel of 1
  uint smokeKind;         // kSmoke*
  vec3 smokeCenter;       // render space
  vec3 smokeHalfSize;     // of the box; of the sphere: its radius, three times
  vec3 smokeAbsorption;   // per scene unit, where the density is 1
  vec3 smokeScattering;
  vec3 smokeAround;       // radiance from all around that smoke scatters
  float smokeAnisotropy;  // g of Henyey and Greenstein 1941, -1..1
  uint smokeGridX;        // densities along each axis; 0: the density is 1 all over
  uint smokeGridY;
  uint smokeGridZ;
  uint smokeSteps;          // along the part of a ray that lies in smoke
  uint smokeSeed;           // of the places within them that are looked at; 0: their middles
  uvec4 cameraMedia;        // the bodies that the camera is in, as kBindMedia has them
  uint cameraMedium;        // material of the one that counts; kNoId: none
  uint optics;              // kOptics*
  uint fresnel;             // kFresnel*
  uint energyCompensation;  // 1: what single scattering on microfacets loses is added
};
CL_SIZE(FrameRecord, 368)
// What changes how light goes through bodies: by the scene or by request, so a pipeline with everything must ask.
CL_CONST uint kOpticsNestedMedia = 1u;
CL_CONST uint kOpticsDispersion = 2u;
CL_CONST uint kOpticsColoredShadows = 4u;
CL_CONST uint kSmokeNone = 0u;
CL_CONST uint kSmokeEverywhere = 1u;
CL_CONST uint kSmokeBox = 2u;
CL_CONST uint kSmokeSphere = 3u;
CL_CONST uint kFogNone = 0u;
CL_CONST uint kFogLinear = 1u;
CL_CONST uint kFogExp = 2u;
CL_CONST uint kFogExp2 = 3u;
CL_CONST uint kFresnelOfModel = 0u;  // glTF: Schlick; cookTorrance1982 and W(theta): exact
CL_CONST uint kFresnelSchlick = 1u;
CL_CONST uint kFresnelExact = 2u;

// What is known about the surface seen through a pixel's center. Written by raster and by rays alike.
struct AovRecord {
  float depth;           // distance along cameraForward; 0 where nothing was hit
  vec3 position;         // render space
  vec3 normal;           // shading normal, unit, faces the viewer on two-sided surfaces
  vec3 geometricNormal;  // of the triangle or shape, the same side
  vec3 albedo;           // base color or kd, textures and vertex color included
  vec2 uv;               // uv0
  uint instanceId;       // kNoId where nothing was hit
  uint primitiveId;
  uint materialId;
  vec3 ambient;
  vec3 diffuse;
  vec3 specular;
  vec3 emission;
};
CL_SIZE(AovRecord, 120)
CL_CONST uint kNoId = 0xffffffffu;

// BVH2 node: both children's boxes in the parent, 64 bytes = four RGBA32F texels, read as texels by the shaders.
struct BvhNode {
  vec3 lower0;
  uint child0;  // inner: index of a node; leaf: kBvhLeaf | (count << kBvhCountShift) | first primitive
  vec3 upper0;
  uint child1;
  vec3 lower1;
  uint splitAxis;  // 0..2: child0 lies on the lower side
  vec3 upper1;
  uint parent;  // kNoId at the root
};
CL_SIZE(BvhNode, 64)
CL_CONST uint kBvhLeaf = 0x80000000u;
CL_CONST uint kBvhCountShift = 27u;  // 4 bits: 1..15 primitives
CL_CONST uint kBvhFirstMask = 0x07ffffffu;
CL_CONST uint kBvhStackSize = 64u;  // depth that the shaders' stack holds; the builder never exceeds it

// Child of a wide node, 32 bytes = two RGBA32UI texels. Eight of them are a node: child i of node n is texels 16 n + 2
// i and the next. References are those of BvhNode (inner: index of a wide node); an empty child is kBvhLeaf.
struct WideChild {
  vec3 lower;
  uint child;
  vec3 upper;
  uint unused;
};
CL_SIZE(WideChild, 32)
CL_CONST uint kWideChildren = 8u;
CL_CONST uint kWideDepth = 32u;  // inner nodes on a path that the packets' stack has room for; else narrow kernels run

// Node with four children whose boxes are bytes on a grid of the node's own: 64 bytes = four texels for twice the boxes
// of a BvhNode. Plane i of an axis lies at origin + 2^(exponent - 127) * byte, rounded once; planes lie outside of the
// exact ones or on them. Byte i of a word is child i's; an empty child is kBvhLeaf.
struct QuadNode {
  vec3 origin;
  uint exponents;  // bits 0..7 x, 8..15 y, 16..23 z
  uint lowerX;
  uint lowerY;
  uint lowerZ;
  uint upperX;
  uint upperY;
  uint upperZ;
  uint unused0;
  uint unused1;
  uint child0;
  uint child1;
  uint child2;
  uint child3;
};
CL_SIZE(QuadNode, 64)

// Primitive of the BVH in leaf order, 48 bytes = three RGBA32F texels. A triangle holds its corners; a shape only its
// id.
struct BvhPrimitive {
  vec3 v0;
  uint id;  // triangle index, or kPrimitiveIsShape | shape index
  vec3 v1;
  uint drawId;
  vec3 v2;
  uint flags;  // kPrimitive*
};
CL_SIZE(BvhPrimitive, 48)
// Trees that instances share: the root is the tree of instances, in render space; its leaves hold one instance each, an
// index into this list. A ray goes on in the instance's object space through the tree of its mesh.
struct InstanceRecord {
  vec4 objectFromRenderX;  // row of the affine map: x = dot(row.xyz, p) + row.w
  vec4 objectFromRenderY;
  vec4 objectFromRenderZ;
  vec3 margin;  // by which boxes are widened, for a ray that begins at zero: see shaders/accel/instances.glsl
  uint root;    // node at which the mesh's tree begins
  uint firstVertex;
  uint firstTriangle;
  uint firstDraw;
  uint flags;  // kPrimitive*, of all its triangles
};
CL_SIZE(InstanceRecord, 80)

// Triangle of a shared tree, in leaf order: vertices, triangle and primitive count from the instance's first ones.
struct InstanceTriangle {
  uint i0;
  uint i1;
  uint i2;
  uint triangle;   // kPrimitive* << kTriangleFlagShift | triangle
  uint primitive;  // of the mesh, those without triangles left out
  uint unused0;
  uint unused1;
  uint unused2;
};
CL_SIZE(InstanceTriangle, 32)
CL_CONST uint kTriangleFlagShift = 29u;
CL_CONST uint kTriangleMask = 0x07ffffffu;

CL_CONST uint kPrimitiveIsShape = 0x80000000u;
CL_CONST uint kPrimitiveCutsBackFaces = 1u;  // primary rays pass through its back (single-sided material)
CL_CONST uint kPrimitiveMayPass = 2u;        // alpha mask, blending or transmission: an occlusion test must look closer
CL_CONST uint kPrimitiveFlipsWinding = 4u;

CL_SHARED_END
#endif
