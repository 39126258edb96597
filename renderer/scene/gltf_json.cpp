// Typed reading of JSON values that knows where it is.
#include "scene/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/log.h"

namespace crosslight::gltf {
namespace {

// RFC 6901: "~" and "/" inside a name are escaped.
std::string pointerToken(std::string_view key) {
  std::string token;
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

std::string joined(std::initializer_list<std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) {
    if (!text.empty()) text += ", ";
    text += name;
  }
  return text;
}

// What a file says ends up in terminals: no control characters, no pages of text.
std::string printable(std::string text) {
  constexpr std::size_t kMaxShown = 400;
  if (text.size() > kMaxShown) {
    text.resize(kMaxShown);
    text += "...";
  }
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

}  // namespace

std::string JsonAt::place() const { return *file_ + ": " + (path_.empty() ? std::string("/") : printable(path_)); }

void JsonAt::fail(const std::string& what) const { throw InputError(place(), printable(what)); }

void JsonAt::warn(const std::string& what) const { logWarning(place() + ": " + printable(what)); }

void JsonAt::object() const {
  if (!value_->is_object()) fail(fmt::format("must be an object, is {}", value_->type_name()));
}

std::optional<JsonAt> JsonAt::find(std::string_view key) const {
  object();
  const auto it = value_->find(std::string(key));
  if (it == value_->end()) return std::nullopt;
  return JsonAt(*it, *file_, path_ + "/" + pointerToken(key));
}

JsonAt JsonAt::at(std::string_view key) const {
  std::optional<JsonAt> member = find(key);
  if (!member) fail(fmt::format("needs the property '{}'", key));
  return *member;
}

std::optional<JsonAt> JsonAt::extension(std::string_view name) const {
  const std::optional<JsonAt> extensions = find("extensions");
  if (!extensions) return std::nullopt;
  std::optional<JsonAt> found = extensions->find(name);
  if (found) found->object();
  return found;
}

std::size_t JsonAt::arraySize() const {
  if (!value_->is_array()) fail(fmt::format("must be an array, is {}", value_->type_name()));
  return value_->size();
}

JsonAt JsonAt::item(std::size_t index) const {
  return JsonAt((*value_)[index], *file_, path_ + "/" + std::to_string(index));
}

std::vector<JsonAt> JsonAt::items() const {
  std::vector<JsonAt> all;
  const std::size_t count = arraySize();
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i) all.push_back(item(i));
  return all;
}

std::int64_t JsonAt::integer(std::int64_t lower, std::int64_t upper) const {
  if (!value_->is_number_integer()) fail(fmt::format("must be an integer, is {}", value_->dump()));
  // A number above 2^63 is unsigned in the parser's value and would wrap.
  const bool huge = value_->is_number_unsigned() && value_->get<std::uint64_t>() > std::uint64_t{1} << 62;
  const std::int64_t number = huge ? std::numeric_limits<std::int64_t>::max() : value_->get<std::int64_t>();
  if (number < lower || number > upper) {
    fail(fmt::format("must be in [{}, {}], is {}", lower, upper, value_->dump()));
  }
  return number;
}

std::size_t JsonAt::reference(std::size_t count, std::string_view what) const {
  const std::int64_t index = integer();
  if (static_cast<std::uint64_t>(index) >= count) {
    fail(fmt::format("refers to {} {}, the file has {}", what, index, count));
  }
  return static_cast<std::size_t>(index);
}

double JsonAt::number(const Range& range) const {
  if (!value_->is_number()) fail(fmt::format("must be a number, is {}", value_->type_name()));
  const double number = value_->get<double>();
  const bool below = range.lowerExcluded ? !(number > range.lower) : !(number >= range.lower);
  if (below || !(number <= range.upper)) {
    const char bracket = range.lowerExcluded ? '(' : '[';
    fail(fmt::format("must be in {}{:g}, {:g}], is {:g}", bracket, range.lower, range.upper, number));
  }
  return number;
}

bool JsonAt::boolean() const {
  if (!value_->is_boolean()) fail(fmt::format("must be true or false, is {}", value_->type_name()));
  return value_->get<bool>();
}

const std::string& JsonAt::string() const {
  if (!value_->is_string()) fail(fmt::format("must be a string, is {}", value_->type_name()));
  return value_->get_ref<const std::string&>();
}

std::vector<double> JsonAt::numbers(std::size_t count, const Range& range) const {
  if (arraySize() != count) fail(fmt::format("must have {} numbers, has {}", count, arraySize()));
  std::vector<double> all;
  for (const JsonAt& entry : items()) all.push_back(entry.number(range));
  return all;
}

glm::vec3 JsonAt::vec3(const Range& range) const {
  const std::vector<double> all = numbers(3, range);
  return {static_cast<float>(all[0]), static_cast<float>(all[1]), static_cast<float>(all[2])};
}

std::string JsonAt::oneOf(std::initializer_list<std::string_view> names) const {
  const std::string& text = string();
  if (std::find(names.begin(), names.end(), text) == names.end()) {
    fail(fmt::format("must be one of {}; is '{}'", joined(names), text));
  }
  return text;
}

void JsonAt::onlyKnows(std::initializer_list<std::string_view> names) const {
  object();
  for (const auto& [key, ignored] : value_->items()) {
    if (key == "extras") continue;
    if (key == "extensions") {
      at(key).object();
      continue;
    }
    if (std::find(names.begin(), names.end(), key) == names.end()) {
      at(key).fail(fmt::format("is not known here; there are {}", joined(names)));
    }
  }
}

double numberOr(const JsonAt& object, std::string_view key, double fallback, const Range& range) {
  const auto member = object.find(key);
  return member ? member->number(range) : fallback;
}

glm::vec3 vec3Or(const JsonAt& object, std::string_view key, const glm::vec3& fallback, const Range& range) {
  const auto member = object.find(key);
  return member ? member->vec3(range) : fallback;
}

std::int64_t integerOr(const JsonAt& object, std::string_view key, std::int64_t fallback, std::int64_t upper) {
  const auto member = object.find(key);
  return member ? member->integer(0, upper) : fallback;
}

std::string stringOr(const JsonAt& object, std::string_view key, const std::string& fallback) {
  const auto member = object.find(key);
  return member ? member->string() : fallback;
}

bool booleanOr(const JsonAt& object, std::string_view key, bool fallback) {
  const auto member = object.find(key);
  return member ? member->boolean() : fallback;
}

int referenceOr(const JsonAt& object, std::string_view key, std::size_t count, std::string_view what) {
  const auto member = object.find(key);
  return member ? static_cast<int>(member->reference(count, what)) : -1;
}

}  // namespace crosslight::gltf
