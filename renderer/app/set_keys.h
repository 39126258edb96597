// The table behind `--set key=value`: a row is a key, its values, what it does, where, and how it is applied.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "app/command_model.h"
#include "scene/settings.h"

namespace crosslight {

struct SetKey {
  const char* key;
  std::vector<std::string> values;  // the first one is the default
  const char* meaning;
  std::vector<Method> methods;  // that heed it; empty: all
  void (*apply)(RenderSettings& settings, std::size_t value);
  // Of a key without `values`: a number within limits.
  struct Number {
    double fallback = 0, lowest = 0, highest = 0;
    bool whole = false;
    void (*apply)(RenderSettings& settings, double value) = nullptr;
  };
  Number number = {};
};

const std::vector<SetKey>& setKeys();

// Every "key=value" there is, in the order of the table.
std::vector<std::string> allSetPairs();
// For help.
std::vector<KeyModel> setKeysExplained();

// UsageError on an unknown key or value, listing what there is.
const SetKey& applySet(const std::string& pair, RenderSettings& settings);

}  // namespace crosslight
