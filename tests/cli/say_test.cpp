// What the program says, to whom, and what it makes of a report that cannot be written.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/clean_text.h"
#include "tests/cli/plot.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using tests::Ran;

/// A scene that grows in no time, and the program run by a shell with its streams bent.
class Say : public tests::Plot {
 protected:
  void SetUp() override {
    Plot::SetUp();
    std::string scene = tests::kPlotScene;
    scene.replace(scene.find("images:"), std::string::npos, "images: [{kind: section, axis: y, at: 0.5}]\n");
    scene.replace(scene.find("iterations: 14"), 14, "iterations: 3");
    scratch_.write("scene.yaml", scene);
    scratch_.write("bad.yaml", "espalier: rules\nlenght: 1\n");
  }

  /// `arguments` may redirect. What is still connected to this test comes back.
  Ran shell(const std::string& arguments) const {
    return tests::run("cd " + scratch_.path("").string() + " && ( " + ESPALIER_PROGRAM + " " + arguments +
                      " )");
  }
  Ran growing(const std::string& more) const { return shell("grow scene.yaml -o out " + more); }
  void expectWhole() {
    EXPECT_EQ(report()["growth"]["iterations"], 3);
    for (const auto& entry : fs::directory_iterator(scratch_.path("out")))
      EXPECT_FALSE(entry.path().filename().string().starts_with(".espalier-part")) << entry.path();
    fs::remove_all(scratch_.path("out"));
  }
};

TEST_F(Say, NobodyWhoHearsIsNoReasonToFail) {
  for (const char* deaf :
       {">/dev/null 2>/dev/full", ">/dev/null 2>&-", "--quiet >&- 2>&-", "--quiet <&- >&- 2>&-",
        "--quiet >/dev/full 2>/dev/full", "--json 2>&- >/dev/null"}) {
    EXPECT_EQ(growing(deaf).status, 0) << deaf;
    expectWhole();
  }
  EXPECT_EQ(shell("check vine.yaml <&- >&- 2>&-").status, 0);
  EXPECT_EQ(shell("check bad.yaml 2>/dev/full").status, 2);
  EXPECT_EQ(shell("check bad.yaml <&- >&- 2>&-").status, 2);
  EXPECT_EQ(shell("grow --no-such-option 2>/dev/full").status, 2);
}

TEST_F(Say, AResultThatIsLostIsAFailureThatIsToldOf) {
  ASSERT_EQ(growing("--quiet").status, 0);  // to be rendered
  const auto expectLost = [&](const std::string& command, const std::string& lost) {
    const Ran ran = shell(command + " " + lost);
    EXPECT_EQ(ran.status, 1) << command << lost << ran.output;
    EXPECT_NE(ran.output.find("espalier: standard output cannot be written ("), std::string::npos)
        << command << lost << ran.output;
  };
  for (const char* command : {"grow scene.yaml -o other", "grow scene.yaml -o other --json",
                              "expose scene.yaml -o other --no-pictures", "render scene.yaml --from out",
                              "certify scene.yaml", "schema rules", "--help", "--version"})
    expectLost(command, ">/dev/full");
  for (const char* command : {"grow scene.yaml -o other --json", "schema scene", "grow --help"})
    expectLost(command, ">&-");
  // The work itself is done.
  growing("--json >/dev/full");
  expectWhole();
}

TEST_F(Say, AnErrorIsNotHiddenByALostResult) {
  EXPECT_EQ(shell("check bad.yaml >/dev/full").status, 2);
  EXPECT_EQ(shell("grow nothing.yaml >/dev/full 2>/dev/full").status, 2);
}

TEST_F(Say, WhoHasReadEnoughClosesThePipeAndThatIsQuiet) {
  // A pipe whose reader has gone before anything is written.
  for (const char* command : {"schema rules", "grow scene.yaml -o out --json"}) {
    const Ran ran = tests::run("cd " + scratch_.path("").string() +
                               " && bash -c '{ while [ ! -e gone ]; do sleep 0.1; done; " + ESPALIER_PROGRAM +
                               " " + command + "; echo status $? >&2; } | { exec <&-; touch gone; }'");
    EXPECT_EQ(ran.output, "status 1\n") << command;
  }
  expectWhole();
}

TEST_F(Say, NoFileBecomesAStandardStream) {
  EXPECT_EQ(growing("--threads 2 <&- >&- 2>&-").status, 1);  // the summary is lost
  EXPECT_EQ(tests::fileText(scratch_.path("out/plant.glb")).substr(0, 4), "glTF");
  EXPECT_EQ(tests::fileText(scratch_.path("out/section.png")).substr(1, 3), "PNG");
  expectWhole();
}

/// Whether a terminal only shows it, and nobody has to read for long.
void expectHarmless(const Ran& ran, const std::string& about) {
  std::string all = ran.output;
  std::erase(all, '\n');
  EXPECT_EQ(scenes::printable(all), all) << about;
  for (std::size_t at = 0; at < ran.output.size();) {
    const auto end = std::min(ran.output.find('\n', at), ran.output.size());
    EXPECT_LT(end - at, 1500u) << about;
    at = end + 1;
  }
}

/// Names: with all that a terminal obeys, with what forges a line, and a long one.
const std::vector<std::string> kVile = {
    "\x1b[31m\x1b]0;title\x07\r\b\t\x7f\xc2\x9b"
    "31m\xe2\x80\xae\xe2\x81\xa6\xd8\x9c\xe2\x80\x8f\xe2\x80\xa8\xff\xfe\x80.yaml",
    "a\nespalier: all is well", std::string(250, 'x')};

TEST_F(Say, NamesOfFilesFoldersAndOptionsAreHarmless) {
  for (const std::string& vile : kVile) {
    const std::string name = "'" + vile + "'";
    for (const std::string& command :
         {"check " + name + " none/" + name, "grow scene.yaml -o /dev/null/" + name,
          "render scene.yaml --from " + name, "grow scene.yaml --seed " + name, "grow scene.yaml --" + name,
          name}) {
      const Ran ran = shell(command);
      EXPECT_EQ(ran.status, 2) << ran.output;
      expectHarmless(ran, command);
      EXPECT_EQ(ran.output.find("\nespalier: all is well"), std::string::npos) << ran.output;
    }
  }
}

TEST_F(Say, AFolderOfAnyNameCanBeWorkedIn) {
  for (const std::string& vile : kVile) {
    const std::string name = "'" + vile + "'";
    for (const char* file : {"scene.yaml", "plot.obj"})
      scratch_.write(vile + "/" + file, tests::fileText(scratch_.path(file)));
    scratch_.write(vile + "/vine.yaml", "espalier: rules\nregions: {roof: forbid}\n");
    const Ran grown = shell("grow " + name + "/scene.yaml -o " + name + "/out");
    EXPECT_EQ(grown.status, 0) << grown.output;
    expectHarmless(grown, vile);
    EXPECT_EQ(grown.output.find("\nespalier: all is well"), std::string::npos) << grown.output;
    const Ran told = shell("grow " + name + "/scene.yaml -o " + name + "/out --json 2>/dev/null");
    EXPECT_EQ(told.status, 0) << told.output;
    expectHarmless(told, vile);
    const auto kept = nlohmann::json::parse(tests::fileText(scratch_.path(vile) / "out/report.json"));
    EXPECT_EQ(nlohmann::json::parse(told.output)["run"]["scene"], kept["run"]["scene"]);
  }
}

TEST_F(Say, TextsOfFilesAreHarmless) {
  std::string files;
  const auto add = [&](const std::string& text) {
    const std::string name = "f" + std::to_string(files.size()) + ".yaml";
    scratch_.write(name, text);
    files += " " + name;
  };
  for (const std::string escape : {"\\x1b[31m", "\\u009b31m", "\\x7f", "\\u202e", "\\u2028", "\\n!", "\\0"}) {
    const std::string vile = "\"a" + escape + "b\"";
    for (const std::string& rules :
         {"base: " + vile, "base: \"no/" + escape + ".yaml\"", vile + ": 1",
          "regions: {" + vile + ": {lenght: 1}}", "regions: {" + vile + ": perhaps}", "otherwise: " + vile,
          "propagate: " + vile, "elements: [{name: " + vile + "}]", "random_tree: {length: " + vile + "}",
          "stem: {colour: " + vile + "}"})
      add("espalier: rules\n" + rules + "\n");
    for (const std::string& scene :
         {"meshes: [" + vile + "]", "meshes: [\"no" + escape + ".obj\"]",
          "meshes: [{file: plot.obj, name: " + vile + "}]", "plants: [{name: " + vile + "}]",
          "plants: [{rules: " + vile + "}]", "cameras: {" + vile + ": 1}", "images: [{kind: " + vile + "}]",
          "images: [{kind: section, camera: " + vile + "}]"})
      add("espalier: scene\nname: " + vile + "\nworld: {voxel: 1}\n" + scene + "\n");
  }
  const Ran ran = shell("check" + files);
  EXPECT_EQ(ran.status, 2);
  expectHarmless(ran, "check");
  EXPECT_EQ(ran.output.find("\n!"), std::string::npos);
}

TEST_F(Say, WhatARunTellsOfItsFilesIsHarmless) {
  // Characters that YAML takes, in every name that a run repeats.
  const std::string vile = "\xe2\x80\xaevile\xe2\x81\xa6\xe2\x80\xa8\xd8\x9c";
  scratch_.write("vile.obj", "mtllib " + vile + ".mtl\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 1 1\no " + vile +
                                 "\x1b[31m\ng " + vile + "\x1b[31m\nusemtl " + vile + "\nf 1 2 3\nf 1 3 4\n");
  scratch_.write(vile + ".mtl", "newmtl " + vile + "\nKd 0.5 0.5 0.5\n");
  scratch_.write("s.yaml", "espalier: scene\nname: " + vile +
                               "\nmeshes: [{file: vile.obj, solid: true}]\nworld: {voxel: 10 cm, margin: 20 "
                               "cm}\niterations: 1\nplants: [{rules: {name: " +
                               vile + ", regions: {" + vile + "oof: forbid}}, seeds: [[0.5, 0.2, 0.3]]}]\n");
  for (const char* command :
       {"grow s.yaml -o out", "grow s.yaml -o out --json", "grow s.yaml -o out --strict",
        "expose s.yaml -o out --no-pictures", "certify s.yaml", "certify s.yaml --json"}) {
    const Ran ran = shell(command);
    EXPECT_NE(ran.status, 1) << ran.output;
    expectHarmless(ran, command);
    EXPECT_NE(ran.output.find("\\u202e"), std::string::npos) << command << ran.output;
  }
}

TEST_F(Say, WhatNobodyCanCatchIsSaidAndIsNoCrash) {
  const Ran ran = tests::run("cd " + scratch_.path("").string() + "; ulimit -v 2000000; " + ESPALIER_PROGRAM +
                             " grow scene.yaml -o out --quiet --threads 1000");
  EXPECT_EQ(ran.status, 1) << ran.output;
  EXPECT_TRUE(ran.output.starts_with("scene.yaml: while ")) << ran.output;
  EXPECT_FALSE(fs::exists(scratch_.path("out/plant.glb")));
}

}  // namespace
}  // namespace espalier
