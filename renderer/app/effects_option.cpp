#include "app/effects_option.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "app/suggest.h"
#include "base/error.h"
#include "effects/forced.h"

namespace crosslight {
namespace {

std::vector<std::string> partsOf(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

double withinOf(const std::string& word) {
  const std::string digits = word.substr(word.find('=') + 1);
  double bound = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), bound);
  if (error != std::errc{} || stop != digits.data() + digits.size() || !std::isfinite(bound) || !(bound > 0))
    throw UsageError("--effects: '" + word + "' needs a radiance above 0, as in within=0.001");
  return bound;
}

void force(const std::string& word, RenderSettings& settings) {
  const std::vector<std::string> known = effectNames();
  const bool isSigned = !word.empty() && (word[0] == '+' || word[0] == '-');
  const std::string name = word.substr(isSigned ? 1 : 0);
  const bool exists = std::find(known.begin(), known.end(), name) != known.end();
  if (!exists) throw UsageError("--effects: " + unknownWord("effect", name, known));
  if (!isSigned) {
    throw UsageError("--effects: '" + name + "' needs a sign: +" + name + " compiles it in, -" + name +
                     " leaves it out");
  }
  const bool on = word[0] == '+';
  if (forcedState(settings, name) == !on)
    throw UsageError("--effects: +" + name + " and -" + name + " exclude each other");
  settings.forcedEffects.push_back({name, on});
}

}  // namespace

void applyEffects(const std::string& text, RenderSettings& settings) {
  settings.allEffects = false;
  settings.forcedEffects.clear();
  settings.effectsWithin = 0;
  const std::vector<std::string> parts = partsOf(text);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool isBase = parts[i] == "auto" || parts[i] == "all";
    if (isBase && i > 0) throw UsageError("--effects: '" + parts[i] + "' comes first: " + parts[i] + ",-fog");
    if (isBase) {
      settings.allEffects = parts[i] == "all";
    } else if (parts[i].rfind("within=", 0) == 0) {
      settings.effectsWithin = withinOf(parts[i]);
    } else {
      force(parts[i], settings);
    }
  }
}

std::string effectsExplained() {
  return "Compile and run what the scene calls for, or everything: the image is the same. A list forces single ones, "
         "as in -fog,+shadows: + compiles one in, which changes no bit either; - leaves one out though it is called "
         "for, and then the image is another; within=E cuts reflections that are proven to bring a pixel at most the "
         "linear radiance E. The names are those of 'crosslight explain'";
}

std::string wordOf(const ForcedEffect& forced) { return (forced.on ? "+" : "-") + forced.name; }

}  // namespace crosslight
