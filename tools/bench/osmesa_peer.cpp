#include "bench/osmesa_peer.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
// After osmesa.h, which includes gl.h.
#include <GL/glext.h>
#include <fmt/format.h>

#include <glm/vec4.hpp>

#include "base/check.h"
#include "base/time.h"

namespace crosslight::bench {
namespace {

constexpr const char* kVertexShader = R"(#version 120
varying vec3 position;
varying vec3 normal;
void main() {
  position = gl_Vertex.xyz;
  normal = gl_Normal;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
})";

// The fixed function's own state and formula (OpenGL 2.1, 2.14.1), per fragment.
constexpr const char* kFragmentShader = R"(#version 120
varying vec3 position;
varying vec3 normal;
void main() {
  vec3 n = normalize(normal);
  vec3 toLight = gl_LightSource[0].position.xyz - position;
  float d = length(toLight);
  vec3 wi = toLight / d;
  vec3 h = normalize(wi - normalize(position));
  float fade = 1.0 / (gl_LightSource[0].constantAttenuation + d * (gl_LightSource[0].linearAttenuation +
                                                                   d * gl_LightSource[0].quadraticAttenuation));
  float NoL = max(dot(n, wi), 0.0);
  float shine = NoL > 0.0 ? pow(max(dot(n, h), 0.0), gl_FrontMaterial.shininess) : 0.0;
  vec3 color = gl_FrontLightModelProduct.sceneColor.rgb +
               fade * (gl_FrontLightProduct[0].diffuse.rgb * NoL + gl_FrontLightProduct[0].specular.rgb * shine);
  gl_FragColor = vec4(color, 1.0);
})";

GLuint compiled(GLenum stage, const char* text) {
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  CL_CHECK(good != 0);
  return shader;
}

GLuint phongProgram() {
  const GLuint program = glCreateProgram();
  glAttachShader(program, compiled(GL_VERTEX_SHADER, kVertexShader));
  glAttachShader(program, compiled(GL_FRAGMENT_SHADER, kFragmentShader));
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  CL_CHECK(good != 0);
  return program;
}

template <class T>
void uploadBuffer(GLenum target, std::span<const T> items) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(items.size_bytes()), items.data(), GL_STATIC_DRAW);
}

void setLighting(const GlScene& s) {
  const auto four = [](const glm::vec3& v) { return glm::vec4(v, 1.0f); };
  const glm::vec4 black(0.0f, 0.0f, 0.0f, 1.0f);
  glEnable(GL_LIGHTING);
  glEnable(GL_LIGHT0);
  glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, 1);
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, &four(s.sceneAmbient)[0]);
  glLightfv(GL_LIGHT0, GL_POSITION, &four(s.lightPosition)[0]);
  glLightfv(GL_LIGHT0, GL_AMBIENT, &black[0]);
  glLightfv(GL_LIGHT0, GL_DIFFUSE, &four(s.lightDiffuse)[0]);
  glLightfv(GL_LIGHT0, GL_SPECULAR, &four(s.lightSpecular)[0]);
  glLightf(GL_LIGHT0, GL_CONSTANT_ATTENUATION, s.lightAttenuation.x);
  glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, s.lightAttenuation.y);
  glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, s.lightAttenuation.z);
  glMaterialfv(GL_FRONT, GL_AMBIENT, &four(s.ka)[0]);
  glMaterialfv(GL_FRONT, GL_DIFFUSE, &four(s.kd)[0]);
  glMaterialfv(GL_FRONT, GL_SPECULAR, &four(s.ks)[0]);
  glMaterialfv(GL_FRONT, GL_EMISSION, &black[0]);
  glMaterialf(GL_FRONT, GL_SHININESS, s.shininess);
}

}  // namespace

bool osmesaAvailable() { return true; }

struct OsmesaPeer::Impl {
  OSMesaContext context = nullptr;
  std::uint32_t width = 0, height = 0;
  GlPixels format = GlPixels::bytes;
  std::vector<std::uint8_t> bytes;
  std::vector<glm::vec4> floats;
  GLuint program = 0;
  GLsizei indexCount = 0;

  void makeCurrent() {
    const bool isFloat = format == GlPixels::floats;
    void* pixels = isFloat ? static_cast<void*>(floats.data()) : bytes.data();
    CL_CHECK(OSMesaMakeCurrent(context, pixels, isFloat ? GL_FLOAT : GL_UNSIGNED_BYTE, static_cast<GLsizei>(width),
                               static_cast<GLsizei>(height)) != 0);
  }
};

OsmesaPeer::OsmesaPeer(const GlScene& scene, std::uint32_t width, std::uint32_t height, GlPixels format)
    : impl_(std::make_unique<Impl>()) {
  constexpr GLint kDepthBits = 24;
  impl_->width = width, impl_->height = height, impl_->format = format;
  const std::size_t count = std::size_t{width} * height;
  if (format == GlPixels::bytes) impl_->bytes.resize(4 * count);
  if (format == GlPixels::floats) impl_->floats.resize(count);
  impl_->context = OSMesaCreateContextExt(OSMESA_RGBA, kDepthBits, 0, 0, nullptr);
  CL_CHECK(impl_->context != nullptr);
  impl_->makeCurrent();
  OSMesaPixelStore(OSMESA_Y_UP, 0);
  glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  glMatrixMode(GL_PROJECTION);
  glLoadMatrixf(&scene.glClipFromRender[0][0]);
  glMatrixMode(GL_MODELVIEW);  // stays the identity: render space is the eye's
  setLighting(scene);
  uploadBuffer(GL_ARRAY_BUFFER, scene.positions);
  glVertexPointer(3, GL_FLOAT, sizeof(glm::vec3), nullptr);
  uploadBuffer(GL_ARRAY_BUFFER, scene.normals);
  glNormalPointer(GL_FLOAT, sizeof(glm::vec3), nullptr);
  uploadBuffer(GL_ELEMENT_ARRAY_BUFFER, scene.indices);
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_NORMAL_ARRAY);
  impl_->indexCount = static_cast<GLsizei>(scene.indices.size());
  impl_->program = phongProgram();
  CL_CHECK_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

OsmesaPeer::~OsmesaPeer() { OSMesaDestroyContext(impl_->context); }

std::string OsmesaPeer::renderer() const {
  return fmt::format("{}, OpenGL {}", reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                     reinterpret_cast<const char*>(glGetString(GL_VERSION)));
}

double OsmesaPeer::frame(GlShading shading) {
  impl_->makeCurrent();
  const Stopwatch watch;
  glUseProgram(shading == GlShading::phong ? impl_->program : 0);
  glShadeModel(shading == GlShading::flat ? GL_FLAT : GL_SMOOTH);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDrawElements(GL_TRIANGLES, impl_->indexCount, GL_UNSIGNED_INT, nullptr);
  glFinish();
  const double ms = watch.elapsedMs();
  CL_CHECK_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  return ms;
}

std::vector<glm::vec4> OsmesaPeer::pixels() const {
  if (impl_->format == GlPixels::floats) return impl_->floats;
  std::vector<glm::vec4> pixels;
  for (std::size_t i = 0; i + 3 < impl_->bytes.size(); i += 4) {
    const auto channel = [&](std::size_t c) { return static_cast<float>(impl_->bytes[i + c]) / 255.0f; };
    pixels.emplace_back(channel(0), channel(1), channel(2), channel(3));
  }
  return pixels;
}

}  // namespace crosslight::bench
