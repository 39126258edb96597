// Broken, hostile and impossible files end in InputError: no crash, no huge allocation, no half-written output.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <random>

#include "base/error.h"
#include "image/image_io.h"
#include "temporary_folder.h"

namespace crosslight {
namespace {

using testing::contentOf;
using testing::TemporaryFolder;
using testing::writeContent;

const char* const kFormats[] = {"png", "exr", "hdr", "pfm"};

Image smallImage() {
  Image image = makeImage(20, 10);
  for (std::size_t i = 0; i < image.picture().samples.size(); ++i)
    image.picture().samples[i] = static_cast<float>(i % 17) / 16;
  return image;
}

long peakKiB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

class EveryFormat : public ::testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path file() const { return folder_ / (std::string("a.") + GetParam()); }
  TemporaryFolder folder_;
};

TEST_P(EveryFormat, RefusesEveryTruncation) {
  writeImage(file(), smallImage());
  const std::string whole = contentOf(file());
  // Of PNG only the last four bytes, a checksum that stands behind the data, and of no other format anything is spare.
  for (std::size_t length = 0; length < whole.size(); ++length) {
    writeContent(file(), whole.substr(0, length));
    ASSERT_THROW(readImage(file()), InputError) << length << " of " << whole.size() << " bytes";
  }
}

TEST_P(EveryFormat, SurvivesEveryChangedByte) {
  writeImage(file(), smallImage());
  const std::string whole = contentOf(file());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int change : {0x01, 0x80, 0xff}) {
      std::string broken = whole;
      broken[at] = static_cast<char>(broken[at] ^ change);
      writeContent(file(), broken);
      try {
        const Image image = readImage(file());
        ASSERT_LE(image.pixels(), 1u << 20) << "byte " << at;
      } catch (const InputError&) {
      }
    }
  }
}

TEST_P(EveryFormat, RefusesOtherFilesFoldersAndNothing) {
  writeContent(file(), "");
  EXPECT_THROW(readImage(file()), InputError) << "empty";
  writeContent(file(), std::string(5000, 'x'));
  EXPECT_THROW(readImage(file()), InputError) << "wrong magic";
  std::filesystem::remove(file());
  EXPECT_THROW(readImage(file()), InputError) << "missing";
  std::filesystem::create_directory(file());
  EXPECT_THROW(readImage(file()), InputError) << "a folder";
}

TEST_P(EveryFormat, NamesTheFileInItsMessage) {
  try {
    readImage(file());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(file().string()), std::string::npos) << error.what();
  }
}

TEST_P(EveryFormat, LeavesNothingBehindWhenWritingFails) {
  std::filesystem::create_directory(file());
  EXPECT_THROW(writeImage(file(), smallImage()), InputError) << "the path is a folder";
  EXPECT_EQ(folder_.entries(), 1u) << "a temporary file was left";
  EXPECT_THROW(writeImage(folder_ / "missing" / (std::string("a.") + GetParam()), smallImage()), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "missing"));
}

TEST_P(EveryFormat, LeavesTheOldFileWhenTheNewOneIsRefused) {
  writeContent(file(), "old");
  EXPECT_THROW(writeImage(file(), makeImage(0, 5)), InputError);
  EXPECT_EQ(contentOf(file()), "old");
  EXPECT_EQ(folder_.entries(), 1u);
}

// A limit on file sizes fails like a full disk; in a process of its own, because it stays.
TEST_P(EveryFormat, KeepsTheOldFileOnAFullDisk) {
  writeImage(file(), smallImage());
  const std::string old = contentOf(file());
  Image noise = makeImage(200, 200);
  std::mt19937 bits(3);  // packs badly
  for (float& sample : noise.picture().samples) sample = static_cast<float>(bits() >> 8) * 0x1p-24f;
  const auto onFullDisk = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{10000, 10000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      writeImage(file(), noise);
    } catch (const InputError&) {
      std::_Exit(contentOf(file()) == old && folder_.entries() == 1 ? 0 : 1);
    }
    std::_Exit(2);
  };
  EXPECT_EXIT(onFullDisk(), ::testing::ExitedWithCode(0), "");
}

INSTANTIATE_TEST_SUITE_P(Formats, EveryFormat, ::testing::ValuesIn(kFormats),
                         [](const ::testing::TestParamInfo<const char*>& format) { return std::string(format.param); });

std::string bigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  return bytes;
}

std::string littleEndian(std::uint32_t value) {
  const std::string b = bigEndian(value);
  return {b.rbegin(), b.rend()};
}

// CRC-32 of PNG, bit by bit.
std::uint32_t crc(const std::string& bytes) {
  std::uint32_t value = ~0u;
  for (const char c : bytes) {
    value ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i) value = (value >> 1) ^ (value % 2 == 1 ? 0xedb88320u : 0);
  }
  return ~value;
}

std::string pngWithSize(const std::string& whole, std::uint32_t width, std::uint32_t height) {
  const std::string header = "IHDR" + bigEndian(width) + bigEndian(height) + whole.substr(24, 5);
  return whole.substr(0, 12) + header + bigEndian(crc(header)) + whole.substr(33);
}

std::string exrWithSize(std::string whole, std::uint32_t width, std::uint32_t height) {
  for (const char* const window : {"dataWindow", "displayWindow"}) {
    const std::size_t at = whole.find(window) + std::strlen(window) + 1 + std::strlen("box2i") + 1 + 4;
    whole.replace(at + 8, 8, littleEndian(width - 1) + littleEndian(height - 1));
  }
  return whole;
}

// 64 MiB more at the peak would be a buffer of the claimed size's order; the claimed pictures need 400 MB and more.
TEST(HugeHeader, IsRefusedBeforeItsPixelsAreAllocated) {
  const TemporaryFolder folder;
  writeImage(folder / "a.png", smallImage());
  writeImage(folder / "a.exr", smallImage());
  const std::string png = contentOf(folder / "a.png"), exr = contentOf(folder / "a.exr");
  const long before = peakKiB();
  for (const auto& [width, height] :
       {std::pair{60000u, 60000u}, {0x7fffffffu, 0x7fffffffu}, {1u, 0x7fffffffu}, {65536u, 2000u}, {2000u, 65536u}}) {
    writeContent(folder / "b.png", pngWithSize(png, width, height));
    EXPECT_THROW(readImage(folder / "b.png"), InputError) << width << " x " << height;
    writeContent(folder / "b.exr", exrWithSize(exr, width, height));
    EXPECT_THROW(readImage(folder / "b.exr"), InputError) << width << " x " << height;
    const std::string size = std::to_string(height) + " +X " + std::to_string(width);
    writeContent(folder / "b.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + size + "\nabcd");
    EXPECT_THROW(readImage(folder / "b.hdr"), InputError) << size;
    writeContent(folder / "b.pfm", "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1\nabcd");
    EXPECT_THROW(readImage(folder / "b.pfm"), InputError) << size;
  }
  EXPECT_LT(peakKiB() - before, 64 * 1024);
}

TEST(PngFile, WithAWrongChecksumIsRefused) {
  const TemporaryFolder folder;
  writeImage(folder / "a.png", smallImage());
  std::string content = contentOf(folder / "a.png");
  content[content.find("IDAT") + 10] ^= 1;
  writeContent(folder / "a.png", content);
  EXPECT_THROW(readImage(folder / "a.png"), InputError);
}

TEST(PfmFile, WithABrokenHeaderIsRefused) {
  const TemporaryFolder folder;
  for (const char* const bad :
       {"PF\n", "PF\n1\n", "PF\n1 1\n", "PF\n1 1\n-1", "PF\n-1 1\n-1\n1234567890ab", "PF\n1 1\n0\n1234567890ab",
        "PF\n1 1\nnan\n1234567890ab", "PF\n0 1\n-1\n", "P6\n1 1\n255\nabc", "PF\n1x 1\n-1\n1234567890ab"}) {
    writeContent(folder / "a.pfm", bad);
    EXPECT_THROW(readImage(folder / "a.pfm"), InputError) << bad;
  }
}

TEST(HdrFile, WithABrokenHeaderOrRunIsRefused) {
  const TemporaryFolder folder;
  const std::string start = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";
  const std::string line = std::string("\x02\x02\x00\x08", 4);
  for (const std::string& bad :
       {std::string("#?RADIANCE\n\n-Y 1 +X 1\nabcd"), start + "\n-Y 1\nabcd", start + "\n+Y 1 +X 1\nabcd",
        start + "EXPOSURE=x\n\n-Y 1 +X 1\nabcd", start + "EXPOSURE=0\n\n-Y 1 +X 1\nabcd",
        start + "EXPOSURE=\n\n-Y 1 +X 1\nabcd", start + "\n-Y 0 +X 1\nabcd",
        start + "\n-Y 1 +X 8\n" + line + "\x89\x01", start + "\n-Y 1 +X 8\n" + line + std::string(1, '\0'),
        start + "\n-Y 1 +X 9\n" + line, start + "\n-Y 1 +X 1\n\x01\x01\x01\x05"}) {
    writeContent(folder / "a.hdr", bad);
    EXPECT_THROW(readImage(folder / "a.hdr"), InputError) << bad;
  }
}

}  // namespace
}  // namespace crosslight
