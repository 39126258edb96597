// Encoded images to pixels. Internal to the scene room.
#pragma once

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace crosslight::gltf {

// PNG and JPEG, what glTF allows. InputError when it is neither, broken, or too large to be believed.
TextureImage decodeImage(const Bytes& file, const JsonAt& at, Budget& budget);

}  // namespace crosslight::gltf
