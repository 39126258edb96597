// From the text of a batch file to the options of its items.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/command_line.h"
#include "app/render_batch.h"
#include "app/suggest.h"
#include "base/error.h"

namespace crosslight {
namespace {

// Keys for what is no long option, and options that are not an item's.
constexpr const char* kSceneKey = "scene";
constexpr const char* kSceneNameKey = "scene-name";
const std::set<std::string> kOfTheProcess = {"device", "require-device", "list-devices", "batch",  "stop-on-error",
                                             "help",   "progress",       "quiet",        "verbose"};

struct Entry {
  Json value;
  std::string where;  // file, and item or line
};

std::vector<Entry> entriesOf(const std::string& text, const std::string& where) {
  const auto parse = [](const std::string& json, const std::string& place) {
    try {
      return Json::parse(json);
    } catch (const Json::exception& error) {
      throw InputError(place, std::string("is not valid JSON: ") + error.what());
    }
  };
  std::vector<Entry> entries;
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start != std::string::npos && text[start] == '[') {
    const Json all = parse(text, where);
    for (std::size_t i = 0; i < all.size(); ++i) entries.push_back({all[i], fmt::format("{}: /{}", where, i)});
    return entries;
  }
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string place = fmt::format("{}: line {}", where, number);
    entries.push_back({parse(line, place), place});
  }
  return entries;
}

// One item, parsed by the same declarations as the command line.
class ItemParser {
 public:
  ItemParser(const Entry& entry, const RenderOptions& defaults) : entry_(entry), item_(defaults) {
    // These are the batch's own.
    item_.batch.clear();
    item_.json.clear();
    CLI::App& command = line_.add("render", "", "");
    addRenderOptions(line_, command, item_);
    const ProgramModel model = line_.model();
    for (const OptionModel& option : model.commands.front().options) {
      if (option.positional()) continue;
      const std::string name = option.longName().substr(2);
      if (kOfTheProcess.contains(name)) continue;
      keys_.push_back(name == kSceneKey ? kSceneNameKey : name);
      if (option.kind == ValueKind::none) flags_.insert(name);
      if (option.repeatable) lists_.insert(name);
    }
    keys_.push_back(kSceneKey);
  }

  RenderOptions parse() {
    if (!entry_.value.is_object()) throw InputError(entry_.where, "is no JSON object");
    const std::vector<std::string> defaultSet = item_.set;
    std::vector<std::string> words = {"crosslight", "render"};
    for (const auto& [key, value] : entry_.value.items()) addWords(key, value, words);
    try {
      line_.parse(words);
    } catch (const UsageError& error) {
      const std::string text = error.what();
      throw InputError(entry_.where, text.substr(0, text.find("\n  'crosslight")));
    }
    // What an item sets comes after, and so wins over, what is set for all.
    if (entry_.value.contains("set")) item_.set.insert(item_.set.begin(), defaultSet.begin(), defaultSet.end());
    return item_;
  }

 private:
  std::string placeOf(const std::string& key) const {
    return entry_.where + (entry_.where.ends_with("/") ? "" : "/") + key;
  }

  void addWords(const std::string& key, const Json& value, std::vector<std::string>& words) {
    if (std::find(keys_.begin(), keys_.end(), key) == keys_.end()) {
      if (kOfTheProcess.contains(key)) {
        throw InputError(placeOf(key), "belongs on the command line: it is of all items together");
      }
      throw InputError(entry_.where, unknownWord("key", key, keys_));
    }
    if (key == kSceneKey) {
      item_.scene = wordOf(key, value);
      return;
    }
    const std::string name = key == kSceneNameKey ? kSceneKey : key;
    if (value.is_array() && lists_.contains(name)) {
      for (const Json& one : value) words.push_back("--" + name + "=" + wordOf(key, one));
      return;
    }
    words.push_back("--" + name + "=" + wordOf(key, value));
  }

  std::string wordOf(const std::string& key, const Json& value) const {
    const bool flag = flags_.contains(key);
    if (flag != value.is_boolean()) {
      throw InputError(placeOf(key), flag ? "must be true or false" : "must be a string or a number");
    }
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number() || value.is_boolean()) return value.dump();
    throw InputError(placeOf(key), "must be a string or a number");
  }

  const Entry& entry_;
  RenderOptions item_;
  CommandLine line_;
  std::vector<std::string> keys_;
  std::set<std::string> flags_, lists_;
};

}  // namespace

std::vector<RenderOptions> batchItems(const std::string& text, const std::string& where,
                                      const RenderOptions& defaults) {
  std::vector<RenderOptions> items;
  for (const Entry& entry : entriesOf(text, where)) {
    items.push_back(ItemParser(entry, defaults).parse());
    if (items.back().json == "-") {
      throw InputError(entry.where + "/json", "standard output is for the record of the batch; name a file");
    }
  }
  if (items.empty())
    throw InputError(where, "has no items: a JSON array of objects, or one object per line, is needed");
  return items;
}

}  // namespace crosslight
