// Buffers and images. Every size is checked against the device's limits; too large is a DeviceError with both figures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.h"

namespace crosslight::gpu {

// What a buffer may be used as (bit mask). All buffers can be copied from and to.
enum BufferUse : std::uint32_t {
  useStorage = 1,
  useUniformTexel = 2,  // the shaders read it through a samplerBuffer / usamplerBuffer
  useUniform = 4,
  useVertex = 8,
  useIndex = 16,
  useIndirect = 32,
  useReadback = 64,         // host-visible and cached: read() is fast
  useHostWrite = 128,       // host-visible: write() needs no staging copy; for small, often changed data
  useUniformWindows = 256,  // of BindingType::uniformWindow: maxUniformBufferRange holds for each window, not for all
  useBoxes = 512,           // BoxSearch is built from it
  useBoxSearch = 1024,      // of the gpu room: what BoxSearch keeps, or works in
};

struct BufferImpl;
class Buffer {
 public:
  Buffer() = default;
  // Contents undefined. A size of 0 makes a buffer of 16 bytes (bindings must never be empty). `name` is for messages.
  Buffer(const Device& device, std::string name, std::uint64_t sizeBytes, std::uint32_t use);
  // With contents; through a staging copy where device-local memory cannot be mapped.
  Buffer(const Device& device, std::string name, std::span<const std::byte> contents, std::uint32_t use);
  template <class T>
  static Buffer of(const Device& device, std::string name, const std::vector<T>& items, std::uint32_t use) {
    return Buffer(device, std::move(name), std::as_bytes(std::span(items)), use);
  }

  explicit operator bool() const { return impl_ != nullptr; }
  std::uint64_t sizeBytes() const;  // as asked for: 0 stays 0
  // Host access; blocking; only outside of recorded, unfinished work.
  void write(std::uint64_t offset, std::span<const std::byte> bytes);
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;
  template <class T>
  std::vector<T> readAll() const {
    std::vector<T> items(static_cast<std::size_t>(sizeBytes() / sizeof(T)));
    read(0, std::as_writable_bytes(std::span(items)));
    return items;
  }

  BufferImpl& impl() const { return *impl_; }

 private:
  Owned<BufferImpl> impl_;
};

enum class ImageFormat { rgba32f, r32ui, depth32f };

struct ImageImpl;
// A 2D render target: color (also copy source) or depth. `samples` is 1, 2, 4 or 8 and one of DeviceInfo::msaaCounts.
class Image {
 public:
  Image() = default;
  Image(const Device& device, std::string name, ImageFormat format, std::uint32_t width, std::uint32_t height,
        std::uint32_t samples = 1);

  // A color target of one sample whose pixels are the buffer's contents, row after row from its beginning: what is
  // drawn needs no copy. Empty where the device cannot lay it out so; the buffer must outlive it. Software devices
  // only: hardware draws slowly into such memory.
  static Image over(const Device& device, std::string name, ImageFormat format, const Buffer& buffer,
                    std::uint32_t width, std::uint32_t height);

  explicit operator bool() const { return impl_ != nullptr; }
  std::uint32_t width() const;
  std::uint32_t height() const;
  std::uint32_t samples() const;

  ImageImpl& impl() const { return *impl_; }

 private:
  Owned<ImageImpl> impl_;
};

}  // namespace crosslight::gpu
