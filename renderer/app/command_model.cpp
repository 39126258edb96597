#include "app/command_model.h"

#include <algorithm>

#include "app/suggest.h"

namespace crosslight {

std::string headOf(const OptionModel& option) {
  if (option.positional()) return option.value;
  const std::string names = joined(option.names, ", ");
  return option.value.empty() ? names : names + " " + option.value;
}

std::string explanationOf(const OptionModel& option) {
  std::string text = option.description + ".";
  if (option.repeatable) text += " May be given several times.";
  if (!option.defaultText.empty()) text += " Default: " + option.defaultText + ".";
  return text;
}

std::string explanationOf(const KeyModel& key) {
  return key.meaning + "." + (key.methods.empty() ? "" : " Heeded by " + key.methods + ".");
}

std::vector<std::string> groupsOf(const std::vector<OptionModel>& options) {
  std::vector<std::string> groups;
  for (const OptionModel& option : options) {
    if (std::find(groups.begin(), groups.end(), option.group) == groups.end()) groups.push_back(option.group);
  }
  return groups;
}

}  // namespace crosslight
