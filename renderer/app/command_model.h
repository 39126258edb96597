// The command line as plain data: what help, man page, README table and shell completion are all made from.
#pragma once

#include <string>
#include <vector>

namespace crosslight {

// What completion offers for a value.
enum class ValueKind { none, text, choice, keyValue, file };

// One key of an option KEY=VALUE.
struct KeyModel {
  std::string head;  // "shadows=on|off", the default first
  std::string meaning;
  std::string methods;  // that heed it: "flat, gouraud"; empty: all
};

struct OptionModel {
  std::vector<std::string> names;  // "-o", "--output"; empty for a positional argument
  std::string value;               // placeholder: "FILE", "WxH"; empty for a flag
  std::string description;
  std::string group;
  std::string defaultText;           // empty: none worth showing
  std::vector<std::string> choices;  // of choice: the values; of keyValue: every "key=value"
  std::vector<KeyModel> keys;        // of keyValue
  ValueKind kind = ValueKind::none;
  bool repeatable = false;

  bool positional() const { return names.empty(); }
  const std::string& longName() const { return names.back(); }
};

struct CommandModel {
  std::string name;
  std::string summary;               // one line
  std::string details;               // paragraphs, separated by an empty line
  std::string synopsis;              // "render SCENE -o OUT [option...]"
  std::vector<OptionModel> options;  // in the order of declaration, positional ones first
};

struct ExitCodeModel {
  int code;
  std::string meaning;
};

struct ProgramModel {
  std::string name;
  std::string version;
  std::string summary;
  std::string details;
  std::vector<OptionModel> options;  // before any command
  std::vector<CommandModel> commands;
  std::vector<ExitCodeModel> exitCodes;
  std::vector<std::pair<std::string, std::string>> environment;  // variable, what it does
};

// Names joined with commas and the placeholder: "-o, --output FILE".
std::string headOf(const OptionModel& option);
// Description and default as sentences.
std::string explanationOf(const OptionModel& option);
std::string explanationOf(const KeyModel& key);
// Group names in the order of first use.
std::vector<std::string> groupsOf(const std::vector<OptionModel>& options);

// The renderings of the model; each is the whole text.
std::string helpText(const ProgramModel& program);
std::string helpText(const ProgramModel& program, const CommandModel& command);
std::string manPage(const ProgramModel& program);
std::string markdownTable(const ProgramModel& program);
std::string bashCompletion(const ProgramModel& program);
std::string zshCompletion(const ProgramModel& program);
std::string fishCompletion(const ProgramModel& program);

}  // namespace crosslight
