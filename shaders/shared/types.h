// What lets one header be compiled by the host (GLM types) and by GLSL: nothing else lives here.
// Layout rule: every buffer that holds these structs is declared `scalar`, so the host's packing is the device's.
#ifndef CROSSLIGHT_SHARED_TYPES_H
#define CROSSLIGHT_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#define CL_SHARED_BEGIN          \
  namespace crosslight::shared { \
  using uint = std::uint32_t;    \
  using glm::ivec2;              \
  using glm::mat3;               \
  using glm::mat4;               \
  using glm::mat4x3;             \
  using glm::uvec2;              \
  using glm::uvec4;              \
  using glm::vec2;               \
  using glm::vec3;               \
  using glm::vec4;
#define CL_SHARED_END }
#define CL_CONST constexpr
#define CL_SIZE(Type, bytes) static_assert(sizeof(Type) == (bytes), #Type " must be packed as `scalar` packs it");
#else
#define CL_SHARED_BEGIN
#define CL_SHARED_END
#define CL_CONST const
#define CL_SIZE(Type, bytes)
#endif

#endif
