// The open sets of the renderer. A row is the enum value, the name used in logs and on the command line, and the
// stem of the GLSL functions that the dispatch calls. Adding a row here and its one shader file adds the feature.
#ifndef CROSSLIGHT_SHARED_LISTS_H
#define CROSSLIGHT_SHARED_LISTS_H
#include "types.h"

// X(value, name, GLSL stem, what it is)
#define CL_ILLUMINATION_MODELS(X)                                                                    \
  X(0, unlit, Unlit, "the base color alone, no lighting (KHR_materials_unlit)")                      \
  X(1, lambert, Lambert, "kd (N.L)")                                                                 \
  X(2, phong, Phong, "kd (N.L) + ks (R.V)^n, Phong 1975")                                            \
  X(3, blinnPhong, BlinnPhong, "kd (N.L) + ks (N.H)^n, Blinn 1977")                                  \
  X(4, cookTorrance, CookTorrance, "glTF metallic-roughness: GGX, height-correlated Smith, Schlick") \
  X(5, modifiedPhong, ModifiedPhong, "(kd + ks (n+2)/2 (R.V)^n) (N.L), Lafortune and Willems 1994")  \
  X(6, orenNayar, OrenNayar, "rough diffuse reflection, qualitative model of Oren and Nayar 1994")   \
  X(7, cookTorrance1982, CookTorrance1982, "Beckmann, V-shaped grooves, exact Fresnel: Cook and Torrance 1982")

// X(value, name, GLSL stem, what it is)
#define CL_LIGHT_TYPES(X)                                                         \
  X(0, point, Point, "a position that radiates in all directions")                \
  X(1, directional, Directional, "parallel rays from infinity")                   \
  X(2, spot, Spot, "a position that radiates into a cone")                        \
  X(3, areaRectangle, AreaRectangle, "a parallelogram that radiates to one side") \
  X(4, areaDisk, AreaDisk, "a disk that radiates to one side")                    \
  X(5, areaSphere, AreaSphere, "a sphere that radiates outwards")                 \
  X(6, areaTriangle, AreaTriangle, "a triangle of a surface that glows")

// X(value, name, GLSL stem, what it is). Object space; ShapeRecord in structs.h has the parameters.
#define CL_SHAPE_KINDS(X)                                                              \
  X(0, sphere, Sphere, "|p| = radius")                                                 \
  X(1, plane, Plane, "y = 0, unbounded")                                               \
  X(2, disk, Disk, "y = 0, |p| <= radius")                                             \
  X(3, box, Box, "|p_i| <= size_i / 2")                                                \
  X(4, cylinder, Cylinder, "axis y, |y| <= height / 2, closed by two disks")           \
  X(5, cone, Cone, "axis y, radius at -height/2, apex at +height/2, closed by a disk") \
  X(6, torus, Torus, "axis y, radius of the center circle, radius of the tube")

// X(value, name, says where lighting is evaluated)
#define CL_SHADING_METHODS(X)                                                  \
  X(0, wireframe, "edges only, unlit")                                         \
  X(1, flat, "once per triangle, at the first or last vertex or the centroid") \
  X(2, gouraud, "once per vertex, interpolated")                               \
  X(3, phong, "once per fragment, the normal interpolated")

#ifdef __cplusplus
namespace crosslight {
#define CL_ENUM_ROW(value, name, ...) name = value,
enum class IlluminationModel : std::uint32_t { CL_ILLUMINATION_MODELS(CL_ENUM_ROW) };
enum class LightType : std::uint32_t { CL_LIGHT_TYPES(CL_ENUM_ROW) };
enum class ShapeKind : std::uint32_t { CL_SHAPE_KINDS(CL_ENUM_ROW) };
enum class ShadingMethod : std::uint32_t { CL_SHADING_METHODS(CL_ENUM_ROW) };
#undef CL_ENUM_ROW
}  // namespace crosslight
#endif
#endif
