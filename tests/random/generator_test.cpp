// The random series itself: the same everywhere, and random in all that the analysis decides on.
#include <map>

#include "effects/effects.h"
#include "random/random_pictures.h"
#include "scenegen/dice.h"

namespace crosslight::testing {
namespace {

// Outputs of SplitMix64 for the seed 1234567, as its authors' reference implementation (splitmix64.c) gives them.
TEST(Dice, areSplitMix64) {
  scenegen::Dice dice(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317u, 3203168211198807973u, 9817491932198370423u, 4593380528125082431u, 16408922859458223821u})
    EXPECT_EQ(dice.next(), expected);
}

TEST(Dice, reachEveryChoiceAndNoOther) {
  scenegen::Dice dice(3);
  std::map<int, int> seen;
  for (int i = 0; i < 6000; ++i) ++seen[dice.below(6)];
  EXPECT_EQ(seen.size(), 6u);
  for (const auto& [value, count] : seen) {
    EXPECT_TRUE(value >= 0 && value < 6);
    EXPECT_NEAR(count, 1000, 150);  // 5 standard deviations of a binomial distribution, sqrt(6000 * 5 / 36) = 29
  }
}

// Each is on in some pictures and off in others, by some method: else soundness would say nothing of it.
TEST(Series, callsForEveryEffectAndLeavesEachOut) {
  constexpr std::uint64_t kScenes = 300;  // those of the soundness test
  constexpr int kOften = 3;
  std::map<std::string, int> on, off;
  for (std::uint64_t number = 0; number < kScenes; ++number) {
    for (const char* method : {"phong", "whitted"}) {
      const RandomPicture picture = randomPicture(number, method);
      for (const EffectVerdict& v : makePlan(picture.scene, picture.settings).verdicts) ++(v.on ? on : off)[v.name];
    }
  }
  ASSERT_GT(on.size(), 40u);
  for (const auto& [name, count] : on) EXPECT_GE(count, kOften) << name;
  for (const auto& [name, count] : off) EXPECT_GE(count, kOften) << name;
  for (const auto& [name, count] : off) EXPECT_TRUE(on.contains(name)) << name << " is never called for";
  for (const auto& [name, count] : on)
    EXPECT_TRUE(name == "triangles" || off.contains(name)) << name << " is never left out";
}

}  // namespace
}  // namespace crosslight::testing
