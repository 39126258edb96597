#include <algorithm>
#include <limits>
#include <numeric>
#include <thread>

#include "gpu/warm_up.h"
#include "gpu_fixture.h"

namespace crosslight::gpu {
namespace {

using testing::HasSubstr;

struct ScalePush {
  std::uint32_t count;
  std::uint32_t summand;
};

// scale_add.comp with its buffers: in = 0, 1, 2 ..., float texels 5, uint texels 7, uniform 11.
struct ScaleAdd {
  static constexpr std::uint32_t kCount = 1000;
  static constexpr std::uint32_t kGroup = 64;

  explicit ScaleAdd(const Device& device, std::uint32_t factor = 3)
      : layout(device,
               {{0, BindingType::storageBuffer},
                {1, BindingType::storageBuffer},
                {2, BindingType::texelBufferFloat4},
                {3, BindingType::texelBufferUint4},
                {4, BindingType::uniformBuffer}},
               sizeof(ScalePush)),
        pipeline(device, layout, embeddedShader("scale_add.comp"), {{0, kGroup}, {1, factor}}),
        set(device, layout) {
    std::vector<std::uint32_t> counting(kCount);
    std::iota(counting.begin(), counting.end(), 0u);
    in = Buffer::of(device, "in", counting, useStorage | useReadback);
    out = Buffer(device, "out", 4 * kCount, useStorage);
    floats = Buffer::of(device, "floats", std::vector<glm::vec4>(kCount, glm::vec4(0, 0, 0, 5)), useUniformTexel);
    uints = Buffer::of(device, "uints", std::vector<glm::uvec4>(kCount, glm::uvec4(0, 7, 0, 0)), useUniformTexel);
    uniform = Buffer::of(device, "uniform", std::vector<std::uint32_t>{11}, useUniform | useHostWrite);
    set.set(0, in);
    set.set(1, out);
    set.set(2, floats);
    set.set(3, uints);
    set.set(4, uniform);
  }

  void record(Commands& commands, std::uint32_t summand) const {
    commands.bind(pipeline, set);
    commands.push(ScalePush{kCount, summand});
    commands.dispatch((kCount + kGroup - 1) / kGroup);
  }

  std::vector<std::uint32_t> expected(std::uint32_t factor, std::uint32_t summand) const {
    std::vector<std::uint32_t> values(kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) values[i] = factor * i + summand + 5 + 7 + 11;
    return values;
  }

  BindingLayout layout;
  ComputePipeline pipeline;
  BindingSet set;
  Buffer in, out, floats, uints, uniform;
};

TEST_F(GpuTest, ConstantsPushesAndEveryKindOfBindingReachTheShader) {
  for (const std::uint32_t factor : {1u, 3u}) {
    const ScaleAdd job(device(), factor);
    Commands commands(device());
    commands.begin();
    job.record(commands, 100);
    commands.submitAndWait();
    EXPECT_EQ(job.out.readAll<std::uint32_t>(), job.expected(factor, 100));
    EXPECT_GT(commands.submitToIdleMs(), 0.0);
  }
}

// And while threads warm up, others may run.
TEST_F(GpuTest, WarmedUpKernelsDoTheSameAndWarmingUpTouchesNothing) {
  const ScaleAdd job(device());
  const std::vector<std::uint32_t> before = job.out.readAll<std::uint32_t>();
  {
    WarmUp warmUp(device(), job.layout);
    std::thread other([&] { warmUp.add(job.pipeline); });
    Commands commands(device());
    commands.begin();
    commands.submitAndWait();
    other.join();
    warmUp.compiles();
  }
  EXPECT_EQ(job.out.readAll<std::uint32_t>(), before);
  Commands commands(device());
  commands.begin();
  job.record(commands, 100);
  commands.submitAndWait();
  EXPECT_EQ(job.out.readAll<std::uint32_t>(), job.expected(3, 100));
}

TEST_F(GpuTest, WhatIsInTheDriversCacheIsNotSaidToCompile) {
  const ScaleAdd job(device());
  Commands commands(device());
  commands.begin();
  job.record(commands, 1);
  commands.submitAndWait();
  WarmUp warmUp(device(), job.layout);
  warmUp.add(job.pipeline);
  EXPECT_FALSE(warmUp.compiles()) << "it has run before";
}

TEST_F(GpuTest, AUniformWindowShowsTheRecordThatItWasMovedTo) {
  ScaleAdd job(device());
  const BindingLayout layout(device(),
                             {{0, BindingType::storageBuffer},
                              {1, BindingType::storageBuffer},
                              {2, BindingType::texelBufferFloat4},
                              {3, BindingType::texelBufferUint4},
                              {4, BindingType::uniformWindow}},
                             sizeof(ScalePush));
  const ComputePipeline pipeline(device(), layout, embeddedShader("scale_add.comp"), {{0, ScaleAdd::kGroup}, {1, 3u}});
  const std::uint32_t step = std::max(4u, device().info().uniformWindowAlignment);
  std::vector<std::uint32_t> records(3 * step / 4, 0u);
  for (std::uint32_t i = 0; i < 3; ++i) records[i * step / 4] = 11 + i;
  const Buffer windows = Buffer::of(device(), "windows", records, useUniformWindows);
  BindingSet set(device(), layout);
  set.set(0, job.in);
  set.set(1, job.out);
  set.set(2, job.floats);
  set.set(3, job.uints);
  EXPECT_THROW(set.set(4, windows), InternalError) << "a window has a size of its own";
  set.setWindow(4, windows, 4);
  for (const std::uint32_t record : {0u, 2u}) {
    Commands commands(device());
    commands.begin();
    commands.bind(pipeline, set);
    const std::uint32_t offset = record * step;
    if (record > 0) commands.moveWindows(set, std::span(&offset, 1));
    commands.push(ScalePush{ScaleAdd::kCount, 100});
    commands.dispatch((ScaleAdd::kCount + ScaleAdd::kGroup - 1) / ScaleAdd::kGroup);
    commands.submitAndWait();
    EXPECT_EQ(job.out.readAll<std::uint32_t>(), job.expected(3, 100 + record));
  }
}

TEST_F(GpuTest, WorkOnMemoryThatTheHostCannotReachGivesTheSame) {
  DeviceOptions options;
  options.neverMap = true;
  const Device unmapped = Device::open(options);
  const ScaleAdd job(unmapped);
  Commands commands(unmapped);
  commands.begin();
  job.record(commands, 5);
  commands.submitAndWait();
  EXPECT_EQ(job.out.readAll<std::uint32_t>(), job.expected(3, 5));
}

TEST_F(GpuTest, CommandsCanBeRecordedAgain) {
  const ScaleAdd job(device());
  Commands commands(device());
  for (const std::uint32_t summand : {1u, 2u, 3u}) {
    commands.begin();
    job.record(commands, summand);
    commands.submitAndWait();
    EXPECT_EQ(job.out.readAll<std::uint32_t>(), job.expected(3, summand));
  }
  EXPECT_THROW(commands.submitAndWait(), InternalError) << "nothing is recorded";
}

TEST_F(GpuTest, BarriersOrderDispatchesFillsAndCopies) {
  const ScaleAdd job(device());
  const Buffer copied(device(), "copied", job.out.sizeBytes(), useReadback);
  Commands commands(device());
  commands.begin();
  commands.fill(job.out, 0, job.out.sizeBytes(), 0xffffffffu);
  commands.barrier();
  job.record(commands, 9);
  commands.barrier();
  commands.copy(job.out, 0, copied, 0, copied.sizeBytes());
  commands.barrier();
  commands.fill(job.out, 4, 8, 1);
  commands.fill(job.out, 0, 0, 1);
  commands.copy(job.out, 0, copied, 0, 0);
  commands.submitAndWait();
  EXPECT_EQ(copied.readAll<std::uint32_t>(), job.expected(3, 9));
  const auto filled = job.out.readAll<std::uint32_t>();
  EXPECT_EQ(filled[0], job.expected(3, 9)[0]);
  EXPECT_EQ(filled[1], 1u);
  EXPECT_EQ(filled[2], 1u);
  EXPECT_EQ(filled[3], job.expected(3, 9)[3]);
}

TEST_F(GpuTest, AnIndirectDispatchTakesItsSizeFromABuffer) {
  const ScaleAdd job(device());
  const Buffer arguments =
      Buffer::of(device(), "arguments", std::vector<std::uint32_t>{99, 2, 1, 1}, useIndirect | useStorage);
  Commands commands(device());
  commands.begin();
  commands.fill(job.out, 0, job.out.sizeBytes(), 0);
  commands.barrier();
  commands.bind(job.pipeline, job.set);
  commands.push(ScalePush{ScaleAdd::kCount, 0});
  commands.dispatchIndirect(arguments, 4);
  commands.submitAndWait();
  auto expected = job.expected(3, 0);
  std::fill(expected.begin() + 2 * ScaleAdd::kGroup, expected.end(), 0u);
  EXPECT_EQ(job.out.readAll<std::uint32_t>(), expected);
}

TEST_F(GpuTest, AMissingBarrierIsFoundBySynchronizationValidation) {
  const ScaleAdd job(device());
  Commands commands(device());
  commands.begin();
  commands.fill(job.in, 0, job.in.sizeBytes(), 1);
  job.record(commands, 1);  // reads `in`, unordered
  EXPECT_THAT(messageOf<InternalError>([&] { commands.submitAndWait(); }), HasSubstr("SYNC-HAZARD-READ-AFTER-WRITE"));
  EXPECT_THAT(messageOf<InternalError>([&] { device().throwOnValidationMessages(); }), HasSubstr("SYNC-HAZARD"));
}

struct SpinPush {
  std::uint32_t outerRounds;
  std::uint32_t innerRounds;
};

// spin.comp with its one word of state.
struct Spin {
  explicit Spin(const Device& device)
      : layout(device, {{0, BindingType::storageBuffer}}, sizeof(SpinPush)),
        pipeline(device, layout, embeddedShader("spin.comp"), {}),
        state(Buffer::of(device, "state", std::vector<std::uint32_t>{1}, useStorage)),
        set(device, layout) {
    set.set(0, state);
  }

  void record(Commands& commands, SpinPush rounds, std::uint32_t groups = 1) const {
    commands.bind(pipeline, set);
    commands.push(rounds);
    commands.dispatch(groups);
  }

  static std::uint32_t expected(std::uint64_t rounds) {
    std::uint32_t x = 1;
    for (std::uint64_t i = 0; i < rounds; ++i) x = x * 1664525u + (x >> 13);
    return x;
  }

  BindingLayout layout;
  ComputePipeline pipeline;
  Buffer state;
  BindingSet set;
};

TEST_F(GpuTest, SpansMeasureWorkAndSumByName) {
  const Spin spin(device());
  Commands commands(device());
  const auto timed = [&](const char* name, SpinPush rounds) {
    commands.beginSpan(name);
    spin.record(commands, rounds);
    commands.endSpan();
    commands.barrier();
  };
  // Other programs only make spans longer: the shortest of some runs is what the work takes. The first run, in which
  // llvmpipe compiles the shader, falls out that way too.
  double shortMs = std::numeric_limits<double>::infinity(), longMs = shortMs;
  for (int run = 0; run < 10; ++run) {
    commands.begin();
    timed("short", {1, 600});
    timed("long", {100, 600});
    for (int i = 0; i < 300; ++i) timed("many", {1, 10});  // more than one query pool holds
    commands.submitAndWait();
    const auto& spans = commands.spans();
    ASSERT_EQ(spans.size(), 3u);
    EXPECT_EQ(spans[0].name, "short");
    EXPECT_EQ(spans[1].name, "long");
    EXPECT_EQ(spans[2].name, "many");
    if (device().info().timestampPeriodNs <= 0) GTEST_SKIP() << "this device has no timestamps";
    for (const TimedSpan& span : spans) EXPECT_GT(span.gpuMs, 0.0) << span.name;
    EXPECT_LE(spans[0].gpuMs + spans[1].gpuMs + spans[2].gpuMs, commands.submitToIdleMs());
    shortMs = std::min(shortMs, spans[0].gpuMs);
    longMs = std::min(longMs, spans[1].gpuMs);
  }
  EXPECT_GT(longMs, 2.0 * shortMs) << "a hundred times the loop passes";
  commands.begin();
  commands.submitAndWait();
  EXPECT_TRUE(commands.spans().empty());
}

TEST_F(GpuTest, LoopsRunToTheirEndBelowTheLimitThatTheDeviceStates) {
  const auto run = [this](SpinPush rounds) {
    const Spin spin(device());
    Commands commands(device());
    commands.begin();
    spin.record(commands, rounds);
    commands.submitAndWait();
    return spin.state.readAll<std::uint32_t>().front();
  };
  const std::uint32_t limit = device().info().maxLoopPasses;
  // 200 passes of the outer loop and 200 * 300 of the inner one, and the pass in which each loop ends.
  EXPECT_EQ(run({200, 300}), Spin::expected(60000));
  if (limit == 0) {
    EXPECT_EQ(run({200, 3000}), Spin::expected(600000));
  } else {
    ASSERT_GT(limit, 200u + 200u * 301u);
    EXPECT_NE(run({200, limit / 200 + 1}), Spin::expected(std::uint64_t{200} * (limit / 200 + 1)))
        << "the driver has no such limit any more: take maxLoopPasses back";
  }
}

TEST_F(GpuTest, MisuseIsABrokenInvariant) {
  ScaleAdd job(device());
  Commands commands(device());
  EXPECT_THROW(commands.dispatch(1), InternalError) << "before begin";
  commands.begin();
  EXPECT_THROW(commands.dispatch(1), InternalError) << "before bind";
  const BindingSet unset(device(), job.layout);
  EXPECT_THAT(messageOf<InternalError>([&] { commands.bind(job.pipeline, unset); }), HasSubstr("slot 0"));
  const BindingLayout other(device(), {{0, BindingType::storageBuffer}}, 0);
  EXPECT_THROW(commands.bind(job.pipeline, BindingSet(device(), other)), InternalError) << "another layout";
  EXPECT_THROW(job.set.set(9, job.in), InternalError) << "no such slot";
  EXPECT_THROW(job.set.set(0, job.floats), InternalError) << "not a storage buffer";
  commands.bind(job.pipeline, job.set);
  EXPECT_THROW(commands.push(std::array<std::uint32_t, 3>{}), InternalError) << "more than declared";
  EXPECT_THROW(commands.dispatch(0xffffffffu), InternalError) << "beyond the limit";
  EXPECT_THROW(commands.dispatchIndirect(job.in, 0), InternalError) << "not an indirect buffer";
  EXPECT_THROW(commands.fill(job.out, 0, job.out.sizeBytes() + 4, 0), InternalError);
  EXPECT_THROW(commands.copy(job.in, 8, job.out, 0, job.in.sizeBytes()), InternalError);
  EXPECT_THROW(commands.endSpan(), InternalError);
  commands.beginSpan("outer");
  EXPECT_THROW(commands.beginSpan("inner"), InternalError);
  EXPECT_THROW(embeddedShader("nowhere.comp"), InternalError);
  EXPECT_THROW(ComputePipeline(device(), job.layout, embeddedShader("scale_add.comp"), {{1, 1}, {1, 2}}), InternalError)
      << "a constant twice";
}

TEST_F(GpuTest, PipelinesAndSetsOutliveTheirLayout) {
  Spin spin(device());
  spin.layout = BindingLayout();
  const Buffer other = Buffer::of(device(), "other", std::vector<std::uint32_t>{1}, useStorage);
  spin.set.set(0, other);
  Commands commands(device());
  commands.begin();
  spin.record(commands, {1, 5});
  commands.submitAndWait();
  EXPECT_EQ(other.readAll<std::uint32_t>().front(), Spin::expected(5));
}

// In a process of its own: what a device may still use is kept, so the process must end while it runs.
TEST_F(GpuTest, AWaitBeyondItsTimeIsAnErrorAndNothingIsFreed) {
  const auto waitTooShort = [] {
    const Device own = Device::open();
    const std::string message = messageOf<InternalError>([&] {
      const Spin spin(own);
      Commands commands(own);
      commands.begin();
      spin.record(commands, {100, 600}, 65535);  // some seconds of work
      commands.submitAndWait(0.001);
    });
    std::fputs(message.c_str(), stderr);
    std::fflush(stderr);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT((waitTooShort(), std::_Exit(0)), testing::ExitedWithCode(0), "did not finish within 0.001 s");
}

}  // namespace
}  // namespace crosslight::gpu
