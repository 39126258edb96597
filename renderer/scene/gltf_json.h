// A JSON value together with the file and the path that lead to it, so that every complaint names its place. All
// reading of glTF's JSON by this room goes through here: wrong types and values out of range end in an InputError.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crosslight::gltf {

using Json = nlohmann::json;

// Closed interval, or open at its lower end. The default is every value that a float can hold.
struct Range {
  double lower = -double{std::numeric_limits<float>::max()};
  double upper = double{std::numeric_limits<float>::max()};
  bool lowerExcluded = false;

  static Range atLeast(double bound) { return {bound, double{std::numeric_limits<float>::max()}, false}; }
  static Range above(double bound) { return {bound, double{std::numeric_limits<float>::max()}, true}; }
  static Range between(double low, double high) { return {low, high, false}; }
};

// Integers in glTF are offsets, counts and indices; JSON numbers are exact up to 2^53.
inline constexpr std::int64_t kLargestInteger = std::int64_t{1} << 53;

class JsonAt {
 public:
  // `file` must outlive this object.
  JsonAt(const Json& value, const std::string& file, std::string path)
      : value_(&value), file_(&file), path_(std::move(path)) {}

  const Json& value() const { return *value_; }
  const std::string& path() const { return path_; }
  const std::string& file() const { return *file_; }
  std::string place() const;  // "scene.gltf: /nodes/3"

  std::optional<JsonAt> find(std::string_view key) const;  // InputError when this is no object
  JsonAt at(std::string_view key) const;                   // InputError when it is missing
  std::optional<JsonAt> extension(std::string_view name) const;

  std::size_t arraySize() const;  // InputError when this is no array
  JsonAt item(std::size_t index) const;
  std::vector<JsonAt> items() const;

  std::int64_t integer(std::int64_t lower = 0, std::int64_t upper = kLargestInteger) const;
  std::size_t reference(std::size_t count, std::string_view what) const;  // an index that exists
  double number(const Range& range = {}) const;
  bool boolean() const;
  const std::string& string() const;
  std::vector<double> numbers(std::size_t count, const Range& range = {}) const;
  glm::vec3 vec3(const Range& range = {}) const;
  std::string oneOf(std::initializer_list<std::string_view> names) const;
  void object() const;  // InputError when it is none

  // Names a property that is not in the list ("extensions" and "extras" always are).
  void onlyKnows(std::initializer_list<std::string_view> names) const;

  [[noreturn]] void fail(const std::string& what) const;
  void warn(const std::string& what) const;

 private:
  const Json* value_;
  const std::string* file_;
  std::string path_;
};

// Members that may be missing.
double numberOr(const JsonAt& object, std::string_view key, double fallback, const Range& range = {});
glm::vec3 vec3Or(const JsonAt& object, std::string_view key, const glm::vec3& fallback, const Range& range = {});
std::int64_t integerOr(const JsonAt& object, std::string_view key, std::int64_t fallback,
                       std::int64_t upper = kLargestInteger);
std::string stringOr(const JsonAt& object, std::string_view key, const std::string& fallback);
bool booleanOr(const JsonAt& object, std::string_view key, bool fallback);
// -1 when it is missing.
int referenceOr(const JsonAt& object, std::string_view key, std::size_t count, std::string_view what);

}  // namespace crosslight::gltf
