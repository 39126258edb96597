#include "app/suggest.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace crosslight {
namespace {

// One typo per two letters still reads as the word ("fong", phong); more would suggest strangers ("box" for "fog").
constexpr std::size_t kLettersPerTypo = 2;

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

std::size_t editDistance(const std::string& a, const std::string& b) {
  // Rows of the table of distances between prefixes: two rows back for a swap of neighbors.
  std::vector<std::size_t> before, previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({replaced, previous[j] + 1, current[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], before[j - 2] + 1);
      }
    }
    before = previous;
    previous = current;
  }
  return previous[b.size()];
}

std::optional<std::string> nearest(const std::string& word, std::span<const std::string> known) {
  std::optional<std::string> best;
  std::size_t bestDistance = std::max<std::size_t>(1, word.size() / kLettersPerTypo) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = editDistance(lowerCase(word), lowerCase(candidate));
    if (distance < bestDistance) {
      bestDistance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string unknownWord(const std::string& what, const std::string& word, std::span<const std::string> known) {
  std::string text = "unknown " + what + " '" + word + "'; there are " + joined(known, ", ");
  if (const auto meant = nearest(word, known)) text += ". Did you mean '" + *meant + "'?";
  return text;
}

std::string joined(std::span<const std::string> words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += separator;
    text += word;
  }
  return text;
}

}  // namespace crosslight
