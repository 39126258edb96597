// `--lighting opengl`: the parameters of OpenGL 1.x's fixed function as one set of ours (glLight, glMaterial,
// glLightModel, glShadeModel, glFog), at the values that a new context has.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight {

// Colors of vertices are clamped before they are interpolated (2.13.6), flat shading takes the last vertex (2.13.7),
// the viewer is infinite (GL_LIGHT_MODEL_LOCAL_VIEWER is off: --set viewer=local), fog goes by eye depth and leaves the
// background alone (3.10, as Mesa has it). GL_LIGHT_MODEL_TWO_SIDE is a material's doubleSided, or --set
// two-sided=always; global and per-light ambient, attenuation, spot exponent and cutoff are the scene's own.
void lightAsOpenGl(RenderSettings& settings);

// What of a scene the fixed function has no word for, and what is drawn instead; one sentence per object.
std::vector<std::string> unlikeOpenGl(const Scene& scene, const RenderSettings& settings);

}  // namespace crosslight
