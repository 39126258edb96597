// Frames are at the times and turns that the options say.
#include "app/frame_plan.h"

#include <gtest/gtest.h>

#include "app/render_options.h"
#include "base/error.h"

namespace crosslight {
namespace {

TEST(FramePlan, isEmptyForOnePicture) { EXPECT_TRUE(framesOf(RenderOptions{}).empty()); }

TEST(FramePlan, countsFromZeroOrOverARange) {
  RenderOptions o;
  o.frames = "3";
  ASSERT_EQ(framesOf(o).size(), 3u);
  EXPECT_EQ(framesOf(o)[2].number, 2u);
  o.frames = "7-9";
  ASSERT_EQ(framesOf(o).size(), 3u);
  EXPECT_EQ(framesOf(o)[0].number, 7u);
}

TEST(FramePlan, putsFrameNAtNTimesTheFramesLength) {
  RenderOptions o;
  o.frames = "10-11";
  o.framesPerSecond = 4;
  o.timeSeconds = 1;
  EXPECT_EQ(framesOf(o)[0].timeSeconds, 3.5);
  EXPECT_EQ(framesOf(o)[1].timeSeconds, 3.75);
}

TEST(FramePlan, turnsOnceOnATurntable) {
  RenderOptions o;
  o.turntable = 8;
  const auto frames = framesOf(o);
  ASSERT_EQ(frames.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(frames[i].turnDegrees, 45.0 * static_cast<double>(i));
    EXPECT_EQ(frames[i].timeSeconds, 0);
  }
  EXPECT_FALSE(framesAnimate(o)) << "a turntable alone stands still";
  o.frames = "8-9";  // a second turn begins
  EXPECT_EQ(framesOf(o)[0].turnDegrees, 0);
  EXPECT_EQ(framesOf(o)[1].turnDegrees, 45);
}

TEST(FramePlan, putsNumbersIntoNames) {
  EXPECT_EQ(frameName("f_####.png", 12), "f_0012.png");
  EXPECT_EQ(frameName("f#.png", 1234), "f1234.png");
  EXPECT_EQ(frameName("folder#1/f_##_a.exr", 3), "folder#1/f_03_a.exr");
  for (const char* bad : {"f.png", "#/f.png", "f_#_#.png", ""}) EXPECT_THROW(frameName(bad, 1), UsageError) << bad;
}

TEST(FramePlan, knowsVideosByTheirEnding) {
  for (const char* video : {"a.mp4", "a.mkv", "a.webm", "b/a.gif"}) EXPECT_TRUE(isVideo(video)) << video;
  for (const char* other : {"a.png", "mp4", "a.mp4.png", ""}) EXPECT_FALSE(isVideo(other)) << other;
}

}  // namespace
}  // namespace crosslight
