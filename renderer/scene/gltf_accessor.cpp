// Elements of accessors as floats or integers. The ranges were validated against the declared lengths; they are
// checked once more against the bytes that are there, because compression replaced some.
#include <tiny_gltf.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "scene/gltf_model.h"

namespace crosslight::gltf {
namespace {

struct Elements {
  const unsigned char* bytes = nullptr;  // null: zeros
  std::size_t stride = 0;
  std::size_t count = 0;
};

struct Layout {
  std::size_t components = 0;
  std::size_t componentBytes = 0;
  std::size_t columnRows = 0;   // components between two paddings
  std::size_t columnBytes = 0;  // with padding
  std::size_t elementBytes = 0;
};

std::string typeName(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return "SCALAR";
    case TINYGLTF_TYPE_VEC2:
      return "VEC2";
    case TINYGLTF_TYPE_VEC3:
      return "VEC3";
    case TINYGLTF_TYPE_VEC4:
      return "VEC4";
    case TINYGLTF_TYPE_MAT2:
      return "MAT2";
    case TINYGLTF_TYPE_MAT3:
      return "MAT3";
    default:
      return "MAT4";
  }
}

Layout layoutOf(const tinygltf::Accessor& accessor) {
  const std::string type = typeName(accessor.type);
  Layout layout;
  layout.components = componentCount(type);
  layout.componentBytes = componentBytes(accessor.componentType);
  layout.elementBytes = elementBytes(type, accessor.componentType);
  const std::size_t columns = type == "MAT2" ? 2 : type == "MAT3" ? 3 : type == "MAT4" ? 4 : 1;
  layout.columnRows = layout.components / columns;
  layout.columnBytes = layout.elementBytes / columns;
  return layout;
}

Elements elementsOf(const Source& source, int view, std::size_t offset, std::size_t count, std::size_t bytesEach,
                    const JsonAt& at) {
  if (view < 0) return {nullptr, 0, count};
  const tinygltf::BufferView& range = source.model.bufferViews[static_cast<std::size_t>(view)];
  const auto& data = source.model.buffers[static_cast<std::size_t>(range.buffer)].data;
  const std::size_t stride = range.byteStride == 0 ? bytesEach : range.byteStride;
  const std::size_t end = offset + stride * (count - 1) + bytesEach;
  if (end > range.byteLength || range.byteOffset + end > data.size()) at.fail("has no bytes behind it");
  return {data.data() + range.byteOffset + offset, stride, count};
}

template <class T>
T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));  // little-endian like the file
  return value;
}
static_assert(std::endian::native == std::endian::little);

// glTF 2.0, "Animations": the inverse of how floats become normalized integers.
float component(const unsigned char* bytes, int type, bool normalized) {
  switch (type) {
    case kByte: {
      const auto value = static_cast<float>(load<std::int8_t>(bytes));
      return normalized ? std::fmax(value / 127.0f, -1.0f) : value;
    }
    case kUnsignedByte: {
      const auto value = static_cast<float>(load<std::uint8_t>(bytes));
      return normalized ? value / 255.0f : value;
    }
    case kShort: {
      const auto value = static_cast<float>(load<std::int16_t>(bytes));
      return normalized ? std::fmax(value / 32767.0f, -1.0f) : value;
    }
    case kUnsignedShort: {
      const auto value = static_cast<float>(load<std::uint16_t>(bytes));
      return normalized ? value / 65535.0f : value;
    }
    case kUnsignedInt:
      return static_cast<float>(load<std::uint32_t>(bytes));
    default:
      return load<float>(bytes);
  }
}

std::uint32_t unsignedComponent(const unsigned char* bytes, int type) {
  switch (type) {
    case kUnsignedByte:
      return load<std::uint8_t>(bytes);
    case kUnsignedShort:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

std::vector<std::uint32_t> sparseIndices(const Source& source, const tinygltf::Accessor& accessor, const JsonAt& at) {
  const int type = accessor.sparse.indices.componentType;
  const Elements elements = elementsOf(source, accessor.sparse.indices.bufferView,
                                       static_cast<std::size_t>(accessor.sparse.indices.byteOffset),
                                       static_cast<std::size_t>(accessor.sparse.count), componentBytes(type), at);
  std::vector<std::uint32_t> indices(elements.count);
  for (std::size_t i = 0; i < elements.count; ++i) {
    indices[i] = unsignedComponent(elements.bytes + i * elements.stride, type);
    if (indices[i] >= accessor.count || (i > 0 && indices[i] <= indices[i - 1])) {
      at.fail("its sparse indices must rise and stay below its count");
    }
  }
  return indices;
}

// Calls store(element, bytes) for every element that has bytes, sparse ones last.
template <class Store>
void forEachElement(const Source& source, std::size_t index, const JsonAt& at, const Store& store) {
  const tinygltf::Accessor& accessor = source.model.accessors[index];
  const Layout layout = layoutOf(accessor);
  const Elements base =
      elementsOf(source, accessor.bufferView, accessor.byteOffset, accessor.count, layout.elementBytes, at);
  if (base.bytes != nullptr) {
    for (std::size_t i = 0; i < base.count; ++i) store(i, base.bytes + i * base.stride);
  }
  if (!accessor.sparse.isSparse) return;
  const std::vector<std::uint32_t> indices = sparseIndices(source, accessor, at.at("sparse").at("indices"));
  const Elements values =
      elementsOf(source, accessor.sparse.values.bufferView, static_cast<std::size_t>(accessor.sparse.values.byteOffset),
                 indices.size(), layout.elementBytes, at.at("sparse").at("values"));
  for (std::size_t i = 0; i < indices.size(); ++i) store(indices[i], values.bytes + i * values.stride);
}

}  // namespace

std::vector<float> readFloats(const Source& source, std::size_t index, std::size_t components, float fill) {
  const tinygltf::Accessor& accessor = source.model.accessors[index];
  const JsonAt at = source.document.entry("accessors", index);
  const Layout layout = layoutOf(accessor);
  source.document.budget.charge(accessor.count * components * sizeof(float), at);
  std::vector<float> flat(accessor.count * components, 0.0f);
  const std::size_t present = std::min(components, layout.components);
  for (std::size_t i = 0; i < accessor.count; ++i) {
    for (std::size_t c = present; c < components; ++c) flat[i * components + c] = fill;
  }
  forEachElement(source, index, at, [&](std::size_t element, const unsigned char* bytes) {
    for (std::size_t c = 0; c < present; ++c) {
      const std::size_t offset =
          c / layout.columnRows * layout.columnBytes + c % layout.columnRows * layout.componentBytes;
      flat[element * components + c] = component(bytes + offset, accessor.componentType, accessor.normalized);
    }
  });
  return flat;
}

std::vector<std::uint32_t> readIntegers(const Source& source, std::size_t index) {
  const tinygltf::Accessor& accessor = source.model.accessors[index];
  const JsonAt at = source.document.entry("accessors", index);
  const Layout layout = layoutOf(accessor);
  source.document.budget.charge(accessor.count * layout.components * sizeof(std::uint32_t), at);
  std::vector<std::uint32_t> flat(accessor.count * layout.components, 0);
  forEachElement(source, index, at, [&](std::size_t element, const unsigned char* bytes) {
    for (std::size_t c = 0; c < layout.components; ++c) {
      flat[element * layout.components + c] =
          unsignedComponent(bytes + c * layout.componentBytes, accessor.componentType);
    }
  });
  return flat;
}

std::vector<float> readFinite(const Source& source, std::size_t index, std::size_t components, float fill) {
  std::vector<float> flat = readFloats(source, index, components, fill);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (!std::isfinite(flat[i])) {
      source.document.entry("accessors", index)
          .fail("element " + std::to_string(i / components) + " is not a finite number");
    }
  }
  return flat;
}

}  // namespace crosslight::gltf
