// Martin Newell's teapot (1975), z up, units as he had them, written by its symmetries: what is turned on the wheel is
// four quarters of one profile, handle and spout are mirror images of their half with y <= 0. Expanded, these are the
// 32 bicubic patches over 306 points that are known as the Utah teapot (bottom included).
#pragma once

#include <glm/vec3.hpp>

namespace crosslight::scenegen {

// A row of control points of a quarter turn: (r, 0), (r, -q), (q, -r), (0, -r) at height z.
struct TurnedRow {
  double r, q, z;
};

// Rim, upper body, lower body, bottom: four patches that share their end rows.
inline constexpr TurnedRow kTeapotBody[13] = {
    {1.4, 0.784, 2.4},  {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125}, {1.5, 0.84, 2.4},   {1.75, 0.98, 1.875},
    {2.0, 1.12, 1.35},  {2.0, 1.12, 0.9},         {2.0, 1.12, 0.45},        {1.5, 0.84, 0.225}, {1.5, 0.84, 0.15},
    {1.5, 0.84, 0.075}, {1.425, 0.798, 0.0},      {0.0, 0.0, 0.0}};

// Knob and lid: two patches.
inline constexpr TurnedRow kTeapotLid[7] = {{0.0, 0.0, 3.15},   {0.8, 0.45, 3.15},  {0.0, 0.0, 2.85}, {0.2, 0.112, 2.7},
                                            {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55}, {1.3, 0.728, 2.4}};

// Two patches each; a row runs around the half tube, from y = 0 over y < 0 back to y = 0.
inline constexpr glm::dvec3 kTeapotHandle[7][4] = {
    {{-1.6, 0.0, 2.025}, {-1.6, -0.3, 2.025}, {-1.5, -0.3, 2.25}, {-1.5, 0.0, 2.25}},
    {{-2.3, 0.0, 2.025}, {-2.3, -0.3, 2.025}, {-2.5, -0.3, 2.25}, {-2.5, 0.0, 2.25}},
    {{-2.7, 0.0, 2.025}, {-2.7, -0.3, 2.025}, {-3.0, -0.3, 2.25}, {-3.0, 0.0, 2.25}},
    {{-2.7, 0.0, 1.8}, {-2.7, -0.3, 1.8}, {-3.0, -0.3, 1.8}, {-3.0, 0.0, 1.8}},
    {{-2.7, 0.0, 1.575}, {-2.7, -0.3, 1.575}, {-3.0, -0.3, 1.35}, {-3.0, 0.0, 1.35}},
    {{-2.5, 0.0, 1.125}, {-2.5, -0.3, 1.125}, {-2.65, -0.3, 0.9375}, {-2.65, 0.0, 0.9375}},
    {{-2.0, 0.0, 0.9}, {-2.0, -0.3, 0.9}, {-1.9, -0.3, 0.6}, {-1.9, 0.0, 0.6}}};

inline constexpr glm::dvec3 kTeapotSpout[7][4] = {
    {{1.7, 0.0, 1.425}, {1.7, -0.66, 1.425}, {1.7, -0.66, 0.6}, {1.7, 0.0, 0.6}},
    {{2.6, 0.0, 1.425}, {2.6, -0.66, 1.425}, {3.1, -0.66, 0.825}, {3.1, 0.0, 0.825}},
    {{2.3, 0.0, 2.1}, {2.3, -0.25, 2.1}, {2.4, -0.25, 2.025}, {2.4, 0.0, 2.025}},
    {{2.7, 0.0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0.0, 2.4}},
    {{2.8, 0.0, 2.475}, {2.8, -0.25, 2.475}, {3.525, -0.25, 2.49375}, {3.525, 0.0, 2.49375}},
    {{2.9, 0.0, 2.475}, {2.9, -0.15, 2.475}, {3.45, -0.15, 2.5125}, {3.45, 0.0, 2.5125}},
    {{2.8, 0.0, 2.4}, {2.8, -0.15, 2.4}, {3.2, -0.15, 2.4}, {3.2, 0.0, 2.4}}};

}  // namespace crosslight::scenegen
