// `crosslight man`: the manual page, as roff for man(1) or as Markdown tables for the README.
#include <memory>

#include "app/command_line.h"
#include "app/command_model.h"
#include "app/commands.h"
#include "app/output.h"

namespace crosslight {
namespace {

// Text as roff shows it literally: "-" would become a hyphen, a leading "." or "'" a request.
std::string roff(const std::string& text) {
  std::string result;
  bool lineStart = true;
  for (const char c : text) {
    if (lineStart && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    lineStart = c == '\n';
  }
  return result;
}

std::string tagged(const std::string& head, const std::string& text) {
  return ".TP\n.B " + roff(head) + "\n" + roff(text) + "\n";
}

std::string paragraphs(const std::string& text) {
  std::string result;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find("\n\n", begin), text.size());
    result += ".PP\n" + roff(text.substr(begin, end - begin)) + "\n";
    begin = end + 2;
  }
  return result;
}

std::string optionList(const std::vector<OptionModel>& options) {
  std::string text;
  for (const OptionModel& option : options) {
    text += tagged(headOf(option), explanationOf(option));
    if (option.keys.empty()) continue;
    text += ".RS\n";
    for (const KeyModel& key : option.keys) text += tagged(key.head, explanationOf(key));
    text += ".RE\n";
  }
  return text;
}

}  // namespace

std::string manPage(const ProgramModel& program) {
  // No date: the page must be the same for the same source.
  std::string text = ".TH CROSSLIGHT 1 \"\" \"" + program.name + " " + program.version + "\" \"User Commands\"\n";
  text += ".SH NAME\n" + program.name + " \\- " + roff(program.summary) + "\n.SH SYNOPSIS\n";
  for (const CommandModel& command : program.commands) {
    text += ".B " + program.name + "\n" + roff(command.synopsis) + "\n.br\n";
  }
  text += ".SH DESCRIPTION\n" + paragraphs(program.details) + ".SH OPTIONS\n" + optionList(program.options);
  text += ".SH COMMANDS\n";
  for (const CommandModel& command : program.commands) {
    text += ".SS " + program.name + " " + roff(command.synopsis) + "\n" + roff(command.summary) + ".\n";
    text += paragraphs(command.details) + optionList(command.options);
  }
  text += ".SH EXIT STATUS\n";
  for (const ExitCodeModel& code : program.exitCodes) text += tagged(std::to_string(code.code), code.meaning + ".");
  text += ".SH ENVIRONMENT\n";
  for (const auto& [name, meaning] : program.environment) text += tagged(name, meaning + ".");
  return text;
}

void addManCommand(CommandLine& line) {
  auto format = std::make_shared<std::string>("roff");
  CLI::App& command = line.add("man", "Print the manual page", "[--format FORMAT]",
                               "Made from the same source as the help: 'crosslight man | man -l -' shows it.");
  line.choice(command, "--format", *format, {"roff", "markdown"}, "A page for man, or tables for a README");
  line.onRun(command, [&line, format] {
    const ProgramModel program = line.model();
    printToStdout(*format == "roff" ? manPage(program) : markdownTable(program));
  });
}

}  // namespace crosslight
