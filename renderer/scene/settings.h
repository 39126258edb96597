// What the user asks of a render, apart from the scene: plain values that every room above may read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace crosslight {

enum class Method { wireframe, flat, gouraud, phong, whitted };
enum class FlatVertex { first, last, centroid };           // where flat shading evaluates lighting
enum class PixelFilter { box, tent, gaussian, mitchell };  // radius 0.5, 1, 1.5 (sigma 0.5) and 2 pixels
enum class Sampler { sobol, regular, jittered };           // where samples lie within a pixel
// Of the ray kernels: same hits, other speed.
enum class KernelFamily { automatic, perLane, packet, rayQuery };
enum class InstanceMode { automatic, flatten, share };  // trees of instances (rays): same hits
enum class HitQueues { automatic, on, off };            // of hits by what their surfaces ask for: same image
enum class DepthPrepass { automatic, on, off };         // phong: same image, other speed
enum class FogDistance { ray, depth };                  // what fog goes by: the way of the light, or eye depth
enum class RasterShadows { off, maps, rays };           // of flat, gouraud and phong: none, from depth maps, exact
enum class Dispersion { off, rgb };                     // of refracted rays: one, or one for each of three colors
enum class Fresnel { ofModel, schlick, exact };         // of surfaces under direct light, as kFresnel*
// Mirrors of flat, gouraud and phong: not shown; the background alone; by cube maps; flat ones drawn, others by cube
// maps.
enum class RasterReflections { off, environment, probes, mirrors };
enum class TwoSided { material, always };          // per material (glTF's doubleSided), or everything
enum class EmissiveLights { off, on, automatic };  // surfaces that glow light others; automatic: without lights

// Of RasterShadows::maps.
struct ShadowMapSettings {
  std::uint32_t size = 1024;     // texels a side: of a spot's map, of each face of a point light's cube, of a cascade
  std::uint32_t cascades = 3;    // maps of a directional light
  std::uint32_t filterSize = 3;  // texels a side that are averaged: 1, 3 or 5
  bool soft = false;             // penumbras as wide as the lights' radius makes them
  double lightRadius = 0.0;      // scene units, of lights without a size of their own; directional: radians

  bool operator==(const ShadowMapSettings&) const = default;
};

// An effect, model, light type or shape kind by its name in the lists of shaders/shared/.
struct ForcedEffect {
  std::string name;
  bool on = false;  // compiled in, whether called for or not; else left out

  bool operator==(const ForcedEffect&) const = default;
};

struct RenderSettings {
  Method method = Method::phong;
  std::uint32_t width = 512;
  std::uint32_t height = 512;
  int camera = 0;         // index into Scene::cameras
  std::uint32_t spp = 1;  // samples per pixel, the same sub-pixel positions in raster and rays; 1: the pixel's center
  PixelFilter filter = PixelFilter::box;
  Sampler sampler = Sampler::sobol;
  // Standard error of a channel's mean at which a tile of 8 x 8 pixels gets no more samples; 0: spp for all.
  float adaptiveError = 0;
  std::uint32_t msaa = 1;        // raster only: coverage samples 1, 2, 4, 8
  bool shadesPerSample = false;  // raster with msaa: light every coverage sample, not the pixel once
  std::uint32_t maxDepth = 5;    // whitted: ray segments after the primary one; 0 is direct light only
  std::uint64_t seed = 0;
  KernelFamily kernel = KernelFamily::automatic;     // rays only
  InstanceMode instances = InstanceMode::automatic;  // rays only
  HitQueues hitQueues = HitQueues::automatic;        // rays only
  DepthPrepass depthPrepass = DepthPrepass::automatic;
  bool shadows = true;     // whitted
  bool reflection = true;  // whitted
  bool refraction = true;  // whitted; off: transmitted light goes straight on
  RasterShadows rasterShadows = RasterShadows::off;
  ShadowMapSettings shadowMaps;
  RasterReflections rasterReflections = RasterReflections::off;
  std::uint32_t probeSize = 256;    // pixels along an edge of a probe's cube
  std::uint32_t lightSamples = 16;  // whitted: rays to a light with an area; 0: one to its middle
  EmissiveLights emissiveLights = EmissiveLights::off;
  double environmentRotation = 0.0;   // degrees, added to the scene's
  double environmentIntensity = 1.0;  // multiplies the scene's
  bool infiniteViewer = false;
  FogDistance fogDistance = FogDistance::ray;  // depth: as OpenGL, whose fog leaves the background alone
  TwoSided twoSided = TwoSided::material;
  Fresnel fresnel = Fresnel::ofModel;
  std::uint32_t displacementLevel = 4;  // every edge of a displaced mesh is split into 2^n, unless displacementEdge
  float displacementEdge = 0.0f;        // pixels: edges are split until none is longer on the screen; 0: by the level
  bool energyCompensation = false;      // of GGX: what one scattering event loses on rough surfaces is added
  FlatVertex flatVertex = FlatVertex::first;
  bool hiddenLines = false;                 // wireframe: draw hidden edges too
  bool clampVertexColors = false;           // gouraud and flat: as OpenGL's fixed function does; AOVs are unclamped
  Dispersion dispersion = Dispersion::off;  // whitted
  bool coloredShadows = false;              // whitted: transparent things tint what passes through them
  std::uint32_t smokeSteps = 32;            // along the part of a ray that lies in smoke
  std::uint64_t maxLayerBytes = 1u << 28;   // raster: for transparent fragments; more than fit are drawn in fewer rows
  bool allEffects = false;                  // compile and run everything instead of what the scene calls for
  std::vector<ForcedEffect> forcedEffects;  // of two on one effect the last counts
  // Linear radiance per channel and pixel that the image may be off by proven bounds for effects to be left out; 0:
  // leaving one out changes no bit.
  double effectsWithin = 0.0;
  bool allowNonfinite = false;    // NaN and Inf in the result are reported but do not fail the run
  std::vector<std::string> aovs;  // names of kAovNames

  bool operator==(const RenderSettings&) const = default;
};

// AOVs that raster and rays both deliver, in this order in every file. Point samples at the pixel's center but for
// the four parts of direct light and the albedo, which are averaged over the samples as the picture is.
inline constexpr const char* kAovNames[] = {"depth",   "position",   "normal",      "geometricNormal", "albedo",
                                            "uv",      "instanceId", "primitiveId", "materialId",      "ambient",
                                            "diffuse", "specular",   "emission"};

}  // namespace crosslight
