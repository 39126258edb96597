// What stands between a hostile JPEG and stb_image 2.27, which trusts the sizes of Huffman tables.
#pragma once

#include "scene/gltf_document.h"

namespace crosslight::gltf {

// The file without comments and application segments (but for JFIF and Adobe's color transform) in front of its first
// scan: they hold arbitrary bytes, so that without them every 0xFFC4 is the begin of Huffman tables.
Bytes withoutMetadata(const Bytes& jpeg);

// Whether every Huffman table has at most 256 symbols (ITU T.81, B.2.4.2), wherever a decoder may look for one.
bool huffmanTablesFit(const Bytes& jpeg);

}  // namespace crosslight::gltf
