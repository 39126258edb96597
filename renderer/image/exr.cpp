// OpenEXR: layers as `layer.channel`, floats as FLOAT, ids as UINT, ZIP compression, metadata as string attributes.
// The only place that sees the library; its exceptions become InputError.
#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "base/check.h"
#include "base/error.h"
#include "image/codecs.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#pragma GCC diagnostic pop

namespace crosslight::codec {
namespace {

static_assert(sizeof(unsigned int) == sizeof(std::uint32_t));

// Files are made in memory: on disk OpenEXR writes its last bytes in a destructor, which cannot report a full disk.
class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(const std::string& where) : OStream(where.c_str()) {}
  void write(const char bytes[], int count) override {
    const auto n = static_cast<std::size_t>(count);
    if (at_ + n > bytes_.size()) bytes_.resize(at_ + n);
    std::memcpy(bytes_.data() + at_, bytes, n);
    at_ += n;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }
  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(View file, const std::string& where) : IStream(where.c_str()), file_(file) {}
  bool read(char bytes[], int count) override {
    const auto n = static_cast<std::size_t>(count);
    if (count < 0 || at_ > file_.size() || n > file_.size() - at_) throw std::runtime_error("the file ends early");
    std::memcpy(bytes, file_.data() + at_, n);
    at_ += n;
    return at_ < file_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  View file_;
  std::size_t at_ = 0;
};

char* bytesOf(Layer& layer, std::size_t channel) {
  if (layer.isInteger) return reinterpret_cast<char*>(layer.integers.data() + channel);
  return reinterpret_cast<char*>(layer.samples.data() + channel);
}

std::string channelName(const std::string& layer, const std::string& channel) {
  return layer.empty() ? channel : layer + "." + channel;
}

Imf::Header headerOf(const Image& image) {
  Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());  // its default is Rec.709
  for (const auto& [key, value] : image.metadata) {
    CL_CHECK(header.find(key.c_str()) == header.end() && "the metadata does not replace what the format needs");
    header.insert(key.c_str(), Imf::StringAttribute(value));
  }
  for (const Layer& layer : image.layers) {
    for (const std::string& channel : layer.channelNames) {
      const std::string name = channelName(layer.name, channel);
      CL_CHECK(header.channels().findChannel(name.c_str()) == nullptr && "every channel has a name of its own");
      header.channels().insert(name.c_str(), Imf::Channel(layer.isInteger ? Imf::UINT : Imf::FLOAT));
    }
  }
  return header;
}

void insertSlices(Imf::FrameBuffer& frame, Layer& layer, const Imath::Box2i& window,
                  const std::vector<std::string>& names) {
  const std::size_t xStride = layer.channels() * sizeof(float);
  const std::size_t yStride = xStride * static_cast<std::size_t>(window.max.x - window.min.x + 1);
  for (std::size_t c = 0; c < layer.channels(); ++c) {
    frame.insert(names[c].c_str(), Imf::Slice::Make(layer.isInteger ? Imf::UINT : Imf::FLOAT, bytesOf(layer, c), window,
                                                    xStride, yStride));
  }
}

void scalePicture(Layer& picture, float gain) {
  const std::size_t alpha = picture.channel("A");
  for (std::size_t i = 0; i < picture.samples.size(); ++i) {
    if (i % picture.channels() != alpha) picture.samples[i] *= gain;
  }
}

// Channels of one part that make up one layer: same prefix, same kind.
struct LayerPlan {
  std::string name;
  bool isInteger = false;
  std::vector<std::string> fileNames;
};

// Position of a channel within its layer: colors, then coordinates, then the rest by name.
std::size_t rankOf(const std::string& channel) {
  static const std::vector<std::string> order{"R", "G", "B", "X", "Y", "Z", "U", "V", "A"};
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), channel) - order.begin());
}

std::string lastPart(const std::string& name) { return name.substr(name.rfind('.') + 1); }
std::string prefixOf(const std::string& name) {
  return name.find('.') == std::string::npos ? "" : name.substr(0, name.rfind('.'));
}

std::vector<LayerPlan> planLayers(const Imf::Header& header, bool manyParts, const std::string& where) {
  std::map<std::pair<std::string, bool>, LayerPlan> plans;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    const std::string name = it.name();
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
      throw InputError(where, "channel " + name + " is subsampled; convert the file to full resolution");
    }
    const bool isInteger = it.channel().type == Imf::UINT;
    LayerPlan& plan = plans[{prefixOf(name), isInteger}];
    plan.name = prefixOf(name);
    if (manyParts && header.hasName()) plan.name = plan.name.empty() ? header.name() : header.name() + "." + plan.name;
    plan.isInteger = isInteger;
    plan.fileNames.push_back(name);
  }
  std::vector<LayerPlan> result;
  for (auto& [key, plan] : plans) {
    std::stable_sort(plan.fileNames.begin(), plan.fileNames.end(), [](const std::string& a, const std::string& b) {
      return rankOf(lastPart(a)) < rankOf(lastPart(b));
    });
    result.push_back(std::move(plan));
  }
  return result;
}

// Most that a compressed byte can become. Deflate: 1032; PXR24 drops a quarter of each float before it; the others
// (run lengths, Huffman codes, fixed blocks) stay below. DWA codes a block of 64 floats as one 16-bit end-of-block mark
// before deflate: 128 times more.
std::uint64_t maxExpansion(Imf::Compression compression) {
  constexpr std::uint64_t kDeflate = 1032;
  if (compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION) return kDeflate * 128;
  return compression == Imf::NO_COMPRESSION ? 1 : (kDeflate * 4 + 2) / 3;
}

std::uint64_t bytesPerPixel(const Imf::Header& header) {
  std::uint64_t bytes = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
    bytes += it.channel().type == Imf::HALF ? 2 : 4;
  return bytes;
}

struct Window {
  std::uint64_t width = 0, height = 0;
};

Window sizeOf(const Imf::Header& header) {
  const Imath::Box2i& w = header.dataWindow();
  return {static_cast<std::uint64_t>(std::int64_t{w.max.x} - w.min.x + 1),
          static_cast<std::uint64_t>(std::int64_t{w.max.y} - w.min.y + 1)};
}

void readPart(Imf::MultiPartInputFile& file, int part, std::uint64_t fileBytes, const std::string& where,
              Image& image) {
  const Imf::Header& header = file.header(part);
  if (header.hasType() && Imf::isDeepData(header.type()))
    throw InputError(where, "holds deep data, which is not supported");
  const Window size = sizeOf(header);
  checkSides(size.width, size.height, where);
  if (size.width * size.height * bytesPerPixel(header) > fileBytes * maxExpansion(header.compression())) {
    throw InputError(where, "is too short for the size that its header gives");
  }
  if (part == 0) {
    image.width = static_cast<std::uint32_t>(size.width);
    image.height = static_cast<std::uint32_t>(size.height);
  } else if (size.width != image.width || size.height != image.height) {
    throw InputError(where, "has parts of different sizes, which is not supported");
  }
  const std::vector<LayerPlan> plans = planLayers(header, file.parts() > 1, where);
  const std::size_t first = image.layers.size();
  for (const LayerPlan& plan : plans) {
    std::vector<std::string> channels;
    for (const std::string& name : plan.fileNames) channels.push_back(lastPart(name));
    plan.isInteger ? addIntegerLayer(image, plan.name, channels) : addLayer(image, plan.name, channels);
  }
  Imf::FrameBuffer frame;
  for (std::size_t i = 0; i < plans.size(); ++i)
    insertSlices(frame, image.layers[first + i], header.dataWindow(), plans[i].fileNames);
  Imf::InputPart input(file, part);
  input.setFrameBuffer(frame);
  input.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);
}

void readMetadata(const Imf::Header& header, Image& image) {
  for (auto it = header.begin(); it != header.end(); ++it) {
    const std::string name = it.name();
    if (name == "name" || name == "type") continue;  // what multi-part files need, not what was said about the image
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
      image.metadata[name] = text->value();
  }
}

void limitHeaders() {
  // Before a part is opened, OpenEXR allocates line buffers by the header's width.
  static std::once_flag once;
  std::call_once(
      once, [] { Imf::Header::setMaxImageSize(static_cast<int>(kMaxImageSide), static_cast<int>(kMaxImageSide)); });
}

// Blocks of rows are packed in the library's threads; the file is the same whatever their number.
int packingThreads(const Image& image) {
  constexpr std::size_t kWorthThreads = std::size_t{1} << 16;  // pixels; below, starting threads costs more
  if (image.pixels() < kWorthThreads) return 0;
  static const int count = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  static std::once_flag once;
  std::call_once(once, [] { Imf::setGlobalThreadCount(count); });
  return count;
}

}  // namespace

Bytes encodeExr(const Image& image, float gain, const std::string& where) {
  const Imf::Header header = headerOf(image);
  std::vector<Layer> scaled;
  if (gain != 1.0f && !image.picture().isInteger) {
    scaled.push_back(image.picture());
    scalePicture(scaled.front(), gain);
  }
  Imf::FrameBuffer frame;
  for (std::size_t i = 0; i < image.layers.size(); ++i) {
    // A frame buffer is written to or read from; the writer only reads.
    Layer& layer = i == 0 && !scaled.empty() ? scaled.front() : const_cast<Layer&>(image.layers[i]);
    std::vector<std::string> names;
    for (const std::string& channel : layer.channelNames) names.push_back(channelName(layer.name, channel));
    insertSlices(frame, layer, header.dataWindow(), names);
  }
  MemoryOutput output(where);
  try {
    Imf::OutputFile file(output, header, packingThreads(image));
    file.setFrameBuffer(frame);
    file.writePixels(static_cast<int>(image.height));
  } catch (const std::exception& error) {
    throw InputError(where, std::string("cannot be written: ") + error.what());
  }
  return output.take();
}

Image decodeExr(View bytes, const std::string& where) {
  limitHeaders();
  MemoryInput input(bytes, where);
  try {
    Imf::MultiPartInputFile file(input, 0);
    Image image;
    for (int part = 0; part < file.parts(); ++part) readPart(file, part, bytes.size(), where, image);
    readMetadata(file.header(0), image);
    return image;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(where, std::string("cannot be decoded: ") + error.what());
  }
}

}  // namespace crosslight::codec
