#include "app/explain.h"

#include <algorithm>
#include <limits>

#include "base/time.h"
#include "effects/effects.h"
#include "effects/forced.h"
#include "measure/metrics.h"

namespace crosslight {
namespace {

double renderMsOf(const RenderResult& result) {
  for (const auto& [phase, wallMs] : result.report.timesMs) {
    if (phase == "render") return wallMs;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

RenderRequest with(const RenderRequest& request, const std::string& name, bool on) {
  RenderRequest changed = request;
  changed.warnsOfForced = false;
  changed.settings.forcedEffects.push_back({name, on});
  return changed;
}

// Frames of two plans in turn, so that what disturbs one disturbs the other.
struct Pair {
  std::vector<double> firstMs, secondMs;
  Image first, second;
};

class Measuring {
 public:
  Measuring(gpu::Device& device, const RenderRequest& request, const ExplainOptions& options,
            const ExplainProgress& say, std::uint64_t pairs)
      : device_(device),
        session_(device),
        request_(request),
        options_(options),
        say_(say),
        total_(pairs * 2 * (options.rounds + 1) + 4) {}

  // The first frames warm up: they compile.
  Pair alternate(const RenderRequest& a, const RenderRequest& b) {
    Pair pair;
    pair.first = draw(a).image;
    pair.second = draw(b).image;
    for (std::uint32_t round = 0; round < options_.rounds; ++round) {
      pair.firstMs.push_back(renderMsOf(draw(a)));
      pair.secondMs.push_back(renderMsOf(draw(b)));
    }
    return pair;
  }

  PlanCost costOf(const RenderRequest& request) {
    device_.takePipelineMakings();
    const Stopwatch watch;
    const RenderResult first = draw(request);
    PlanCost cost;
    cost.firstFrameMs = watch.elapsedMs();
    cost.pipelines = device_.takePipelineMakings();
    cost.passes = draw(request).report.gpuMs;  // of a frame that compiles nothing
    cost.rays = first.report.rays;
    cost.counters = first.report.counters;
    return cost;
  }

  void comparePlans(Explanation& e) {
    RenderRequest full = request_;
    full.settings.allEffects = true;
    e.specialized = costOf(request_);
    e.full = costOf(full);
    const Pair pair = alternate(request_, full);
    e.specialized->medianMs = median(pair.firstMs);
    e.full->medianMs = median(pair.secondMs);
    e.fullRatio = ratioEstimate(pair.secondMs, pair.firstMs);
  }

  // On: it is left out. Off: it is compiled in, which changes no bit.
  Measured measure(const EffectRecord& verdict) {
    const Pair pair = alternate(request_, with(request_, verdict.name, !verdict.on));
    const Metrics error = measureImages(pair.second, pair.first);
    return {verdict.on ? ratioEstimate(pair.firstMs, pair.secondMs) : ratioEstimate(pair.secondMs, pair.firstMs),
            error.maxAbs, error.rmse};
  }

 private:
  RenderResult draw(const RenderRequest& request) {
    if (say_) say_(done_++, total_);
    return session_.render(request);
  }

  gpu::Device& device_;
  RenderSession session_;
  const RenderRequest& request_;
  const ExplainOptions& options_;
  const ExplainProgress& say_;
  std::uint64_t done_ = 0, total_;
};

bool isForced(const RenderSettings& settings, const std::string& name) {
  return forcedState(settings, name).has_value();
}

}  // namespace

Explanation explain(gpu::Device* device, const RenderRequest& request, const ExplainOptions& options,
                    const ExplainProgress& say) {
  const Plan plan = makePlan(*request.scene, request.settings);
  Explanation e;
  for (const EffectVerdict& v : plan.verdicts) e.effects.push_back({{v.name, v.on, v.reason, v.leftOut}, {}});
  for (const LightVerdict& l : plan.lightShadows) e.lightShadows.push_back({l.name, l.shadows, l.reason});
  e.rayDepth = plan.maxDepth;
  e.depthReason = plan.depthReason;
  e.constants = {{"models", plan.models}, {"lights", plan.lights}, {"shapes", plan.shapes}, {"effects", plan.effects}};
  if (device == nullptr || options.quick) return e;
  const auto counts = [&](const ExplainedEffect& effect) {
    return !isForced(request.settings, effect.verdict.name) && (effect.verdict.on || options.measureOff);
  };
  const auto pairs = static_cast<std::uint64_t>(std::count_if(e.effects.begin(), e.effects.end(), counts));
  Measuring measuring(*device, request, options, say, pairs + 1);
  measuring.comparePlans(e);
  for (ExplainedEffect& effect : e.effects) {
    if (counts(effect)) effect.measured = measuring.measure(effect.verdict);
  }
  return e;
}

}  // namespace crosslight
