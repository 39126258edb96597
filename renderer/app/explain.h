// What a scene calls for, measured: every effect left out in turn, by forcing; time and pictures with and without it.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/record.h"
#include "app/render_session.h"
#include "measure/statistics.h"

namespace crosslight {

struct ExplainOptions {
  std::uint32_t rounds = 5;
  bool quick = false;       // nothing is measured
  bool measureOff = false;  // effects that are off too: what compiling them in costs
};

// Against a picture with the effect the other way round.
struct Measured {
  Estimate ratio;   // time of a frame with the effect by that without it; 95 % interval
  double maxError;  // linear radiance of the picture; NaN: not finite
  double rmsError;
};

struct ExplainedEffect {
  EffectRecord verdict;
  std::optional<Measured> measured;
};

// What was made and run for a plan.
struct PlanCost {
  std::vector<gpu::PipelineMaking> pipelines;
  double medianMs = 0;      // of a frame
  double firstFrameMs = 0;  // with all that is made for it: pipelines, the driver's late compiling, the frame
  std::vector<std::pair<std::string, double>> passes;  // device milliseconds; empty where there are no timestamps
  std::map<std::string, std::uint64_t> rays, counters;
};

struct Explanation {
  std::vector<ExplainedEffect> effects;
  std::vector<EffectRecord> lightShadows;
  std::uint32_t rayDepth = 0;
  std::string depthReason;
  std::vector<std::pair<std::string, std::uint64_t>> constants;  // of the plan, by name
  std::optional<PlanCost> specialized, full;
  Estimate fullRatio;  // time of the full pipeline's frame by the specialized one's
};

// Told how many frames are drawn, of how many.
using ExplainProgress = std::function<void(std::uint64_t done, std::uint64_t total)>;

// Without a device nothing is drawn.
Explanation explain(gpu::Device* device, const RenderRequest& request, const ExplainOptions& options,
                    const ExplainProgress& say);

std::string explanationTable(const Explanation& explanation, const ExplainOptions& options);
Json explanationJson(const Explanation& explanation);

}  // namespace crosslight
