#include "study/stability_page.h"

#include <fmt/format.h>

#include "image/image_io.h"

namespace crosslight::study {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Numerically hard cases</title><style>
body { font: 16px/1.45 sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #222; background: #fff; }
table { border-collapse: collapse; margin: .5em 0; font-size: .9em; }
td, th { padding: .2em .7em; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top; }
td.n { font-variant-numeric: tabular-nums; white-space: nowrap; text-align: right; }
h2 { margin: 2em 0 .3em; font-size: 1.1em; border-top: 1px solid #bbb; padding-top: .8em; }
.pass { color: #14672b; } .fail { color: #b00020; font-weight: bold; } .expected-fail { color: #8a5a00; }
figure { display: inline-block; margin: .5em 1em .5em 0; vertical-align: top; font-size: .85em; }
img { image-rendering: pixelated; height: 192px; border: 1px solid #ccc; }
.small { color: #555; font-size: .9em; }
</style></head><body>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

std::string base64(const std::vector<std::byte>& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::string figureOf(const CasePicture& picture) {
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
      escaped(picture.title), base64(pngOf(picture.image)));
}

std::string rowOf(const JudgedCase& c, const Measurement& m) {
  const char* const verdict = nameOf(c.of(m));
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td class=n>{:.9g}</td><td class=n>{:.9g}</td><td class=n>{:.3g}</td><td "
      "class=n>{:.3g}"
      "</td><td>{}</td><td class=n>{}</td><td class={}>{}</td></tr>\n",
      m.technique, escaped(m.what), m.got, m.expected, m.error, m.bound, m.unit,
      m.naive ? fmt::format("{:.3g}", std::abs(*m.naive)) : "", verdict, verdict);
}

std::string sectionOf(const JudgedCase& c) {
  const HardCase& h = *c.hardCase;
  std::string html = fmt::format("<h2 id=\"{0}\">{0} {1}: <span class={2}>{2}</span></h2>\n<p>{3}.</p>\n", h.id,
                                 escaped(h.name), nameOf(c.verdict()), escaped(h.hard));
  html +=
      "<table><tr><th>by</th><th>what</th><th>got</th><th>expected</th><th>error</th><th>bound</th><th>unit</th>"
      "<th>textbook's error</th><th></th></tr>\n";
  for (const Measurement& m : c.result.measurements()) html += rowOf(c, m);
  html += fmt::format("</table>\n<p class=small>Bound: {}.</p>\n", escaped(h.source));
  if (h.expectedFailure != nullptr) html += fmt::format("<p class=small>Known: {}.</p>\n", escaped(h.expectedFailure));
  for (const CasePicture& picture : c.result.pictures()) html += figureOf(picture);
  return html;
}

std::string platformSection(const Platform& platform) {
  std::string html = "<h2>The platform</h2>\n<table>\n";
  for (const PlatformFact& f : platform.facts)
    html += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(f.question), escaped(f.answer));
  html +=
      "</table>\n<table><tr><th>function</th><th>Vulkan demands</th><th>worst, ulp</th><th>absolute</th>"
      "<th>share of what is permitted</th></tr>\n";
  for (const FunctionPrecision& f : platform.functions)
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=n>{:.3g}</td><td class=n>{:.2g}</td><td class=n>{:.2g}</td></tr>\n",
        escaped(f.name), escaped(f.guarantee), f.worstUlp, f.worstAbsolute, f.worstShare);
  return html + "</table>\n";
}

std::string uncoveredSection(const std::vector<const Uncovered*>& uncovered) {
  std::string html = "<h2>Not run</h2>\n<table>\n";
  for (const Uncovered* u : uncovered)
    html +=
        fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", u->id, escaped(u->name),
                    u->notApplicable != nullptr ? "not applicable: " + escaped(u->notApplicable) : "not covered yet");
  return html + "</table>\n";
}

}  // namespace

std::string stabilityPage(const std::string& device, const Platform& platform, const std::vector<JudgedCase>& cases,
                          const std::vector<const Uncovered*>& uncovered) {
  std::size_t counts[3] = {0, 0, 0};
  for (const JudgedCase& c : cases) ++counts[static_cast<std::size_t>(c.verdict())];
  std::string html = kHead;
  html += fmt::format(
      "<h1>Numerically hard cases</h1>\n<p>On {}: {} pass, {} fail, {} fail as expected. Every figure is compared with "
      "a closed "
      "form, or with an evaluation in extended precision that takes the rounded single-precision input as exact. The "
      "textbook's error is that of the usual formula in single precision on the same input.</p>\n",
      escaped(device), counts[0], counts[1], counts[2]);
  for (const JudgedCase& c : cases) html += sectionOf(c);
  if (!uncovered.empty()) html += uncoveredSection(uncovered);
  return html + platformSection(platform) + "</body></html>\n";
}

}  // namespace crosslight::study
