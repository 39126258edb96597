#include "app/render_options.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "app/effects_option.h"
#include "app/render_job.h"
#include "app/set_keys.h"
#include "base/error.h"

namespace crosslight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no UsageError";
}

TEST(SetKeys, firstValueIsTheDefaultAndEveryOtherOneChangesSomething) {
  for (const SetKey& row : setKeys()) {
    if (row.values.empty()) continue;  // a number
    ASSERT_GE(row.values.size(), 2u) << row.key;
    for (const std::string& value : row.values) {
      RenderSettings settings;
      applySet(std::string(row.key) + "=" + value, settings);
      const bool same = settings == RenderSettings{};
      EXPECT_EQ(same, value == row.values.front()) << row.key << "=" << value;
    }
  }
}

TEST(SetKeys, numbersHaveLimitsAndADefault) {
  std::size_t numbers = 0;
  for (const SetKey& row : setKeys()) {
    if (!row.values.empty()) continue;
    ++numbers;
    const auto applied = [&](const std::string& value) {
      RenderSettings settings;
      applySet(std::string(row.key) + "=" + value, settings);
      return settings;
    };
    EXPECT_TRUE(applied(fmt::format("{:g}", row.number.fallback)) == RenderSettings{}) << row.key;
    EXPECT_FALSE(applied(fmt::format("{:g}", row.number.lowest)) == applied(fmt::format("{:g}", row.number.highest)))
        << row.key;
    for (const std::string& bad : {fmt::format("{:g}", 2 * row.number.highest), std::string("-1e9"), std::string("two"),
                                   std::string("nan"), std::string()}) {
      RenderSettings settings;
      const std::string pair = std::string(row.key) + "=" + bad;
      EXPECT_THAT(messageOf([&] { applySet(pair, settings); }), HasSubstr("number from")) << pair;
    }
  }
  EXPECT_GT(numbers, 0u);
}

TEST(SetKeys, twoValuesNeverMeanTheSame) {
  for (const SetKey& row : setKeys()) {
    for (std::size_t a = 0; a < row.values.size(); ++a) {
      for (std::size_t b = a + 1; b < row.values.size(); ++b) {
        RenderSettings first, second;
        applySet(std::string(row.key) + "=" + row.values[a], first);
        applySet(std::string(row.key) + "=" + row.values[b], second);
        EXPECT_FALSE(first == second) << row.key << " " << row.values[a] << " " << row.values[b];
      }
    }
  }
}

TEST(SetKeys, unknownKeysAndValuesListWhatThereIs) {
  RenderSettings settings;
  EXPECT_THAT(messageOf([&] { applySet("shadow=on", settings); }), HasSubstr("Did you mean 'shadows'?"));
  EXPECT_THAT(messageOf([&] { applySet("shadows=offf", settings); }), HasSubstr("Did you mean 'off'?"));
  EXPECT_THAT(messageOf([&] { applySet("shadows", settings); }), HasSubstr("a value is missing"));
  EXPECT_THAT(messageOf([&] { applySet("shadows=", settings); }), HasSubstr("a value is missing"));
  EXPECT_THAT(messageOf([&] { applySet("=on", settings); }), HasSubstr("unknown key ''"));
}

TEST(RenderOptions, resolutionIsWidthTimesHeight) {
  EXPECT_EQ(resolutionOf("640x480").width, 640u);
  EXPECT_EQ(resolutionOf("640x480").height, 480u);
  EXPECT_EQ(resolutionOf("1X65536").height, 65536u);
  for (const char* wrong : {"", "640", "x", "640x", "x480", "0x480", "640x0", "65537x1", "-1x5", "640x480x2", "6.5x4",
                            "4294967297x1", "640 x 480", "+5x5"}) {
    EXPECT_THAT(messageOf([&] { resolutionOf(wrong); }), HasSubstr("e.g. 640x480")) << wrong;
  }
}

TEST(RenderOptions, aovsKeepTheOrderOfTheFileWhateverTheOrderOfTheWords) {
  EXPECT_THAT(aovsOf(""), SizeIs(0));
  EXPECT_THAT(aovsOf("normal,depth,normal"), ElementsAre("depth", "normal"));
  EXPECT_THAT(aovsOf("all"), SizeIs(std::size(kAovNames)));
  EXPECT_THAT(messageOf([] { aovsOf("depth,dept"); }), HasSubstr("Did you mean 'depth'?"));
  EXPECT_THAT(messageOf([] { aovsOf(",depth"); }), HasSubstr("unknown AOV ''"));
}

TEST(SetKeys, numbersAreReadWholeAndChecked) {
  RenderSettings settings;
  applySet("light-radius=0.25", settings);
  EXPECT_EQ(settings.shadowMaps.lightRadius, 0.25);
  for (const char* bad : {"light-radius", "light-radius=", "light-radius=-1", "light-radius=1x", "light-radius=nan",
                          "light-radius=inf"}) {
    EXPECT_THAT(messageOf([&] { applySet(bad, settings); }), HasSubstr("no number from 0 to")) << bad;
  }
}

TEST(SetKeys, sizesOfShadowMapsAreWhatTheySay) {
  for (const std::uint32_t size : {256u, 512u, 1024u, 2048u, 4096u}) {
    RenderSettings settings;
    applySet("shadow-map-size=" + std::to_string(size), settings);
    EXPECT_EQ(settings.shadowMaps.size, size);
  }
}

TEST(RenderOptions, defaultsAreThoseOfTheLibrary) {
  RenderOptions options;
  options.scene = "scene.gltf";
  options.output = "out.png";
  const RenderSettings parsed = checkedSettings(options), fresh;
  EXPECT_TRUE(parsed == fresh);
  const DisplayTransform display = checkedDisplay(options), freshDisplay;
  EXPECT_EQ(display.toneMap, freshDisplay.toneMap);
  EXPECT_EQ(display.exposureStops, freshDisplay.exposureStops);
}

TEST(RenderOptions, aovsNeedAFormatWithLayers) {
  RenderOptions options;
  options.scene = "scene.gltf";
  options.output = "out.png";
  options.aovs = "depth";
  EXPECT_THAT(messageOf([&] { checkedSettings(options); }), HasSubstr("-o out.exr"));
  options.output = "out.exr";
  EXPECT_THAT(checkedSettings(options).aovs, ElementsAre("depth"));
}

TEST(RenderOptions, everyMethodHasANameThatLeadsBack) {
  for (const Method method : allMethods()) EXPECT_EQ(methodOf(nameOf(method)), method);
}

TEST(EffectsOption, listForcesSingleEffectsOnTopOfABase) {
  RenderSettings settings;
  applyEffects("auto", settings);
  EXPECT_TRUE(settings == RenderSettings{});
  applyEffects("all", settings);
  EXPECT_TRUE(settings.allEffects);
  applyEffects("all,-fog,+sphere", settings);
  EXPECT_TRUE(settings.allEffects);
  EXPECT_THAT(settings.forcedEffects, ElementsAre(ForcedEffect{"fog", false}, ForcedEffect{"sphere", true}));
  applyEffects("within=0.25,-phong", settings);
  EXPECT_EQ(settings.effectsWithin, 0.25);
  applyEffects("-phong", settings);
  EXPECT_EQ(settings.effectsWithin, 0);
  EXPECT_FALSE(settings.allEffects);
  EXPECT_THAT(settings.forcedEffects, ElementsAre(ForcedEffect{"phong", false}));
}

TEST(EffectsOption, whatCannotBeMeantIsRefusedWithTheRemedy) {
  const auto refusal = [](const std::string& text) {
    return messageOf([&] {
      RenderSettings settings;
      applyEffects(text, settings);
    });
  };
  EXPECT_THAT(refusal("-fogg"), HasSubstr("Did you mean 'fog'?"));
  EXPECT_THAT(refusal("-fog,+shadow"), HasSubstr("Did you mean 'shadows'?"));
  EXPECT_THAT(refusal("fog"), HasSubstr("+fog compiles it in, -fog leaves it out"));
  EXPECT_THAT(refusal("+fog,-fog"), HasSubstr("exclude each other"));
  EXPECT_THAT(refusal("-fog,all"), HasSubstr("comes first"));
  for (const std::string bad : {"within=", "within=0", "within=-1", "within=inf", "within=nan", "within=1x"})
    EXPECT_THAT(refusal(bad), HasSubstr("needs a radiance above 0")) << bad;
  for (const std::string bad : {"", ",", "-", "+", "-fog,", "--fog", "-fog +shadows"})
    EXPECT_THAT(refusal(bad), HasSubstr("unknown effect")) << bad;
}

}  // namespace
}  // namespace crosslight
