#include "gpu/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "base/error.h"

namespace crosslight::gpu {
namespace {

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// The fastest kind first; software last.
std::size_t rankOf(const std::string& type) {
  static constexpr std::array<std::string_view, 5> kOrder{"discrete", "integrated", "virtual", "other", "cpu"};
  return static_cast<std::size_t>(std::find(kOrder.begin(), kOrder.end(), type) - kOrder.begin());
}

bool matches(const DeviceInfo& info, const std::string& selector) {
  if (selector.empty()) return true;
  if (std::all_of(selector.begin(), selector.end(), [](unsigned char c) { return std::isdigit(c) != 0; })) {
    std::uint32_t index = 0;
    const auto parsed = std::from_chars(selector.data(), selector.data() + selector.size(), index);
    return parsed.ec == std::errc() && index == info.index;
  }
  const std::string wanted = lowerCase(selector);
  if (wanted == "lavapipe") return info.isSoftware && info.driverName == "llvmpipe";
  return lowerCase(info.name).find(wanted) != std::string::npos;
}

std::string listOf(std::span<const DeviceReport> reports) {
  std::string text;
  for (const DeviceReport& report : reports) {
    text += fmt::format("\n  {}: {} ({}, Vulkan {})", report.info.index, report.info.name, report.info.type,
                        report.info.apiVersion);
    for (const std::string& refusal : report.refusals) text += "\n     refused: " + refusal;
  }
  return text;
}

}  // namespace

std::size_t chooseDevice(std::span<const DeviceReport> reports, const std::string& selector) {
  if (reports.empty()) {
    throw DeviceError(
        "no Vulkan driver was found; install the driver of your GPU, or the software driver lavapipe (Debian and "
        "Ubuntu: package "
        "mesa-vulkan-drivers)");
  }
  std::size_t best = reports.size();
  bool anyMatch = false;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    if (!matches(reports[i].info, selector)) continue;
    anyMatch = true;
    if (!reports[i].usable()) continue;
    if (best == reports.size() || rankOf(reports[i].info.type) < rankOf(reports[best].info.type)) best = i;
  }
  if (best != reports.size()) return best;
  const std::string asked = selector.empty() ? std::string() : fmt::format(" matches '{}'", selector);
  if (!anyMatch) {
    throw DeviceError(fmt::format("no Vulkan device{}; there is:{}\nchoose one by its number or part of its name",
                                  asked, listOf(reports)));
  }
  throw DeviceError(
      fmt::format("no Vulkan device that can be used{}:{}\na newer driver may help", asked, listOf(reports)));
}

}  // namespace crosslight::gpu
