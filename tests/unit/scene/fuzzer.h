// Damage from fixed seeds, and the loop that feeds damaged files to the loader.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <random>

#include "unit/scene/gltf_fixture.h"

namespace crosslight::test {

// More than any base file needs, little enough that damaged sizes cannot stall the machine.
inline constexpr std::uint64_t kMaxBytes = std::uint64_t{64} << 20;
inline constexpr auto kTimeLimit = std::chrono::seconds(60);

class Fuzzer {
 public:
  explicit Fuzzer(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }

  // Flipped, removed, doubled and replaced bytes, a few at a time.
  std::string damaged(std::string bytes) {
    for (std::size_t times = 1 + below(4); times > 0 && !bytes.empty(); --times) {
      const std::size_t at = below(bytes.size());
      const std::size_t length = std::min(1 + below(8), bytes.size() - at);
      switch (below(5)) {
        case 0:
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
          break;
        case 1:
          bytes[at] = static_cast<char>(below(256));
          break;
        case 2:
          bytes.erase(at, length);
          break;
        case 3:
          bytes.insert(at, bytes.substr(at, length));
          break;
        default:
          bytes.resize(at);
          break;
      }
    }
    return bytes;
  }

  // One value of the JSON replaced by something that may be of the wrong kind, size or sign.
  Json damaged(Json json) {
    std::vector<Json*> values;
    collect(json, values);
    static const std::vector<Json> odd = {0,
                                          1,
                                          2,
                                          -1,
                                          3,
                                          255,
                                          65536,
                                          2147483647,
                                          4294967295u,
                                          9007199254740992,
                                          18446744073709551615u,
                                          1e-40,
                                          0.5,
                                          1e38,
                                          nullptr,
                                          true,
                                          "",
                                          "x",
                                          Json::array(),
                                          Json::object(),
                                          {0, 0, 0}};
    for (std::size_t times = 1 + below(3); times > 0; --times) *values[below(values.size())] = odd[below(odd.size())];
    return json;
  }

 private:
  static void collect(Json& json, std::vector<Json*>& values) {
    if (!json.is_structured()) values.push_back(&json);
    for (Json& child : json) {
      if (json.is_structured()) collect(child, values);
    }
  }

  std::mt19937 random_;
};

// CROSSLIGHT_FUZZ_FACTOR makes every run that many times longer, in files and in time.
inline std::size_t fuzzFactor() {
  const char* factor = std::getenv("CROSSLIGHT_FUZZ_FACTOR");
  return factor == nullptr ? 1 : std::max<std::size_t>(1, std::strtoul(factor, nullptr, 10));
}

// Runs `make` until `count` files were tried or the time is up; the number tried.
inline std::size_t tryMany(std::size_t count, const std::string& name,
                           const std::function<std::string(Fuzzer&)>& make) {
  setLogLevel(LogLevel::quiet);
  const TempFolder folder;
  const auto start = std::chrono::steady_clock::now();
  std::size_t tried = 0;
  count *= fuzzFactor();
  for (; tried < count && std::chrono::steady_clock::now() - start < kTimeLimit * fuzzFactor(); ++tried) {
    Fuzzer fuzzer(static_cast<unsigned>(tried));
    const std::filesystem::path file = folder.write(name, make(fuzzer));
    LoadOptions options;
    options.maxBytes = kMaxBytes;
    options.animate = true;
    options.timeSeconds = 0.5;
    const auto began = std::chrono::steady_clock::now();
    try {
      loadScene(file, options);
    } catch (const InputError&) {
      // Refused by name: what is asked for. Anything else ends the test.
    }
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(20)) << name << ", seed " << tried;
  }
  setLogLevel(LogLevel::normal);
  return tried;
}

}  // namespace crosslight::test
