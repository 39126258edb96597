// OSMesa (OpenGL without a window, the same llvmpipe rasterizer below) as a peer of the raster methods. Without OSMesa
// the same names are there (osmesa_absent.cpp) and say so.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace crosslight::bench {

bool osmesaAvailable();

// A mesh with one classic Blinn-Phong material under one point light, as the fixed function knows them. The viewer is
// at the origin.
struct GlScene {
  std::span<const glm::vec3> positions, normals;
  std::span<const std::uint32_t> indices;
  glm::mat4 glClipFromRender{1.0f};
  glm::vec3 sceneAmbient{0.0f};
  glm::vec3 ka{0.0f}, kd{0.0f}, ks{0.0f};
  float shininess = 0;
  glm::vec3 lightPosition{0.0f}, lightDiffuse{1.0f}, lightSpecular{1.0f}, lightAttenuation{1.0f, 0.0f, 0.0f};
};

enum class GlShading {
  flat,     // fixed function, first vertex provokes
  gouraud,  // fixed function
  phong,    // GLSL: the same formula at every fragment
};

// RGBA of the frames: 8 bits per channel, as most users of OSMesa have them, or 32-bit floats, as ours are.
enum class GlPixels { bytes, floats };

// One at a time, on one thread: the one made or asked for a frame last is current.
class OsmesaPeer {
 public:
  OsmesaPeer(const GlScene& scene, std::uint32_t width, std::uint32_t height, GlPixels format);
  ~OsmesaPeer();

  std::string renderer() const;  // GL_RENDERER and GL_VERSION
  // Clear, draw and finish; milliseconds of wall time.
  double frame(GlShading shading);
  // Of the last frame: RGBA in [0, 1], row 0 on top.
  std::vector<glm::vec4> pixels() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace crosslight::bench
