#include "base/text.h"

#include <algorithm>

namespace crosslight {

std::string printable(std::string_view text) {
  const auto steers = [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7f; };
  std::string shown(text);
  std::replace_if(shown.begin(), shown.end(), steers, '?');
  return shown;
}

}  // namespace crosslight
