// Buffers, buffer views and accessors: every range must lie inside what it cuts from, in 64 bits, before a byte of it
// is touched.
#include <fmt/format.h>

#include <algorithm>

#include "scene/gltf_document.h"

namespace crosslight::gltf {
namespace {

// Offsets add up to at most 2^54 and strides times counts to 2^40: nothing here can wrap in 64 bits.
constexpr std::int64_t kMaxCount = (std::int64_t{1} << 32) - 1;  // vertices have 32-bit indices

void validateBuffers(const JsonAt& root) {
  const auto buffers = root.find("buffers");
  if (!buffers) return;
  for (const JsonAt& buffer : buffers->items()) {
    buffer.at("byteLength").integer(1);
    if (const auto uri = buffer.find("uri")) uri->string();
  }
}

void validateRange(const JsonAt& view, const JsonAt& source, const Document& document) {
  const std::size_t buffer = source.at("buffer").reference(document.count("buffers"), "buffer");
  const std::int64_t offset = integerOr(source, "byteOffset", 0);
  const std::int64_t length = source.at("byteLength").integer(1);
  const std::int64_t available = document.entry("buffers", buffer).at("byteLength").integer();
  if (offset + length > available) {
    view.fail(
        fmt::format("bytes [{}, {}) lie outside buffer {} of {} bytes", offset, offset + length, buffer, available));
  }
}

// EXT_meshopt_compression, "Specifying compressed views".
void validateMeshopt(const JsonAt& view, const JsonAt& compressed, const Document& document) {
  validateRange(compressed, compressed, document);
  const std::int64_t stride = compressed.at("byteStride").integer(1, 256);
  const std::int64_t count = compressed.at("count").integer(1, kMaxCount);
  const std::string mode = compressed.at("mode").oneOf({"ATTRIBUTES", "TRIANGLES", "INDICES"});
  const auto filterAt = compressed.find("filter");
  const std::string filter = filterAt ? filterAt->oneOf({"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}) : "NONE";
  if (mode == "ATTRIBUTES" ? stride % 4 != 0 : (stride != 2 && stride != 4)) {
    compressed.fail(fmt::format("byteStride {} does not go with mode {}", stride, mode));
  }
  if (mode == "TRIANGLES" && count % 3 != 0) compressed.fail(fmt::format("count {} is no multiple of 3", count));
  const bool fits = filter == "NONE" || (mode == "ATTRIBUTES" && (filter == "OCTAHEDRAL"   ? stride == 4 || stride == 8
                                                                  : filter == "QUATERNION" ? stride == 8
                                                                                           : true));
  if (!fits) compressed.fail(fmt::format("filter {} does not go with mode {} and byteStride {}", filter, mode, stride));
  const std::int64_t decoded = stride * count;
  if (view.at("byteLength").integer() != decoded) {
    view.fail(fmt::format("byteLength must be byteStride * count of its compressed data, {}", decoded));
  }
}

void validateView(const JsonAt& view, const Document& document) {
  validateRange(view, view, document);
  const auto stride = view.find("byteStride");
  const std::int64_t target = integerOr(view, "target", 0);
  if (stride) {
    if (stride->integer(4, 252) % 4 != 0)
      stride->fail(fmt::format("must be a multiple of 4, is {}", stride->integer()));
    if (stride->integer() > view.at("byteLength").integer()) stride->fail("is larger than the view's byteLength");
    if (target == 34963) stride->warn("is not allowed on a view of indices");
  }
  if (target != 0 && target != 34962 && target != 34963) view.at("target").warn("is none of the known targets");
  if (const auto compressed = view.extension("EXT_meshopt_compression")) validateMeshopt(view, *compressed, document);
}

// One part of an accessor (its elements, its sparse indices or values) against the view that holds it.
struct Part {
  std::int64_t offset = 0;
  std::int64_t count = 0;
  std::int64_t bytesEach = 0;
  std::int64_t alignment = 1;
};

void validatePart(const JsonAt& at, const JsonAt& view, const Part& part, bool mayStride) {
  const std::int64_t stride = mayStride ? integerOr(view, "byteStride", part.bytesEach) : part.bytesEach;
  if (!mayStride && view.find("byteStride")) at.fail("its view must not have a byteStride");
  if (stride < part.bytesEach)
    at.fail(fmt::format("elements of {} bytes overlap at a stride of {}", part.bytesEach, stride));
  const std::int64_t start = integerOr(view, "byteOffset", 0) + part.offset;
  if (part.offset % part.alignment != 0 || start % part.alignment != 0 || stride % part.alignment != 0) {
    at.fail(fmt::format("offset {} (in the buffer: {}) or stride {} is no multiple of {} bytes", part.offset, start,
                        stride, part.alignment));
  }
  const std::int64_t end = part.offset + stride * (part.count - 1) + part.bytesEach;
  const std::int64_t available = view.at("byteLength").integer();
  if (end > available) at.fail(fmt::format("needs {} bytes of its view, which has {}", end, available));
}

void validateSparse(const JsonAt& sparse, const Part& elements, const Document& document) {
  constexpr std::int64_t kMaxInt = std::numeric_limits<int>::max();  // what tinygltf keeps these numbers in
  const std::int64_t count = sparse.at("count").integer(1, std::min(elements.count, kMaxInt));
  const auto viewOf = [&](const JsonAt& part) {
    return document.entry("bufferViews", part.at("bufferView").reference(document.count("bufferViews"), "bufferView"));
  };
  const JsonAt indices = sparse.at("indices");
  const std::int64_t type = indices.at("componentType").integer();
  if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt) {
    indices.at("componentType").fail(fmt::format("must be 5121, 5123 or 5125, is {}", type));
  }
  const auto bytes = static_cast<std::int64_t>(componentBytes(type));
  validatePart(indices, viewOf(indices), {integerOr(indices, "byteOffset", 0, kMaxInt), count, bytes, bytes}, false);
  const JsonAt values = sparse.at("values");
  validatePart(values, viewOf(values),
               {integerOr(values, "byteOffset", 0, kMaxInt), count, elements.bytesEach, elements.alignment}, false);
}

void validateAccessor(const JsonAt& accessor, const Document& document) {
  const std::string& type = accessor.at("type").string();
  const std::int64_t component = accessor.at("componentType").integer();
  if (componentCount(type) == 0) accessor.at("type").fail("'" + type + "' is no accessor type");
  if (componentBytes(component) == 0)
    accessor.at("componentType").fail(fmt::format("{} is no component type", component));
  const auto alignment =
      static_cast<std::int64_t>(type.starts_with("MAT") ? std::size_t{4} : componentBytes(component));
  const Part elements{integerOr(accessor, "byteOffset", 0), accessor.at("count").integer(1, kMaxCount),
                      static_cast<std::int64_t>(elementBytes(type, component)), alignment};
  if (booleanOr(accessor, "normalized", false) && (component == kFloat || component == kUnsignedInt)) {
    accessor.at("normalized").warn("has no meaning for this componentType");
  }
  for (const char* bound : {"min", "max"}) {
    if (const auto numbers = accessor.find(bound)) numbers->numbers(componentCount(type));
  }
  const int view = referenceOr(accessor, "bufferView", document.count("bufferViews"), "bufferView");
  if (view >= 0) {
    validatePart(accessor, document.entry("bufferViews", static_cast<std::size_t>(view)), elements, true);
  } else if (accessor.find("byteOffset")) {
    accessor.at("byteOffset").warn("has no meaning without a bufferView");
  }
  if (const auto sparse = accessor.find("sparse")) validateSparse(*sparse, elements, document);
}

}  // namespace

std::size_t componentCount(const std::string& accessorType) {
  if (accessorType == "SCALAR") return 1;
  if (accessorType == "VEC2") return 2;
  if (accessorType == "VEC3") return 3;
  if (accessorType == "VEC4" || accessorType == "MAT2") return 4;
  if (accessorType == "MAT3") return 9;
  if (accessorType == "MAT4") return 16;
  return 0;
}

std::size_t componentBytes(std::int64_t componentType) {
  switch (componentType) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

std::size_t elementBytes(const std::string& accessorType, std::int64_t componentType) {
  const std::size_t each = componentBytes(componentType);
  if (!accessorType.starts_with("MAT")) return componentCount(accessorType) * each;
  const std::size_t columns = accessorType == "MAT2" ? 2 : accessorType == "MAT3" ? 3 : 4;
  return columns * ((columns * each + 3) / 4 * 4);
}

void validateData(const Document& document) {
  const JsonAt root = document.root();
  validateBuffers(root);
  if (const auto views = root.find("bufferViews")) {
    for (const JsonAt& view : views->items()) validateView(view, document);
  }
  if (const auto accessors = root.find("accessors")) {
    for (const JsonAt& accessor : accessors->items()) validateAccessor(accessor, document);
  }
}

}  // namespace crosslight::gltf
