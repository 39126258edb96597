// Law 1 on scenes that nobody thought of: what is left out changes no bit, by any method. And what a user may choose
// without changing the picture (queues of hits, kernels) does not change it. CROSSLIGHT_RANDOM=all draws all 300 scenes
// by four methods; else a few by each.
#include "base/error.h"
#include "random/random_pictures.h"

namespace crosslight::testing {
namespace {

constexpr std::uint64_t kScenes = 300;
constexpr std::uint64_t kStyles = kScenes / scenegen::kScenesOfAStyle;
// Of the scenes of a style: what is refused with a sentence is no failure, but a test of little.
constexpr int kMostRefused = 2;

struct Shard {
  Method method;
  std::uint64_t style;
};
void PrintTo(const Shard& s, std::ostream* out) { *out << "style " << s.style << " by " << nameOf(s.method); }

bool drawsAll() {
  const char* wanted = std::getenv("CROSSLIGHT_RANDOM");
  return wanted != nullptr && wanted == std::string("all");
}

// The full pipelines of a style take 5 to 15 s of CPU time to compile on llvmpipe, those of each scene 1 to 5 s:
// without being asked for, as many as cost about a minute and a half together.
constexpr std::uint64_t kFewScenes = 3;

std::vector<Shard> shards() {
  std::vector<Shard> all;
  if (!drawsAll()) return {{Method::flat, 0}, {Method::gouraud, 17}, {Method::phong, 6}, {Method::whitted, 4}};
  for (const Method method : {Method::flat, Method::gouraud, Method::phong, Method::whitted}) {
    for (std::uint64_t style = 0; style < kStyles; ++style) all.push_back({method, style});
  }
  return all;
}

class Sound : public ::testing::TestWithParam<Shard> {
 protected:
  using Change = void (*)(RenderSettings&);
  static void inQueues(RenderSettings& s) { s.hitQueues = HitQueues::on; }
  static void perLane(RenderSettings& s) { s.kernel = KernelFamily::perLane; }

  // Pictures of a few pixels are drawn in no time; llvmpipe's compiler, without its optimizations, takes a quarter
  // less.
  static void SetUpTestSuite() { setenv("GALLIVM_PERF", "nopt", 0); }

  static RenderResult draw(const RandomPicture& picture, std::initializer_list<Change> changes = {}) {
    RenderSettings settings = picture.settings;
    for (const Change change : changes) change(settings);
    return render(device(), picture.scene, settings);
  }

  static bool expectSame(const RenderResult& a, const RenderResult& b, const char* what) {
    const std::string difference = firstDifference(a.image, b.image);
    EXPECT_EQ(difference, "") << what;
    EXPECT_EQ(b.report.nonfinite, 0u) << what;
    if (b.report.counters.contains("traversalsCapped")) {
      EXPECT_EQ(b.report.counters.at("traversalsCapped"), 0u) << what;
    }
    return difference.empty();
  }

  static void check(const RandomPicture& picture) {
    const RenderResult plain = draw(picture);
    for (const EffectRecord& effect : plain.report.effects) EXPECT_FALSE(effect.reason.empty()) << effect.name;
    expectSame(plain, draw(picture, {[](RenderSettings& s) { s.allEffects = true; }}), "specialized and full");
    if (picture.settings.method != Method::whitted) return;
    if (expectSame(plain, draw(picture, {inQueues, perLane}), "in queues and per lane, or by packets")) return;
    expectSame(plain, draw(picture, {inQueues}), "in queues or not");
    expectSame(plain, draw(picture, {perLane}), "per lane or by packets");
  }
};

TEST_P(Sound, specializedIsFullAndChoicesOfSpeedChangeNoBit) {
  std::vector<std::string> refused;
  const std::uint64_t first = GetParam().style * scenegen::kScenesOfAStyle;
  const std::uint64_t count = drawsAll() ? scenegen::kScenesOfAStyle : kFewScenes;
  for (std::uint64_t number = first; number < first + count; ++number) {
    std::string command = "scene " + std::to_string(number);
    try {
      const RandomPicture picture = randomPicture(number, nameOf(GetParam().method));
      SCOPED_TRACE(picture.command);
      command = picture.command;
      check(picture);
    } catch (const InternalError& error) {
      ADD_FAILURE() << command << ": " << error.what();
    } catch (const Error& error) {
      refused.push_back(command + ": " + error.what());
    }
  }
  for (const std::string& text : refused) std::printf("refused: %s\n", text.c_str());
  RecordProperty("refused", static_cast<int>(refused.size()));
  EXPECT_LE(refused.size(), static_cast<std::size_t>(kMostRefused));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Sound, ::testing::ValuesIn(shards()), [](const auto& i) {
  return std::string(nameOf(i.param.method)) + "_" + std::to_string(i.param.style);
});

}  // namespace
}  // namespace crosslight::testing
