// One batch of work for the device: record, submit, wait, read the times.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/pipeline.h"

namespace crosslight::gpu {

enum class ColorBefore { clear, keep, undefined };  // undefined: the caller draws over every pixel

// What a rendering pass draws into: the given rows, which alone are cleared, drawn and resolved. The whole image is the
// viewport until viewportRows. `resolve` takes the average of a multisampled color.
struct RenderTargets {
  const Image* color = nullptr;
  const Image* resolve = nullptr;
  const Image* depth = nullptr;
  ColorBefore colorBefore = ColorBefore::clear;
  bool clearDepth = true;  // to 0: reversed Z
  glm::vec4 clearValue{0.0f};
  std::uint32_t firstRow = 0;
  std::uint32_t rowCount = 0;  // 0: all
};

struct TimedSpan {
  std::string name;
  double gpuMs = 0;
};

struct CommandsImpl;
class Commands {
 public:
  explicit Commands(const Device& device);

  void begin();  // forgets what was recorded before
  void bind(const ComputePipeline& pipeline, const BindingSet& set);
  void bind(const GraphicsPipeline& pipeline, const BindingSet& set);
  // Moves the set's uniform windows, in the order of their slots, to these bytes of their buffers; after bind, which
  // sets them to 0. Multiples of DeviceInfo::uniformWindowAlignment.
  void moveWindows(const BindingSet& set, std::span<const std::uint32_t> offsets);
  void push(std::span<const std::byte> bytes);  // after bind; offset 0
  template <class T>
  void push(const T& value) {
    push(std::as_bytes(std::span(&value, 1)));
  }
  void dispatch(std::uint32_t groupsX, std::uint32_t groupsY = 1, std::uint32_t groupsZ = 1);
  void dispatchIndirect(const Buffer& arguments, std::uint64_t offset);

  void beginRendering(const RenderTargets& targets);
  void endRendering();
  void bindVertexBuffer(std::uint32_t slot, const Buffer& buffer);
  void bindIndexBuffer(const Buffer& buffer);  // 32-bit indices
  enum class Cull { none, back };
  void cull(Cull mode, bool clockwiseIsFront);
  // Draws rows [firstRow, firstRow + the target's) of a picture of `height` rows: the viewport is the whole picture,
  // moved.
  void viewportRows(std::uint32_t firstRow, std::uint32_t height);
  void drawIndexed(std::uint32_t indexCount, std::uint32_t firstIndex, std::int32_t vertexOffset,
                   std::uint32_t firstInstance);

  void draw(std::uint32_t vertexCount);  // without buffers: the shader makes the vertices from their index

  void fill(const Buffer& buffer, std::uint64_t offset, std::uint64_t sizeBytes, std::uint32_t value);
  void copy(const Buffer& from, std::uint64_t fromOffset, const Buffer& to, std::uint64_t toOffset,
            std::uint64_t sizeBytes);
  // Rows [firstRow, firstRow + rowCount), tightly packed; samples == 1.
  void copyToBuffer(const Image& from, std::uint32_t firstRow, std::uint32_t rowCount, const Buffer& to,
                    std::uint64_t toOffset = 0);

  // All work recorded before is finished, and its writes visible, for all work recorded after (host reads included).
  void barrier();

  // Time from here to the matching end, on the device's clock. Spans may not nest. Without timestamps they measure
  // nothing.
  void beginSpan(std::string_view name);
  void endSpan();

  // Runs everything recorded. InternalError on device loss, on a wait beyond `timeoutSeconds` or a validation message.
  void submitAndWait(double timeoutSeconds = 600.0);

  // Of the last submit; spans of the same name are summed, in the order of first use.
  const std::vector<TimedSpan>& spans() const;
  double submitToIdleMs() const;

 private:
  Owned<CommandsImpl> impl_;
};

}  // namespace crosslight::gpu
