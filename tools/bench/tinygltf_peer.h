// tinygltf by itself, as a peer of the scene loader.
#pragma once

#include <filesystem>

namespace crosslight::bench {

// Parses a .gltf file and its buffers; images are not decoded. The number of accessors, so that the work has a result.
std::size_t parseWithTinygltf(const std::filesystem::path& file);

}  // namespace crosslight::bench
