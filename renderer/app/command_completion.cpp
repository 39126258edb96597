// `crosslight completion`: what bash, zsh and fish need to complete commands, options and their values.
#include <fmt/format.h>

#include <map>
#include <memory>

#include "app/command_line.h"
#include "app/command_model.h"
#include "app/commands.h"
#include "app/output.h"
#include "app/suggest.h"

namespace crosslight {
namespace {

// 'text' for any of the three shells: only the quote itself needs care.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::vector<std::string> commandNames(const ProgramModel& program) {
  std::vector<std::string> names;
  for (const CommandModel& command : program.commands) names.push_back(command.name);
  return names;
}

std::vector<std::string> optionNames(const std::vector<OptionModel>& options) {
  std::vector<std::string> names;
  for (const OptionModel& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

// Of "key=value" pairs: the values of each key.
std::map<std::string, std::vector<std::string>> pairsOf(const OptionModel& option) {
  std::map<std::string, std::vector<std::string>> pairs;
  for (const std::string& pair : option.choices) {
    const std::size_t equals = pair.find('=');
    pairs[pair.substr(0, equals)].push_back(pair.substr(equals + 1));
  }
  return pairs;
}

std::string bashCases(const CommandModel& command) {
  std::string text;
  for (const OptionModel& option : command.options) {
    if (option.kind == ValueKind::none) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : option.names) patterns.push_back(quoted(command.name + " " + name));
    if (patterns.empty()) continue;
    std::string action = "return";
    if (option.kind == ValueKind::file) action = "COMPREPLY=($(compgen -f -- \"$current\")); return";
    if (option.kind == ValueKind::choice) action = "words=" + quoted(joined(option.choices, " "));
    if (option.kind == ValueKind::keyValue) {
      std::vector<std::string> keys;
      for (const auto& [key, values] : pairsOf(option)) {
        keys.push_back(key + "=");
        text += fmt::format("    {}) words={} ;;\n", quoted(command.name + " " + key), quoted(joined(values, " ")));
      }
      action = "compopt -o nospace; words=" + quoted(joined(keys, " "));
    }
    text += fmt::format("    {}) {} ;;\n", joined(patterns, "|"), action);
  }
  return text;
}

// A zsh _arguments specification is cut at colons and brackets.
std::string zshText(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zshAction(const OptionModel& option) {
  const std::string placeholder = ":" + zshText(option.value) + ":";
  switch (option.kind) {
    case ValueKind::none:
      return "";
    case ValueKind::file:
      return placeholder + "_files";
    case ValueKind::choice:
    case ValueKind::keyValue:
      return ":" + zshText(option.longName().substr(2)) + ":(" + joined(option.choices, " ") + ")";
    case ValueKind::text:
      return placeholder;
  }
  return "";
}

}  // namespace

std::string bashCompletion(const ProgramModel& program) {
  std::string text =
      "# bash completion for crosslight; made by 'crosslight completion bash'\n"
      "_crosslight() {\n"
      "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} words=\n"
      "  # bash cuts words at '=': --method=phong and key=value arrive in three pieces.\n"
      "  if [[ $current == '=' ]]; then\n"
      "    current=\n"
      "  elif [[ $previous == '=' ]]; then\n"
      "    previous=${COMP_WORDS[COMP_CWORD-2]}\n"
      "  fi\n"
      "  COMPREPLY=()\n";
  text += fmt::format(
      "  if ((COMP_CWORD == 1)); then\n    COMPREPLY=($(compgen -W {} -- \"$current\"))\n    return\n  fi\n",
      quoted(joined(commandNames(program), " ") + " " + joined(optionNames(program.options), " ")));
  text += "  case \"${COMP_WORDS[1]} $previous\" in\n";
  for (const CommandModel& command : program.commands) text += bashCases(command);
  text += "  esac\n  if [[ -z $words && $current == -* ]]; then\n    case ${COMP_WORDS[1]} in\n";
  for (const CommandModel& command : program.commands) {
    text += fmt::format("      {}) words={} ;;\n", command.name, quoted(joined(optionNames(command.options), " ")));
  }
  text += "    esac\n  elif [[ -z $words ]]; then\n    case ${COMP_WORDS[1]} in\n";
  for (const CommandModel& command : program.commands) {
    for (const OptionModel& option : command.options) {
      if (!option.positional() || option.kind != ValueKind::choice) continue;
      text += fmt::format("      {}) words={} ;;\n", command.name, quoted(joined(option.choices, " ")));
    }
  }
  return text +
         "      *) COMPREPLY=($(compgen -f -- \"$current\")); return ;;\n    esac\n  fi\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n}\n"
         "complete -o filenames -F _crosslight crosslight\n";
}

std::string zshCompletion(const ProgramModel& program) {
  std::string text =
      "#compdef crosslight\n# zsh completion for crosslight; made by 'crosslight completion zsh'\n"
      "_crosslight() {\n  local -a commands=(\n";
  for (const CommandModel& command : program.commands) {
    text += "    " + quoted(command.name + ":" + zshText(command.summary)) + "\n";
  }
  text += "  )\n  if ((CURRENT == 2)); then\n    _describe command commands\n    _arguments";
  for (const OptionModel& option : program.options) {
    for (const std::string& name : option.names) text += " " + quoted(name + "[" + zshText(option.description) + "]");
  }
  text += "\n    return\n  fi\n  local chosen=$words[2]\n  shift words\n  ((CURRENT--))\n  case $chosen in\n";
  for (const CommandModel& command : program.commands) {
    text += "    " + command.name + ")\n      _arguments";
    for (const OptionModel& option : command.options) {
      if (option.positional()) {
        const std::string action =
            option.kind == ValueKind::choice ? "(" + joined(option.choices, " ") + ")" : std::string("_files");
        text += " \\\n        " + quoted((option.repeatable ? "*:" : ":") + zshText(option.value) + ":" + action);
      }
      for (const std::string& name : option.names) {
        const std::string star = option.repeatable ? "*" : "";
        text += " \\\n        " + quoted(star + name + "[" + zshText(option.description) + "]" + zshAction(option));
      }
    }
    text += "\n      ;;\n";
  }
  return text + "  esac\n}\n_crosslight \"$@\"\n";
}

std::string fishCompletion(const ProgramModel& program) {
  std::string text = "# fish completion for crosslight; made by 'crosslight completion fish'\n";
  const auto line = [&text](const std::string& condition, const OptionModel& option) {
    text += "complete -c crosslight -n " + quoted(condition);
    for (const std::string& name : option.names) {
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (option.kind == ValueKind::file) text += " -r -F";
    if (option.kind == ValueKind::text) text += " -x";
    if (!option.choices.empty()) {
      text += (option.positional() ? " -f -a " : " -x -a ") + quoted(joined(option.choices, " "));
    }
    text += " -d " + quoted(option.description) + "\n";
  };
  for (const OptionModel& option : program.options) line("__fish_use_subcommand", option);
  for (const CommandModel& command : program.commands) {
    text += fmt::format("complete -c crosslight -n __fish_use_subcommand -f -a {} -d {}\n", command.name,
                        quoted(command.summary));
  }
  for (const CommandModel& command : program.commands) {
    for (const OptionModel& option : command.options) {
      if (!option.positional() || !option.choices.empty()) line("__fish_seen_subcommand_from " + command.name, option);
    }
  }
  return text;
}

void addCompletionCommand(CommandLine& line) {
  auto shell = std::make_shared<std::string>();
  CLI::App& command = line.add("completion", "Print the completion script of a shell", "bash|zsh|fish",
                               "For bash: 'source <(crosslight completion bash)'. An installation puts all three where "
                               "the shells look for them.");
  line.choice(command, "SHELL", *shell, {"bash", "zsh", "fish"}, "The shell")->required();
  line.onRun(command, [&line, shell] {
    const ProgramModel program = line.model();
    if (*shell == "bash") printToStdout(bashCompletion(program));
    if (*shell == "zsh") printToStdout(zshCompletion(program));
    if (*shell == "fish") printToStdout(fishCompletion(program));
  });
}

}  // namespace crosslight
