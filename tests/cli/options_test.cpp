// Options take their values as files do, and a command line that is wrong is answered in words of ours.
#include <gtest/gtest.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>
#include <utility>

#include "cli/commands.h"
#include "scenes/read/read_scene.h"
#include "tests/cli/plot.h"

namespace espalier {
namespace {

using tests::Ran;

class Options : public tests::Plot {
 protected:
  Ran with(const std::string& command, const std::string& more) const {
    return tests::espalier(command + " " + scratch_.path("scene.yaml").string() + " -o " +
                           scratch_.path("out").string() + " " + more);
  }
  /// What is said of a line in a scene file, after the key's name.
  std::string saidOf(const std::string& line) const {
    const auto file = scratch_.write(
        "key.yaml",
        "espalier: scene\nworld: {resolution: 9, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n" + line + "\n");
    const auto problems = scenes::readRulesOrScene(file).problems();
    EXPECT_EQ(problems.size(), 1u) << line;
    return problems.empty() ? "" : problems.front().text.substr(problems.front().text.find(' ')) + "\n";
  }
};

TEST_F(Options, TakeNumbersAsFilesDo) {
  for (const std::string text :
       {"-1", "18446744073709551616", "010", "1e3", "0x10", "NaN", "1.0", "1,5", "true", "1_000"}) {
    const Ran ran = with("grow", "--seed " + text);
    EXPECT_EQ(ran.status, 2) << text;
    EXPECT_EQ(ran.output, "espalier: --seed" + saidOf("seed: " + text));
  }
  EXPECT_EQ(with("grow", "--seed=-1").output, "espalier: --seed" + saidOf("seed: -1"));
  EXPECT_EQ(with("grow", "--iterations 100001").output,
            "espalier: --iterations" + saidOf("iterations: 100001"));
  EXPECT_EQ(with("expose", "--band 0").output, "espalier: --band" + saidOf("exposure: {band: 0}"));
  EXPECT_EQ(with("expose", "--where band2").output, "espalier: --where" + saidOf("exposure: {where: band2}"));
}

TEST_F(Options, NumbersOfEveryCommandAreCheckedAlike) {
  for (const std::string command : {"grow", "render", "expose"}) {
    for (const std::string text : {"1025", "' 7'"}) {
      const Ran ran = with(command, (command == "render" ? "--from out --threads " : "--threads ") + text);
      EXPECT_EQ(ran.status, 2) << command << text;
      EXPECT_TRUE(ran.output.starts_with("espalier: --threads is '")) << ran.output;
      EXPECT_TRUE(ran.output.ends_with("; expected a whole number from 1 to 1024\n")) << ran.output;
    }
  }
  for (const std::string text : {"0", "''"}) {
    const Ran ran = with("grow", "--save-every " + text);
    EXPECT_EQ(ran.status, 2) << text;
    EXPECT_TRUE(ran.output.ends_with("; expected a whole number from 1 to 100000 (iterations)\n"))
        << ran.output;
  }
  for (const std::string text : {"''", "' 7'", "'7 '", "9007199254740992"}) {
    const Ran ran = with("grow", "--seed " + text);
    EXPECT_EQ(ran.status, 2) << text;
    EXPECT_TRUE(ran.output.ends_with("; expected a whole number from 0 to 9007199254740991\n")) << ran.output;
  }
}

TEST_F(Options, GoodNumbersAreTaken) {
  for (const auto& [text, seed] :
       {std::pair("0", 0ll), std::pair("+7", 7ll), std::pair("9007199254740991", 9007199254740991ll)}) {
    const Ran ran =
        with("grow", "--no-pictures --quiet --iterations 1 --threads 2 --seed " + std::string(text));
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_EQ(report()["seed"], seed);
  }
}

TEST_F(Options, AWrongCommandLineIsAnsweredWithWhatIsRight) {
  const auto expectSaid = [&](const std::string& arguments, const std::string& said) {
    const Ran ran = tests::espalier(arguments);
    EXPECT_EQ(ran.status, 2) << arguments;
    EXPECT_EQ(ran.output, said + "\n") << arguments;
  };
  const std::string
      commands = "grow, render, expose, check, certify, inspect, rules, schema, init, explain, gallery, studio",
      see = " (see espalier --help)";
  expectSaid("", "espalier: no command is given; expected one of " + commands + see);
  expectSaid("gorw x.yaml", "espalier: there is no command 'gorw'; expected one of " + commands +
                                "; did you mean 'grow'?" + see);
  expectSaid("check", "espalier check: file is required (see espalier check --help)");
  expectSaid("certify --json", "espalier certify: --json requires scene (see espalier certify --help)");
  expectSaid("schema rule", "espalier: kind is 'rule'; expected one of rules, scene; did you mean 'rules'?");
  expectSaid("expose a.yaml --band 3 --where surfaces",
             "espalier: --band means nothing to --where surfaces; expected --where band, or no --band");
  const std::string see_grow = " (see espalier grow --help)";
  expectSaid("grow a.yaml --seed", "espalier grow: --seed has no value; expected one after it" + see_grow);
  expectSaid("grow a.yaml --seed 1 --seed 2",
             "espalier grow: --seed is given more than once; expected it once" + see_grow);
  expectSaid("grow a.yaml b.yaml",
             "espalier grow: 'b.yaml' is one too many; expected no more than the command takes" + see_grow);
  expectSaid("grow a.yaml --json=maybe", "espalier grow: --json has a value; expected none" + see_grow);
  const Ran unknown = tests::espalier("grow a.yaml --sede 1");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(unknown.output.starts_with("espalier grow: there is no option '--sede'; expected one of "))
      << unknown.output;
  EXPECT_NE(unknown.output.find("; did you mean '--seed'?"), std::string::npos) << unknown.output;
}

/// Each option of each command, and each command, with a letter left out.
TEST_F(Options, EveryMisspeltOneIsRecognized) {
  CLI::App app;
  int status = 0;
  for (const auto add : {cli::addGrow, cli::addRender, cli::addExpose, cli::addCheck, cli::addCertify,
                         cli::addInspect, cli::addRules, cli::addSchema, cli::addInit, cli::addExplain})
    add(app, status);
  const auto misspelt = [](std::string word) { return word.erase(word.size() - 2, 1); };
  std::size_t options = 0;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string name = command->get_name();
    EXPECT_NE(tests::espalier(misspelt(name)).output.find("; did you mean '" + name + "'?"),
              std::string::npos)
        << name;
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& word : option->get_lnames()) {
        if (word.size() < 4) continue;
        ++options;
        const Ran ran = tests::espalier(name + " --" + misspelt(word));
        EXPECT_EQ(ran.status, 2) << name << ' ' << word;
        EXPECT_NE(ran.output.find("; did you mean '--" + word + "'?"), std::string::npos) << ran.output;
      }
    }
  }
  EXPECT_GT(options, 30u);
}

TEST_F(Options, AMisspeltKeyIsExplainedAsTheOneThatIsMeant) {
  for (const auto& [asked, meant] : {std::pair("voxell", "voxel"),
                                     {"bias.upp", "bias.up"},
                                     {"wrold.voxel", "world.voxel"},
                                     {"exposure.unreachd", "exposure.unreached"}}) {
    const Ran ran = tests::espalier("explain " + std::string(asked));
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.output.find("did you mean '" + std::string(meant) + "'?"), std::string::npos) << ran.output;
  }
}

}  // namespace
}  // namespace espalier
