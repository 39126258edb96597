#include "oracle/fixed_function.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>

#include <GL/glext.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <stdexcept>
#include <string>

namespace crosslight::testing {
namespace {

class Context {
 public:
  Context(std::uint32_t width, std::uint32_t height) : pixels_(std::size_t{width} * height) {
    const int attributes[] = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 32, OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, 0};
    context_ = OSMesaCreateContextAttribs(attributes, nullptr);
    const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height);
    if (!context_ || !OSMesaMakeCurrent(context_, pixels_.data(), GL_FLOAT, w, h)) {
      throw std::runtime_error("OSMesa has no float RGBA context with depth");
    }
    glViewport(0, 0, w, h);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { OSMesaDestroyContext(context_); }

  // What has been drawn, from the top row down.
  std::vector<std::array<float, 4>> pixels(std::uint32_t width) const {
    glFinish();
    std::vector<std::array<float, 4>> rows;
    for (std::size_t end = pixels_.size(); end > 0; end -= width) {
      rows.insert(rows.end(), pixels_.begin() + static_cast<std::ptrdiff_t>(end - width),
                  pixels_.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return rows;
  }

 private:
  OSMesaContext context_ = nullptr;
  std::vector<std::array<float, 4>> pixels_;  // OpenGL's order: from the bottom row up
};

std::array<float, 4> rgba(const glm::vec3& v) { return {v.x, v.y, v.z, 1.0f}; }

// The camera stands at the origin of what OpenGL calls world, so that float matrices lose nothing far from ours.
void setCamera(const Camera& camera, const FixedFunctionSettings& s) {
  const double aspect = static_cast<double>(s.width) / s.height;
  const double halfY = std::tan(0.5 * camera.yFov), n = camera.zNear;
  glm::dmat4 clipFromEye(0.0);
  clipFromEye[0][0] = 1.0 / (halfY * aspect);
  clipFromEye[1][1] = 1.0 / halfY;
  clipFromEye[2][2] = camera.zFar ? -(*camera.zFar + n) / (*camera.zFar - n) : -1.0;
  clipFromEye[2][3] = -1.0;
  clipFromEye[3][2] = camera.zFar ? -2.0 * *camera.zFar * n / (*camera.zFar - n) : -2.0 * n;
  const glm::dmat4 eyeFromRender(glm::transpose(glm::dmat3(camera.worldFromCamera)));
  glMatrixMode(GL_PROJECTION);
  glLoadMatrixd(glm::value_ptr(clipFromEye));
  glMatrixMode(GL_MODELVIEW);
  glLoadMatrixd(glm::value_ptr(eyeFromRender));
}

void setLight(GLenum id, const Light& light, const glm::dvec3& origin) {
  const ClassicLight& c = light.classic.value();
  const bool directional = light.type == LightType::directional;
  const glm::vec3 place(directional ? -light.worldDirection : light.worldPosition - origin);
  const glm::vec3 direction(light.worldDirection);
  const std::array<float, 4> position{place.x, place.y, place.z, directional ? 0.0f : 1.0f};
  glEnable(id);
  glLightfv(id, GL_POSITION, position.data());
  glLightfv(id, GL_SPOT_DIRECTION, glm::value_ptr(direction));
  glLightfv(id, GL_AMBIENT, rgba(c.ambient).data());
  glLightfv(id, GL_DIFFUSE, rgba(c.diffuse).data());
  glLightfv(id, GL_SPECULAR, rgba(c.specular).data());
  glLightf(id, GL_CONSTANT_ATTENUATION, c.attenuation.x);
  glLightf(id, GL_LINEAR_ATTENUATION, c.attenuation.y);
  glLightf(id, GL_QUADRATIC_ATTENUATION, c.attenuation.z);
  if (light.type != LightType::spot) return;
  glLightf(id, GL_SPOT_CUTOFF, c.spotCutoff);
  glLightf(id, GL_SPOT_EXPONENT, c.spotExponent);
}

void setLighting(const Scene& scene, const FixedFunctionSettings& s, const glm::dvec3& origin) {
  glEnable(GL_LIGHTING);
  glShadeModel(s.flat ? GL_FLAT : GL_SMOOTH);
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, rgba(scene.atmosphere.ambient).data());
  glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, s.localViewer ? GL_TRUE : GL_FALSE);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    setLight(GL_LIGHT0 + static_cast<GLenum>(i), scene.lights[i], origin);
  }
}

void setFog(const Atmosphere& a) {
  if (a.fogMode == FogMode::none) return;
  glEnable(GL_FOG);
  glHint(GL_FOG_HINT, GL_NICEST);
  glFogi(GL_FOG_MODE, a.fogMode == FogMode::linear ? GL_LINEAR : (a.fogMode == FogMode::exp ? GL_EXP : GL_EXP2));
  glFogfv(GL_FOG_COLOR, rgba(a.fogColor).data());
  glFogf(GL_FOG_START, static_cast<float>(a.fogStart));
  glFogf(GL_FOG_END, static_cast<float>(a.fogEnd));
  glFogf(GL_FOG_DENSITY, static_cast<float>(a.fogDensity));
}

void setMaterial(const Material& m) {
  const bool glossy = m.model == IlluminationModel::blinnPhong;  // OpenGL's only model; Lambert is it without ks
  if (!glossy && m.model != IlluminationModel::lambert) throw std::runtime_error("OpenGL has no model like this");
  glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, rgba(m.classic.ambientFactor).data());
  glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, rgba(m.classic.diffuseFactor).data());
  glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, rgba(glossy ? m.classic.specularFactor : glm::vec3(0.0f)).data());
  glMaterialfv(GL_FRONT_AND_BACK, GL_EMISSION, rgba(m.emissiveFactor * m.emissiveStrength).data());
  glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, glossy ? m.classic.shininess : 0.0f);
}

void setSides(const Material& m) {
  glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, m.doubleSided ? GL_TRUE : GL_FALSE);
  if (m.doubleSided) {
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
  }
}

// Triangles carry their number as a color of three bytes when `numbered`.
void drawTriangles(const Scene& scene, const glm::dvec3& origin, bool numbered) {
  std::uint32_t triangle = 0;
  for (const MeshInstance& instance : scene.instances) {
    const glm::dmat3 normals = glm::transpose(glm::inverse(glm::dmat3(instance.worldFromObject)));
    for (const Primitive& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
      const Material& material = scene.materials[static_cast<std::size_t>(p.material)];
      setMaterial(material);
      setSides(material);
      glBegin(GL_TRIANGLES);
      for (std::size_t i = 0; i < p.indices.size(); ++i) {
        if (i % 3 == 0 && numbered) {
          glColor3ub(static_cast<GLubyte>(triangle), static_cast<GLubyte>(triangle >> 8),
                     static_cast<GLubyte>(triangle >> 16));
        }
        triangle += i % 3 == 0;
        const glm::dvec3 n = glm::normalize(normals * glm::dvec3(p.normals[p.indices[i]]));
        const glm::dvec4 at = instance.worldFromObject * glm::dvec4(p.positions[p.indices[i]], 1.0);
        const glm::dvec3 v = glm::dvec3(at) - origin;
        glNormal3d(n.x, n.y, n.z);
        glVertex3d(v.x, v.y, v.z);
      }
      glEnd();
    }
  }
}

std::uint32_t numberOf(const std::array<float, 4>& color) {
  std::uint32_t number = 0;
  for (std::size_t c = 0; c < 3; ++c) number |= static_cast<std::uint32_t>(std::lround(color[c] * 255.0f)) << (8 * c);
  return number;
}

void clear(const std::array<float, 4>& color) {
  glClearColor(color[0], color[1], color[2], color[3]);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace

FixedFunctionImage drawFixedFunction(const Scene& scene, const FixedFunctionSettings& settings) {
  const Context context(settings.width, settings.height);
  const Camera& camera = scene.cameras.at(0);
  const glm::dvec3 origin(camera.worldFromCamera[3]);
  const GLenum clamped = settings.clampColors ? GL_TRUE : GL_FALSE;
  glClampColor(GL_CLAMP_VERTEX_COLOR, clamped);
  glClampColor(GL_CLAMP_FRAGMENT_COLOR, clamped);
  glEnable(GL_DEPTH_TEST);
  setCamera(camera, settings);
  setLighting(scene, settings, origin);
  setFog(scene.atmosphere);
  FixedFunctionImage image;
  clear({0.0f, 0.0f, 0.0f, 0.0f});
  drawTriangles(scene, origin, false);
  image.color = context.pixels(settings.width);
  glDisable(GL_LIGHTING);
  glDisable(GL_FOG);
  glShadeModel(GL_FLAT);
  clear({1.0f, 1.0f, 1.0f, 0.0f});  // kNoTriangle
  drawTriangles(scene, origin, true);
  for (const std::array<float, 4>& pixel : context.pixels(settings.width)) image.triangle.push_back(numberOf(pixel));
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
    throw std::runtime_error("OpenGL error " + std::to_string(error));
  }
  return image;
}

}  // namespace crosslight::testing
