// Whatever fits a line is written on it.
#include "scenegen/json_text.h"

namespace crosslight::scenegen {
namespace {

constexpr std::size_t kLineLength = 110;

std::string inlineText(const Json& json) {
  if (!json.is_structured()) return json.dump();
  std::string text(1, json.is_object() ? '{' : '[');
  for (const auto& [key, value] : json.items()) {
    if (text.size() > 1) text += ", ";
    if (json.is_object()) text.append(Json(key).dump()).append(": ");
    text += inlineText(value);
  }
  text += json.is_object() ? '}' : ']';
  return text;
}

bool isVector(const Json& json) {  // a matrix at most
  if (!json.is_array() || json.size() > 16) return false;
  for (const Json& element : json) {
    if (!element.is_number()) return false;
  }
  return true;
}

void append(std::string& out, const Json& json, std::size_t indent, std::size_t column) {
  const std::string line = inlineText(json);
  if (!json.is_structured() || json.empty() || isVector(json) || column + line.size() <= kLineLength) {
    out += line;
    return;
  }
  const bool object = json.is_object();
  out += object ? "{" : "[";
  const char* separator = "\n";
  for (const auto& [key, value] : json.items()) {
    std::string name;
    if (object) name.append(Json(key).dump()).append(": ");
    out.append(separator).append(indent + 1, ' ').append(name);
    append(out, value, indent + 1, indent + 1 + name.size());
    separator = ",\n";
  }
  out.append("\n").append(indent, ' ').append(object ? "}" : "]");
}

}  // namespace

std::string toText(const Json& json) {
  std::string out;
  append(out, json, 0, 0);
  return out + "\n";
}

}  // namespace crosslight::scenegen
