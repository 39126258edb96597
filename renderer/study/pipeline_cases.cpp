// Cases of pipelines and passes: the same depth twice, sums of many samples, the precision that shaders are compiled
// in.
#include <fmt/format.h>

#include <set>
#include <span>

#include "gpu/pipeline.h"
#include "scene/shape_mesh.h"
#include "study/cases.h"
#include "study/pictures.h"

namespace crosslight::study {
namespace {

// What a depth pass has drawn must be met exactly by the pass that shades.
void sameDepthTwice(const Bench& bench, CaseResult& result) {
  Stage stage;
  Primitive torus = tessellateShape(ShapeKind::torus, {1, 0.4f, 0, 0}, 40);
  torus.material = stage.add(lambert(1));
  glm::dmat4 place(1.0);
  place[1] = {0, 0.5, 0.8, 0};
  place[2] = {0, -0.8, 0.5, 0};
  place[3] = {0.1, 0, -4, 1};
  stage.addMesh(torus, place);
  stage.scene.lights = {sunAlong({0.3, -0.2, -1})};
  RenderSettings s = settingsFor(Method::phong, 128, 96);
  s.depthPrepass = DepthPrepass::off;
  const Shot once = bench.draw(stage.scene, s);
  s.depthPrepass = DepthPrepass::on;
  const Shot twice = bench.draw(stage.scene, s);
  std::uint64_t shown = 0, lost = 0;
  for (std::size_t i = 0; i < once.image.pixels(); ++i) {
    const float a = once.image.picture().samples[4 * i + 3], b = twice.image.picture().samples[4 * i + 3];
    shown += a > 0;
    lost += a != b || once.image.picture().samples[4 * i] != twice.image.picture().samples[4 * i];
  }
  result.count("phong", "pixels that a second pass at the same depth loses or changes", lost, shown);
}

void manySamples(const Bench& bench, CaseResult& result) {
  const std::uint32_t samples = bench.full ? 16384 : 2048;
  Stage stage;
  stage.addWall(-2.0, stage.add(emitter(0.1f)));
  float sum = 0;
  for (std::uint32_t i = 0; i < samples; ++i) sum += 0.1f;
  for (const Method method : kRasterAndRays) {
    RenderSettings s = settingsFor(method, 4, 4);
    s.spp = samples;
    const Shot shot = bench.draw(stage.scene, s);
    Worst worst;
    for (std::size_t i = 0; i < shot.image.pixels(); ++i) worst.addRelative(shot.image.picture().samples[4 * i], 0.1f);
    worst.addNaive(std::abs(static_cast<double>(sum / static_cast<float>(samples)) / 0.1f - 1));
    result.measure(techniqueOf(method), fmt::format("mean of {} equal samples", samples), worst, 1e-6, "relative");
  }
}

template <class Visit>  // (opcode, words of the instruction)
void eachInstruction(std::span<const std::uint32_t> module, const Visit& visit) {
  constexpr std::size_t kHeaderWords = 5;
  for (std::size_t at = kHeaderWords; at < module.size();) {
    const std::size_t length = std::max(module[at] >> 16, 1u);
    visit(module[at] & 0xffffu, module.subspan(at, std::min(length, module.size() - at)));
    at += length;
  }
}

// Floating-point results and variables of a SPIR-V module with the decoration RelaxedPrecision. (GLSL has the lane's
// number in its subgroup as a mediump integer: that loses nothing.)
std::uint64_t relaxedIn(std::span<const std::uint32_t> module) {
  enum : std::uint32_t {
    typeFloat = 22,
    typeVector = 23,
    typeMatrix = 24,
    typeArray = 28,
    typePointer = 32,
    decorate = 71,
    memberDecorate = 72
  };
  constexpr std::uint32_t kRelaxedPrecision = 0;
  std::set<std::uint32_t> relaxed, floats;
  std::uint64_t found = 0;
  eachInstruction(module, [&](std::uint32_t code, std::span<const std::uint32_t> words) {
    if (code == decorate && words[2] == kRelaxedPrecision) relaxed.insert(words[1]);
    if (code == memberDecorate && words[3] == kRelaxedPrecision) ++found;
    const bool ofElements = code == typeVector || code == typeMatrix || code == typeArray;
    if (code == typeFloat || (ofElements && floats.contains(words[2])) ||
        (code == typePointer && floats.contains(words[3])))
      floats.insert(words[1]);
    const bool hasResult = words.size() > 2 && relaxed.contains(words[2]);  // type, then id
    found += hasResult && floats.contains(words[1]);
  });
  return found;
}

void noReducedPrecision(const Bench&, CaseResult& result) {
  std::uint64_t relaxed = 0, modules = 0;
  for (const gpu::ShaderCode& code : gpu::embeddedShaders()) {
    relaxed += relaxedIn(code.words);
    ++modules;
  }
  // One unit in the last place of a half below 1, to the hundredth power: 5 % of a highlight.
  result.count("host", "floating-point values that shaders may compute in reduced precision", relaxed, modules,
               1 - std::pow(1 - 0x1p-11, 100.0));
}

}  // namespace

std::vector<HardCase> pipelineCases() {
  return {
      {"R4", "the same depth in two passes",
       "vertices in another order give another depth: surfaces lose pixels to themselves",
       "the same draw twice: the same bits", true, sameDepthTwice, nullptr,
       "what another order would lose is the device's"},
      {"G8", "sums of thousands of samples", "a plain sum in single precision drifts, and stops at 2^24",
       "1e-6 as the catalog has it", true, manySamples},
      {"I6", "reduced precision", "mediump has 11 bits: its last one is 5 % of a highlight of shininess 100",
       "no module may be decorated so", true, noReducedPrecision},
  };
}

}  // namespace crosslight::study
