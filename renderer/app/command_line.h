// The parser behind all commands: CLI11 with what it does not know, namely the values that an option accepts. One place
// declares an option; help, man page and completion are read back from here (see command_model.h).
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/command_model.h"
#include "base/error.h"

namespace crosslight {

// Options that every command has.
struct CommonOptions {
  bool quiet = false;
  bool verbose = false;
  std::vector<std::string> arguments;  // of the process, for records
};

struct Command {
  CLI::App* app = nullptr;
  std::function<void()> run;  // throws Error; returning means ok
};

struct ValueModel {
  ValueKind kind = ValueKind::text;
  std::vector<std::string> choices;
  std::vector<KeyModel> keys = {};
};

class CommandLine {
 public:
  CommandLine();

  // A new command. `synopsis` is what follows the command's name in its usage line.
  CLI::App& add(const std::string& name, const std::string& summary, const std::string& synopsis,
                const std::string& details = "");
  // Sets what the command does; `run` owns the command's options.
  void onRun(CLI::App& command, std::function<void()> run);

  CLI::Option* flag(CLI::App& command, const std::string& names, bool& target, const std::string& description);
  CLI::Option* text(CLI::App& command, const std::string& names, std::string& target, const std::string& value,
                    const std::string& description, ValueKind kind = ValueKind::text);
  CLI::Option* choice(CLI::App& command, const std::string& names, std::string& target,
                      const std::vector<std::string>& choices, const std::string& description);
  // Whole numbers in [least, most].
  template <class T>
  CLI::Option* whole(CLI::App& command, const std::string& names, T& target, const std::string& value,
                     std::uint64_t least, std::uint64_t most, const std::string& description) {
    CLI::Option* option = command.add_option(names, target, description);
    checkWhole(option, least, most);
    return declare(option, value, ValueModel{});
  }
  CLI::Option* number(CLI::App& command, const std::string& names, double& target, const std::string& value,
                      double least, double most, const std::string& description);
  // May be given several times; each time one value.
  CLI::Option* list(CLI::App& command, const std::string& names, std::vector<std::string>& target,
                    const std::string& value, const std::string& description, ValueModel values);
  // For options made directly on `command`.
  CLI::Option* declare(CLI::Option* option, const std::string& value, ValueModel values);

  // Only parses; the first word is the program's name. UsageError when the words make no sense.
  void parse(const std::vector<std::string>& words);
  // Parses and runs. UsageError when the words make no sense; help and version go to stdout.
  void run(int argc, char** argv);

  ProgramModel model() const;
  CommonOptions& common() { return common_; }
  CLI::App& root() { return app_; }

 private:
  static void checkWhole(CLI::Option* option, std::uint64_t least, std::uint64_t most);
  [[noreturn]] void explain(const CLI::ParseError& error) const;
  std::string suggestionFor(const CLI::App& app) const;
  OptionModel describe(const CLI::Option& option) const;

  struct Entry {
    Command command;
    std::string synopsis;
    std::string details;
  };

  CLI::App app_;
  CommonOptions common_;
  std::vector<Entry> entries_;
  std::map<const CLI::Option*, ValueModel> values_;
};

}  // namespace crosslight
