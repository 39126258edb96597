// Help for the terminal and the options table of the README.
#include <fmt/format.h>

#include <set>
#include <sstream>

#include "app/command_model.h"
#include "app/suggest.h"

namespace crosslight {
namespace {

constexpr std::size_t kWidth = 100;  // columns; a common terminal half a screen wide
constexpr std::size_t kColumn = 30;  // where explanations begin

// Words of `text` in lines of at most kWidth columns, every line after the first indented.
std::string wrapped(const std::string& text, std::size_t column, std::size_t indent) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t at = column;
  bool first = true;
  while (words >> word) {
    if (!first && at + 1 + word.size() > kWidth) {
      result += fmt::format("\n{:{}}", "", indent);
      at = indent;
    } else if (!first) {
      result += " ";
      ++at;
    }
    result += word;
    at += word.size();
    first = false;
  }
  return result;
}

std::string paragraphs(const std::string& text) {
  std::string result;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find("\n\n", begin), text.size());
    result += fmt::format("\n{}\n", wrapped(text.substr(begin, end - begin), 0, 0));
    begin = end + 2;
  }
  return result;
}

std::string entry(const std::string& head, const std::string& explanation) {
  const std::string text = wrapped(explanation, kColumn, kColumn);
  if (head.size() + 4 > kColumn) return fmt::format("  {}\n{:{}}{}\n", head, "", kColumn, text);
  return fmt::format("  {:<{}}{}\n", head, kColumn - 2, text);
}

std::string optionGroups(const std::vector<OptionModel>& options) {
  std::string text;
  for (const std::string& group : groupsOf(options)) {
    text += fmt::format("\n{}:\n", group);
    for (const OptionModel& option : options) {
      if (option.group == group) text += entry(headOf(option), explanationOf(option));
    }
  }
  for (const OptionModel& option : options) {
    if (option.keys.empty()) continue;
    text += fmt::format("\nKeys of {}:\n", option.longName());
    for (const KeyModel& key : option.keys) text += entry(key.head, explanationOf(key));
  }
  return text;
}

std::string markdownCell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c;
  }
  return cell;
}

}  // namespace

std::string helpText(const ProgramModel& program) {
  std::string text = fmt::format("{}.\n\nUsage: {} COMMAND [option...]\n{}\nCommands:\n", program.summary, program.name,
                                 paragraphs(program.details));
  for (const CommandModel& command : program.commands) text += entry(command.name, command.summary + ".");
  text += optionGroups(program.options) + "\nExit codes:\n";
  for (const ExitCodeModel& code : program.exitCodes) text += entry(std::to_string(code.code), code.meaning + ".");
  text += "\nEnvironment:\n";
  for (const auto& [name, meaning] : program.environment) text += entry(name, meaning + ".");
  return text + fmt::format("\n'{} COMMAND --help' tells more of a command.\n", program.name);
}

std::string helpText(const ProgramModel& program, const CommandModel& command) {
  return fmt::format("{}.\n\nUsage: {} {}\n{}{}", command.summary, program.name, command.synopsis,
                     paragraphs(command.details), optionGroups(command.options));
}

std::string markdownTable(const ProgramModel& program) {
  std::string text;
  std::set<std::string> told;  // keys that several commands have in common are listed once
  for (const CommandModel& command : program.commands) {
    text += fmt::format("`{} {}`: {}.\n\n| option | meaning |\n|---|---|\n", program.name, command.synopsis,
                        command.summary);
    for (const OptionModel& option : command.options) {
      text += fmt::format("| `{}` | {} |\n", markdownCell(headOf(option)), markdownCell(explanationOf(option)));
    }
    for (const OptionModel& option : command.options) {
      if (option.keys.empty() || !told.insert(option.longName()).second) continue;
      text += fmt::format("\n| `{}` | meaning |\n|---|---|\n", option.longName());
      for (const KeyModel& key : option.keys)
        text += fmt::format("| `{}` | {} |\n", markdownCell(key.head), markdownCell(explanationOf(key)));
    }
    text += "\n";
  }
  text += "| exit code | meaning |\n|---|---|\n";
  for (const ExitCodeModel& code : program.exitCodes) text += fmt::format("| {} | {} |\n", code.code, code.meaning);
  return text;
}

}  // namespace crosslight
