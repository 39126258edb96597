// Help, manual page, completions and README tables come from one model: what one shows, all show.
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "cli/program.h"

namespace crosslight::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class Help : public CliTest {
 protected:
  std::string text(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exitCode, 0) << testing::PrintToString(arguments) << "\n" << outcome.err;
    EXPECT_THAT(outcome.err, IsEmpty());
    return outcome.out;
  }

  // The first words of the lines below "Commands:".
  std::vector<std::string> commands() const {
    const std::string help = text({"--help"});
    const std::string list = help.substr(help.find("Commands:"), help.find("General:") - help.find("Commands:"));
    return matches(list, std::regex("\n  ([a-z]+) "));
  }

  static std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
    std::vector<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) found.push_back((*i)[1]);
    return found;
  }

  // Long options of a command: those that begin an entry of its help.
  std::vector<std::string> options(const std::string& command) const {
    return matches(text({command, "--help"}), std::regex("\n  (?:-[a-z], )?--([a-z-]+)"));
  }
};

TEST_F(Help, isGivenForEveryCommandWhateverElseIsOnTheLine) {
  const std::vector<std::string> names = commands();
  EXPECT_THAT(names, testing::IsSupersetOf({"render", "info", "devices", "merge", "sheet", "completion", "man"}));
  for (const std::string& name : names) {
    const std::string help = text({name, "--help"});
    EXPECT_THAT(help, HasSubstr("Usage: crosslight " + name));
    EXPECT_EQ(text({name, "-h"}), help);
    EXPECT_EQ(text({name, "--nonsense", "--help"}), help);
    EXPECT_THAT(options(name), testing::IsSupersetOf({"help", "quiet", "verbose"})) << name;
  }
}

TEST_F(Help, linesFitAHundredColumns) {
  for (const std::string& name : commands()) {
    const std::string help = text({name, "--help"});
    for (const std::string& line : matches(help, std::regex("([^\n]*)\n"))) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST_F(Help, everyPromisedOptionOfRenderIsThere) {
  const std::vector<std::string> promised = {"output",
                                             "method",
                                             "resolution",
                                             "camera",
                                             "scene",
                                             "time",
                                             "spp",
                                             "filter",
                                             "msaa",
                                             "seed",
                                             "aov",
                                             "max-depth",
                                             "exposure",
                                             "alpha",
                                             "tone-map",
                                             "set",
                                             "effects",
                                             "device",
                                             "json",
                                             "list-devices",
                                             "require-device",
                                             "progress",
                                             "allow-nonfinite",
                                             "batch",
                                             "stop-on-error",
                                             "frames",
                                             "fps",
                                             "animation",
                                             "turntable",
                                             "turn",
                                             "part"};
  EXPECT_THAT(options("render"), testing::IsSupersetOf(promised));
}

TEST_F(Help, everyOptionIsInManualCompletionsAndTables) {
  const std::string manual = text({"man"}), tables = text({"man", "--format", "markdown"});
  const std::string bash = text({"completion", "bash"}), zsh = text({"completion", "zsh"});
  const std::string fish = text({"completion", "fish"});
  for (const std::string& name : commands()) {
    const std::vector<std::string> found = options(name);
    ASSERT_GE(found.size(), 3u);
    for (const std::string& option : found) {
      const std::string escaped = std::regex_replace("--" + option, std::regex("-"), "\\-");
      EXPECT_THAT(manual, HasSubstr(escaped)) << name;
      EXPECT_THAT(tables, HasSubstr("--" + option)) << name;
      EXPECT_TRUE(std::regex_search(bash, std::regex("\n      " + name + "\\) words='[^']*--" + option + "[ ']")))
          << name << " " << option;
      EXPECT_THAT(zsh, HasSubstr("--" + option + "[")) << name;
      EXPECT_TRUE(std::regex_search(fish, std::regex("seen_subcommand_from " + name + "'[^\n]* -l " + option + " ")))
          << name << " " << option;
    }
  }
}

TEST_F(Help, valuesOfOptionsAreInTheCompletions) {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const std::string script = text({"completion", shell});
    EXPECT_THAT(script, HasSubstr("wireframe flat gouraud phong whitted")) << shell;
    EXPECT_THAT(script, HasSubstr("none clamp reinhard neutral")) << shell;
  }
}

TEST_F(Help, shellsAcceptTheirCompletions) {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    if (std::system(("command -v " + shell + " >/dev/null").c_str()) != 0) {
      GTEST_SKIP() << shell << " is not installed; ci/setup test installs it";
    }
    write(shell, text({"completion", shell}));
    EXPECT_EQ(std::system((shell + " -n '" + path(shell).string() + "'").c_str()), 0) << shell;
  }
}

TEST_F(Help, bashCompletesMethodsAndValuesOfSet) {
  write("completion", text({"completion", "bash"}));
  write("ask", R"(source "$1"
COMP_WORDS=(crosslight render --method ph); COMP_CWORD=3; _crosslight; echo "${COMPREPLY[@]}"
COMP_WORDS=(crosslight render --method = w); COMP_CWORD=4; _crosslight; echo "${COMPREPLY[@]}"
COMP_WORDS=(crosslight render --set shadows = o); COMP_CWORD=5; _crosslight; echo "${COMPREPLY[@]}"
COMP_WORDS=(crosslight dev); COMP_CWORD=1; _crosslight; echo "${COMPREPLY[@]}"
COMP_WORDS=(crosslight completion z); COMP_CWORD=2; _crosslight; echo "${COMPREPLY[@]}"
)");
  const std::string line =
      "bash '" + path("ask").string() + "' '" + path("completion").string() + "' > '" + path("answer").string() + "'";
  ASSERT_EQ(std::system(line.c_str()), 0);
  EXPECT_EQ(read("answer"), "phong\nwireframe whitted\non off\ndevices\nzsh\n");
}

TEST_F(Help, manualIsCleanRoff) {
  if (std::system("command -v groff >/dev/null") != 0) GTEST_SKIP() << "groff is not installed; ci/setup test does it";
  write("crosslight.1", text({"man"}));
  const std::string line = "groff -man -Tascii -P-cbou -ww '" + path("crosslight.1").string() + "' > '" +
                           path("page").string() + "' 2> '" + path("warnings").string() + "'";
  EXPECT_EQ(std::system(line.c_str()), 0);
  EXPECT_THAT(read("warnings"), IsEmpty());
  EXPECT_THAT(read("page"), HasSubstr("EXIT STATUS"));
}

TEST_F(Help, versionNamesVersionAndCommit) {
  EXPECT_TRUE(std::regex_match(text({"--version"}),
                               std::regex("crosslight \\d+\\.\\d+\\.\\d+ \\(([0-9a-f]{40}|unknown)\\)\n")));
}

}  // namespace
}  // namespace crosslight::test
