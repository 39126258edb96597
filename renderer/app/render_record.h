// What a finished render says of itself: the JSON record, the image's metadata, the line on stderr.
#pragma once

#include <string>

#include "app/record.h"
#include "app/render_job.h"
#include "app/render_options.h"

namespace crosslight {

Json renderRecord(const RecordHead& head, const Scene& scene, const RenderSettings& settings,
                  const RenderOptions& options, const RenderResult& result);

// Into the image's metadata: what made it. Nothing that differs between two runs with the same bits.
void describeInMetadata(RenderResult& result, const RenderSettings& settings, const gpu::DeviceInfo& device);

// Phases that ran in a thread beside others. What was waited for them counts as a phase of its own: the other phases
// add up to the total, or less.
bool runsBeside(const std::string& phase);
void setTimings(Json& record, const Times& timesMs);

// "412 ms (load 3, device 60, ...)"; what ran beside other phases stands in brackets.
std::string timesText(const Times& timesMs);

}  // namespace crosslight
