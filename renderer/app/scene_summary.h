// A scene in figures and names, for `info` and records.
#pragma once

#include <cstdint>
#include <string>

#include "app/record.h"
#include "scene/scene.h"

namespace crosslight {

// Bytes of vertices, indices and decoded images on the host.
std::uint64_t hostBytesOf(const Scene& scene);

std::string sceneTable(const Scene& scene);
Json sceneJson(const Scene& scene);

}  // namespace crosslight
