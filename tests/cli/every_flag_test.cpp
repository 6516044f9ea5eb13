// No flag without an effect: a new one fails here until somebody says below what comes out otherwise with it.
#include <gtest/gtest.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "cli/commands.h"
#include "tests/cli/plot.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// What a run without and one with an option leave to be seen.
using Seen = std::pair<std::string, std::string>;
using Effects = std::map<std::string, std::function<Seen()>>;

class EveryFlag : public tests::Plot {
 protected:
  EveryFlag() { app_.require_subcommand(1); }

  /// All of a subcommand's options but --help: their names, without dashes.
  static std::set<std::string> optionsOf(const CLI::App& command) {
    std::set<std::string> names;
    for (const CLI::Option* const option : command.get_options()) names.insert(option->get_single_name());
    names.erase("help");
    return names;
  }

  /// Each of a subcommand's options is among these, and changes what is seen.
  void expectEffects(const std::string& command, const Effects& effects) {
    std::set<std::string> known;
    for (const auto& [name, seen] : effects) known.insert(name);
    EXPECT_EQ(optionsOf(*app_.get_subcommand(command)), known);
    for (const auto& [name, seen] : effects) {
      const auto [without, with] = seen();
      EXPECT_NE(without, with) << command << ' ' << name;
    }
  }

  tests::Ran ran(const std::string& command, const std::string& more) {
    return tests::espalier(command + " " + scratch_.path("scene.yaml").string() + " " + more);
  }
  std::string into(const std::string& folder) const { return "-o " + scratch_.path(folder).string(); }
  std::string state(const std::string& folder) { return report(folder)["growth"]["state_hash"]; }
  /// What a folder holds, by name.
  static std::string names(const fs::path& folder) {
    std::string all;
    if (!fs::exists(folder)) return "nothing";
    for (const auto& [name, bytes] : files(folder)) all += name + "\n";
    return all;
  }
  std::string bytes(const std::string& file) { return tests::fileText(scratch_.path(file)); }

  CLI::App app_;
  int status_ = 0;
};

/// A line of its own and a file of its own, without pictures, for what follows from growth alone.
const std::string kPlain = "--quiet --no-pictures ";

TEST_F(EveryFlag, OfGrowChangesWhatComesOut) {
  cli::addGrow(app_, status_);
  const auto grown = [&](const std::string& more, const std::string& folder) {
    return ran("grow", kPlain + more + " " + into(folder)).output;
  };
  const Effects effects = {
      {"scene",
       [&] {
         std::string other = tests::kPlotScene;
         scratch_.write("other.yaml", other.replace(other.find("name: plot"), 10, "name: else"));
         grown("", "a");
         tests::espalier("grow " + scratch_.path("other.yaml").string() + " " + kPlain + into("b"));
         return Seen{report("a")["scene"], report("b")["scene"]};
       }},
      {"output",
       [&] {
         grown("", "a");
         const std::string before = names(scratch_.path("elsewhere"));
         grown("", "elsewhere");
         return Seen{before, names(scratch_.path("elsewhere"))};
       }},
      {"threads",
       [&] {
         grown("--threads 1", "a");
         grown("--threads 3", "b");
         return Seen{report("a")["run"]["threads"].dump(), report("b")["run"]["threads"].dump()};
       }},
      {"quiet",
       [&] {
         return Seen{ran("grow", "--no-pictures " + into("a")).output, grown("", "a")};
       }},
      {"json",
       [&] {
         const auto isJson = [&](const std::string& more) {
           return std::to_string(
               nlohmann::json::accept(ran("grow", "--no-pictures " + more + into("a")).output));
         };
         return Seen{isJson(""), isJson("--json ")};
       }},
      {"no-pictures",
       [&] {
         ran("grow", "--quiet " + into("a"));
         grown("", "b");
         return Seen{names(scratch_.path("a")), names(scratch_.path("b"))};
       }},
      {"instances",
       [&] {
         grown("", "a");
         grown("--instances", "b");
         return Seen{bytes("a/plant.glb"), bytes("b/plant.glb")};
       }},
      {"obj",
       [&] {
         grown("", "a");
         grown("--obj", "b");
         return Seen{names(scratch_.path("a")), names(scratch_.path("b"))};
       }},
      {"diced",
       [&] {
         grown("", "a");
         grown("--diced surface_colour", "b");
         return Seen{names(scratch_.path("a")), names(scratch_.path("b"))};
       }},
      {"lods",
       [&] {
         grown("", "a");
         grown("--lods 1", "b");
         return Seen{names(scratch_.path("a")), names(scratch_.path("b"))};
       }},
      {"strict",
       [&] {
         scratch_.write("vine.yaml", bytes("vine.yaml") + "\nregions: {nowhere: forbid}\n");
         const int without = ran("grow", kPlain + into("a")).status;
         return Seen{std::to_string(without),
                     std::to_string(ran("grow", kPlain + "--strict " + into("a")).status)};
       }},
      {"seed",
       [&] {
         grown("", "a");
         grown("--seed 6", "b");
         return Seen{state("a"), state("b")};
       }},
      {"iterations",
       [&] {
         grown("", "a");
         grown("--iterations 3", "b");
         return Seen{report("a")["growth"]["iterations"].dump(), report("b")["growth"]["iterations"].dump()};
       }},
      {"save-every",  // which a folder in the state's place does not let happen
       [&] {
         fs::create_directories(scratch_.path("barred/growth.state/inner"));
         return Seen{grown("--no-state", "barred"), grown("--no-state --save-every 1", "barred")};
       }},
      {"resume",
       [&] {
         grown("--iterations 3", "a");
         grown("", "a");
         const std::string anew = report("a")["run"]["went_on_from"].dump();
         grown("--iterations 3", "a");
         grown("--resume", "a");
         return Seen{anew, report("a")["run"]["went_on_from"].dump()};
       }},
      {"no-state",
       [&] {
         grown("", "a");
         grown("--no-state", "b");
         return Seen{names(scratch_.path("a")), names(scratch_.path("b"))};
       }},
  };
  expectEffects("grow", effects);
}

TEST_F(EveryFlag, OfRenderChangesWhatComesOut) {
  cli::addRender(app_, status_);
  for (const char* folder : {"grown", "older"})
    ASSERT_EQ(ran("grow", kPlain + into(folder) + (folder[0] == 'o' ? " --iterations 2" : "")).status, 0);
  const auto drawn = [&](const std::string& more, const std::string& folder,
                         const std::string& from = "grown") {
    return ran("render",
               "--from " + scratch_.path(from).string() + " --images vines --quiet " + more + into(folder));
  };
  const Effects effects = {
      {"scene",
       [&] {
         std::string other = tests::kPlotScene;
         scratch_.write("other.yaml", other.replace(other.find("eye: [2.2"), 9, "eye: [1.2"));
         drawn("", "a");
         tests::espalier("render " + scratch_.path("other.yaml").string() + " --quiet --images vines " +
                         into("b") + " --from " + scratch_.path("grown").string());
         return Seen{bytes("a/vines.png"), bytes("b/vines.png")};
       }},
      {"output",
       [&] {
         const std::string before = names(scratch_.path("elsewhere"));
         drawn("", "elsewhere");
         return Seen{before, names(scratch_.path("elsewhere"))};
       }},
      {"threads",
       [&] {
         const auto threads = [&](const char* number) {
           const auto text = ran("render", "--json --quiet --images vines " + into("a") + " --from " +
                                               scratch_.path("grown").string() + " --threads " + number);
           return nlohmann::json::parse(text.output)["run"]["threads"].dump();
         };
         return Seen{threads("1"), threads("3")};
       }},
      {"quiet",
       [&] {
         const auto loud =
             ran("render", "--images vines " + into("a") + " --from " + scratch_.path("grown").string());
         return Seen{loud.output, drawn("", "a").output};
       }},
      {"json",
       [&] {
         const auto isJson = [&](const std::string& more) {
           const auto text = ran(
               "render", "--images vines " + more + into("a") + " --from " + scratch_.path("grown").string());
           return std::to_string(nlohmann::json::accept(text.output));
         };
         return Seen{isJson(""), isJson("--json ")};
       }},
      {"from",
       [&] {
         drawn("", "a");
         drawn("", "b", "older");
         return Seen{bytes("a/vines.png"), bytes("b/vines.png")};
       }},
      {"images",
       [&] {
         drawn("", "one");
         ran("render", "--quiet " + into("all") + " --from " + scratch_.path("grown").string());
         return Seen{names(scratch_.path("one")), names(scratch_.path("all"))};
       }},
      {"strict",
       [&] {
         scratch_.write("vine.yaml", bytes("vine.yaml") + "\nregions: {nowhere: forbid}\n");
         ran("grow", kPlain + into("grown"));
         const int without = drawn("", "a").status;
         return Seen{std::to_string(without), std::to_string(drawn("--strict ", "a").status)};
       }},
  };
  expectEffects("render", effects);
}

TEST_F(EveryFlag, OfExposeChangesWhatComesOut) {
  cli::addExpose(app_, status_);
  const auto exposed = [&](const std::string& more, const std::string& folder) {
    return ran("expose", kPlain + more + " " + into(folder)).output;
  };
  const auto space = [&](const std::string& folder) {
    return report(folder)["exposure"]["free_voxels"].dump();
  };
  const Effects effects = {
      {"scene",
       [&] {
         std::string other = tests::kPlotScene;
         scratch_.write("other.yaml", other.replace(other.find("voxel: 5 cm"), 11, "voxel: 6 cm"));
         exposed("", "a");
         tests::espalier("expose " + scratch_.path("other.yaml").string() + " " + kPlain + into("b"));
         return Seen{bytes("a/exposure.csv"), bytes("b/exposure.csv")};
       }},
      {"output",
       [&] {
         const std::string before = names(scratch_.path("elsewhere"));
         exposed("", "elsewhere");
         return Seen{before, names(scratch_.path("elsewhere"))};
       }},
      {"threads",
       [&] {
         exposed("--threads 1", "a");
         exposed("--threads 3", "b");
         return Seen{report("a")["run"]["threads"].dump(), report("b")["run"]["threads"].dump()};
       }},
      {"quiet",
       [&] {
         return Seen{ran("expose", "--no-pictures " + into("a")).output, exposed("", "a")};
       }},
      {"json",
       [&] {
         const auto isJson = [&](const std::string& more) {
           return std::to_string(
               nlohmann::json::accept(ran("expose", "--no-pictures " + more + into("a")).output));
         };
         return Seen{isJson(""), isJson("--json ")};
       }},
      {"no-pictures",
       [&] {
         ran("expose", "--quiet " + into("a"));
         exposed("", "b");
         return Seen{names(scratch_.path("a")), names(scratch_.path("b"))};
       }},
      {"where",
       [&] {
         exposed("", "a");
         exposed("--where everything", "b");
         return Seen{space("a"), space("b")};
       }},
      {"band",
       [&] {
         exposed("--where band", "a");
         exposed("--band 2", "b");
         return Seen{space("a"), space("b")};
       }},
  };
  expectEffects("expose", effects);
}

TEST_F(EveryFlag, OfTheOthersChangesWhatIsSaid) {
  cli::addCheck(app_, status_);
  cli::addCertify(app_, status_);
  cli::addSchema(app_, status_);
  cli::addRules(app_, status_);
  cli::addExplain(app_, status_);
  const std::string scene = scratch_.path("scene.yaml").string();
  const auto said = [](const std::string& arguments) { return tests::espalier(arguments).output; };

  EXPECT_EQ(optionsOf(*app_.get_subcommand("check")),
            (std::set<std::string>{"file", "text-only", "as", "json"}));
  const std::string bad = scratch_.write("bad.yaml", "espalier: rules\nnam: x\n").string();
  EXPECT_NE(said("check " + bad), said("check " + scene));
  EXPECT_NE(said("check " + scene), said("check --text-only " + scene));
  EXPECT_TRUE(nlohmann::json::accept(said("check --json " + bad)));
  EXPECT_EQ(said("check - --as " + scratch_.path("other.yaml").string() + " < " + bad),
            scratch_.path("other.yaml").string() + said("check " + bad).substr(bad.size()));

  EXPECT_EQ(optionsOf(*app_.get_subcommand("certify")), (std::set<std::string>{"json", "scene"}));
  std::string finer = tests::kPlotScene;
  finer.replace(finer.find("voxel: 5 cm"), 11, "voxel: 6 cm");
  const std::string certified = said("certify " + scene);
  EXPECT_NE(certified, said("certify " + scratch_.write("other.yaml", finer).string()));
  EXPECT_FALSE(nlohmann::json::accept(certified));
  EXPECT_TRUE(nlohmann::json::accept(said("certify --json " + scene)));

  EXPECT_EQ(optionsOf(*app_.get_subcommand("schema")), (std::set<std::string>{"kind"}));
  EXPECT_NE(said("schema rules"), said("schema scene"));

  EXPECT_EQ(optionsOf(*app_.get_subcommand("rules")), (std::set<std::string>{"name"}));
  EXPECT_EQ(said("rules ivy"), tests::fileText(tests::sourceFolder() / "rules/library/ivy.yaml"));
  EXPECT_NE(said("rules").find("ivy"), std::string::npos);

  EXPECT_EQ(optionsOf(*app_.get_subcommand("explain")), (std::set<std::string>{"key"}));
  EXPECT_NE(said("explain voxel"), said("explain bias.up"));
}

TEST_F(EveryFlag, OfInspectAndInitChangesWhatIsMade) {
  cli::addInspect(app_, status_);
  cli::addInit(app_, status_);
  const auto ran_with = [](const std::string& arguments) { return tests::espalier(arguments); };
  EXPECT_EQ(optionsOf(*app_.get_subcommand("inspect")),
            (std::set<std::string>{"mesh", "scene", "force", "json"}));
  const std::string mesh = scratch_.path("plot.obj").string(), made = scratch_.path("made.yaml").string();
  const std::string other = scratch_.write("other.obj", "v 0 0 0\nv 9 0 0\nv 9 4 0\nf 1 2 3\n").string();
  EXPECT_NE(ran_with("inspect " + mesh).output, ran_with("inspect " + other).output);
  EXPECT_TRUE(nlohmann::json::accept(ran_with("inspect --json " + mesh).output));
  EXPECT_FALSE(fs::exists(made));
  EXPECT_EQ(ran_with("inspect " + mesh + " --scene " + made).status, 0);
  const std::string before = bytes("made.yaml");
  EXPECT_EQ(ran_with("inspect " + other + " --scene " + made).status, 2);
  EXPECT_EQ(bytes("made.yaml"), before);
  EXPECT_EQ(ran_with("inspect " + other + " --force --scene " + made).status, 0);
  EXPECT_NE(bytes("made.yaml"), before);

  EXPECT_EQ(optionsOf(*app_.get_subcommand("init")), (std::set<std::string>{"folder"}));
  ran_with("init " + scratch_.path("project").string());
  EXPECT_TRUE(fs::exists(scratch_.path("project/scene.yaml")));
}

TEST_F(EveryFlag, OfTheProgramItselfAndEverySubcommandIsAmongThese) {
  const std::string help = tests::espalier("--help").output;
  EXPECT_NE(help, tests::espalier("--version").output);
  EXPECT_EQ(tests::espalier("--version").status, 0);
  std::set<std::string> told;
  std::istringstream lines(help.substr(help.find("Subcommands:")));
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line);) {
    if (line.starts_with("  ") && line[2] != ' ') told.insert(line.substr(2, line.find(' ', 2) - 2));
  }
  EXPECT_EQ(told, (std::set<std::string>{"certify", "check", "explain", "expose", "gallery", "grow", "init",
                                         "inspect", "render", "rules", "schema", "studio"}));
  EXPECT_EQ(help.substr(0, help.find("Subcommands:")).find("--", help.find("--version") + 2),
            std::string::npos)
      << "an option of the program itself that no test knows:\n"
      << help;
  for (const std::string& command : told)
    EXPECT_NE(tests::espalier(command + " --help").output, help) << command;
}

}  // namespace
}  // namespace espalier
