// The scene room holds an implementation of its own, compiled without files; this one gets another namespace.
#include "bench/tinygltf_peer.h"

#include "base/error.h"

#define tinygltf crosslight_bench_tinygltf
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

namespace crosslight::bench {

std::size_t parseWithTinygltf(const std::filesystem::path& file) {
  crosslight_bench_tinygltf::TinyGLTF loader;
  crosslight_bench_tinygltf::Model model;
  std::string error, warning;
  if (!loader.LoadASCIIFromFile(&model, &error, &warning, file.string())) throw InputError(file.string(), error);
  return model.accessors.size();
}

}  // namespace crosslight::bench
