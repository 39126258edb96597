#include "app/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>

#include "app/output.h"
#include "app/program_text.h"
#include "app/suggest.h"
#include "app/version.h"
#include "base/log.h"

namespace crosslight {
namespace {

constexpr const char* kLastGroup = "Messages";  // what every command has comes after its own options

// A validator without a description: CLI11 would append it to the placeholder.
void addCheck(CLI::Option* option, std::function<std::string(const std::string&)> problem) {
  option->check(CLI::Validator([problem = std::move(problem)](std::string& word) { return problem(word); }, ""));
}

template <class T>
bool parseAll(const std::string& word, T& value) {
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc{} && stop == end;
}

std::string bareName(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name() : option.get_lnames().front();
}

bool isOption(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

}  // namespace

CommandLine::CommandLine() : app_(kProgramSummary, "crosslight") {
  app_.require_subcommand(1);
  app_.set_help_flag("-h,--help", "Say what there is, and end");
  app_.set_version_flag("--version", fmt::format("crosslight {} ({})", versionText(), commitText()),
                        "Say the version and the commit, and end");
}

CLI::App& CommandLine::add(const std::string& name, const std::string& summary, const std::string& synopsis,
                           const std::string& details) {
  CLI::App* app = app_.add_subcommand(name, summary);
  entries_.push_back({{app, {}}, synopsis, details});
  return *app;
}

void CommandLine::onRun(CLI::App& command, std::function<void()> run) {
  CLI::Option* quiet = flag(command, "-q,--quiet", common_.quiet, "Only errors on stderr");
  CLI::Option* verbose = flag(command, "-v,--verbose", common_.verbose, "More on stderr: times, effects with reasons");
  quiet->group(kLastGroup)->excludes(verbose);
  verbose->group(kLastGroup);
  command.get_help_ptr()->group(kLastGroup);
  for (Entry& entry : entries_) {
    if (entry.command.app == &command) entry.command.run = std::move(run);
  }
}

CLI::Option* CommandLine::flag(CLI::App& command, const std::string& names, bool& target,
                               const std::string& description) {
  return declare(command.add_flag(names, target, description), "", ValueModel{ValueKind::none, {}, {}});
}

CLI::Option* CommandLine::text(CLI::App& command, const std::string& names, std::string& target,
                               const std::string& value, const std::string& description, ValueKind kind) {
  return declare(command.add_option(names, target, description), value, ValueModel{kind, {}, {}});
}

CLI::Option* CommandLine::choice(CLI::App& command, const std::string& names, std::string& target,
                                 const std::vector<std::string>& choices, const std::string& description) {
  CLI::Option* option = command.add_option(names, target, description);
  addCheck(option, [choices, what = bareName(*option)](const std::string& word) {
    const bool known = std::find(choices.begin(), choices.end(), word) != choices.end();
    return known ? std::string() : unknownWord(what, word, choices);
  });
  return declare(option, joined(choices, "|"), ValueModel{ValueKind::choice, choices, {}});
}

CLI::Option* CommandLine::number(CLI::App& command, const std::string& names, double& target, const std::string& value,
                                 double least, double most, const std::string& description) {
  CLI::Option* option = command.add_option(names, target, description);
  addCheck(option, [least, most](const std::string& word) {
    double parsed = 0;
    if (parseAll(word, parsed) && parsed >= least && parsed <= most) return std::string();
    return fmt::format("'{}' is not a number from {:g} to {:g}", word, least, most);
  });
  return declare(option, value, ValueModel{});
}

void CommandLine::checkWhole(CLI::Option* option, std::uint64_t least, std::uint64_t most) {
  addCheck(option, [least, most](const std::string& word) {
    std::uint64_t parsed = 0;
    if (parseAll(word, parsed) && parsed >= least && parsed <= most) return std::string();
    return fmt::format("'{}' is not a whole number from {} to {}", word, least, most);
  });
}

CLI::Option* CommandLine::list(CLI::App& command, const std::string& names, std::vector<std::string>& target,
                               const std::string& value, const std::string& description, ValueModel values) {
  // One value each time, or "--set a=b SCENE" would take the scene for a second pair.
  CLI::Option* option = command.add_option(names, target, description)->allow_extra_args(false);
  return declare(option, value, std::move(values));
}

CLI::Option* CommandLine::declare(CLI::Option* option, const std::string& value, ValueModel values) {
  if (values.kind != ValueKind::none) option->type_name(value)->capture_default_str();
  values_[option] = std::move(values);
  return option;
}

void CommandLine::parse(const std::vector<std::string>& words) {
  std::vector<const char*> pointers;
  for (const std::string& word : words) pointers.push_back(word.c_str());
  try {
    app_.parse(static_cast<int>(pointers.size()), pointers.data());
  } catch (const CLI::CallForVersion&) {
    throw;
  } catch (const CLI::ParseError& error) {
    explain(error);
  }
}

void CommandLine::run(int argc, char** argv) {
  common_.arguments.assign(argv, argv + argc);
  const std::vector<std::string>& words = common_.arguments;
  if (words.size() < 2) throw UsageError("no command given; 'crosslight --help' lists them");
  // Help is given whatever else is wrong with the line.
  for (const std::string& word : words) {
    if (word == "--") break;
    if (word != "-h" && word != "--help") continue;
    const ProgramModel program = model();
    for (const CommandModel& command : program.commands) {
      if (command.name == words[1]) return printToStdout(helpText(program, command));
    }
    return printToStdout(helpText(program));
  }
  try {
    parse(words);
  } catch (const CLI::CallForVersion& version) {
    return printToStdout(std::string(version.what()) + "\n");
  }
  setLogLevel(common_.quiet ? LogLevel::quiet : common_.verbose ? LogLevel::verbose : LogLevel::normal);
  for (const Entry& entry : entries_) {
    if (entry.command.app->parsed()) entry.command.run();
  }
}

void CommandLine::explain(const CLI::ParseError& error) const {
  const auto parsed = app_.get_subcommands();
  if (parsed.empty()) {
    for (const std::string& word : app_.remaining(true)) {
      if (isOption(word)) throw UsageError("unknown option '" + word + "'; options follow the command");
      std::vector<std::string> names;
      for (const Entry& entry : entries_) names.push_back(entry.command.app->get_name());
      throw UsageError(unknownWord("command", word, names));
    }
    throw UsageError("no command given; 'crosslight --help' lists them");
  }
  const std::string hint = "\n  'crosslight " + parsed.front()->get_name() + " --help' lists the options";
  const std::string suggestion = suggestionFor(*parsed.front());
  throw UsageError((suggestion.empty() ? std::string(error.what()) : suggestion) + hint);
}

std::string CommandLine::suggestionFor(const CLI::App& app) const {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const std::string& word : app_.remaining(true)) {
    if (!isOption(word)) return "unexpected argument '" + word + "'";
    const std::string name = word.substr(0, word.find('='));
    std::string text = "unknown option '" + name + "'";
    if (const auto meant = nearest(name, names)) text += ". Did you mean '" + *meant + "'?";
    return text;
  }
  return "";
}

OptionModel CommandLine::describe(const CLI::Option& option) const {
  OptionModel model;
  for (const std::string& name : option.get_snames()) model.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) model.names.push_back("--" + name);
  model.description = option.get_description();
  model.group = option.get_group() == "Options" ? "General" : option.get_group();
  const auto found = values_.find(&option);
  if (found == values_.end()) return model;  // CLI11's own flags: help and version
  model.kind = found->second.kind;
  model.choices = found->second.choices;
  model.keys = found->second.keys;
  if (model.kind == ValueKind::none) return model;
  model.value = option.get_type_name();
  model.repeatable = option.get_items_expected_max() > 1;
  if (!model.repeatable) model.defaultText = option.get_default_str();
  return model;
}

ProgramModel CommandLine::model() const {
  ProgramModel program = programText();
  for (const CLI::Option* option : app_.get_options()) program.options.push_back(describe(*option));
  const auto isLast = [](const OptionModel& option) { return option.group == kLastGroup; };
  for (const Entry& entry : entries_) {
    CommandModel command;
    command.name = entry.command.app->get_name();
    command.summary = entry.command.app->get_description();
    command.details = entry.details;
    command.synopsis = command.name + " " + entry.synopsis;
    for (const bool positional : {true, false}) {
      for (const CLI::Option* option : entry.command.app->get_options()) {
        if (option->get_positional() != positional) continue;
        command.options.push_back(describe(*option));
        if (positional) command.options.back().group = "Arguments";
      }
    }
    std::stable_partition(command.options.begin(), command.options.end(), std::not_fn(isLast));
    program.commands.push_back(std::move(command));
  }
  return program;
}

}  // namespace crosslight
