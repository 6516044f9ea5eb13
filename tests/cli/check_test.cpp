// espalier check: what it names, and how often it looks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/inotify.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

class Check : public tests::Plot {};

/// Counts how often files are opened while it lives.
class Openings {
 public:
  ~Openings() { ::close(descriptor_); }
  bool watch(const std::filesystem::path& file) {
    // Its end is asked for too: openings that follow on each other would count as one.
    const int watched = ::inotify_add_watch(descriptor_, file.c_str(), IN_OPEN | IN_CLOSE);
    names_[watched] = file.filename().string();
    return watched >= 0;
  }
  std::map<std::string, int> counted() {
    std::map<std::string, int> times;
    alignas(inotify_event) std::array<char, 4096> buffer{};
    for (ssize_t n = 0; (n = ::read(descriptor_, buffer.data(), buffer.size())) > 0;) {
      for (std::size_t at = 0; at < static_cast<std::size_t>(n);) {
        inotify_event event;
        std::memcpy(&event, buffer.data() + at, sizeof event);
        if ((event.mask & IN_OPEN) != 0) ++times[names_.at(event.wd)];
        at += sizeof event + event.len;
      }
    }
    return times;
  }

 private:
  int descriptor_ = ::inotify_init1(IN_NONBLOCK);
  std::map<int, std::string> names_;
};

TEST_F(Check, NamesEveryErrorOfEveryFile) {
  const auto a = scratch_.write("a.yaml", "espalier: rules\nnam: x\nlight: {boost: -1}\n");
  const auto b = scratch_.write("b.yaml", "espalier: scene\nmeshes: 3\n");
  const auto ran = tests::espalier("check " + a.string() + " " + b.string());
  EXPECT_EQ(ran.status, 2);
  for (const char* part : {"a.yaml:2:1:", "did you mean 'name'", "a.yaml:3:", "b.yaml:2:"}) {
    EXPECT_NE(ran.output.find(part), std::string::npos) << part << " in\n" << ran.output;
  }
}

/// One that changes meanwhile is judged as it was.
TEST_F(Check, ReadsEachFileOnce) {
  scratch_.write("alone.yaml", "espalier: rules\n");
  scratch_.write("bad.yaml", "espalier: scene\nmeshes: 3\n");
  for (const auto& [asked, status, read] :
       {std::tuple{"scene.yaml", 0, std::map<std::string, int>{{"scene.yaml", 1}, {"vine.yaml", 1}}},
        {"alone.yaml", 0, {{"alone.yaml", 1}}},
        {"bad.yaml", 2, {{"bad.yaml", 1}}}}) {
    Openings openings;
    for (const char* name : {"scene.yaml", "vine.yaml", "alone.yaml", "bad.yaml"})
      ASSERT_TRUE(openings.watch(scratch_.path(name))) << std::strerror(errno);
    const auto ran = tests::espalier("check " + scratch_.path(asked).string());
    EXPECT_EQ(ran.status, status) << ran.output;
    EXPECT_EQ(openings.counted(), read) << asked;
  }
}

/// The text alone: what can be said of it without a mesh being opened.
TEST_F(Check, OpensNoMeshForTheTextAlone) {
  Openings openings;
  for (const char* name : {"scene.yaml", "plot.obj"}) ASSERT_TRUE(openings.watch(scratch_.path(name)));
  const auto ran = tests::espalier("check --text-only " + scratch_.path("scene.yaml").string());
  EXPECT_EQ(ran.status, 0);
  EXPECT_EQ(ran.output, "");
  EXPECT_EQ(openings.counted(), (std::map<std::string, int>{{"scene.yaml", 1}}));
}

TEST_F(Check, JsonHasThePlacesThatEditorsUnderline) {
  const auto problems = [&](const std::string& text) {
    const auto ran = tests::espalier("check --text-only --json " + scratch_.write("bad.yaml", text).string());
    EXPECT_EQ(ran.status, 2);
    return nlohmann::json::parse(ran.output)["problems"];
  };
  const auto all = problems(
      "espalier: scene\nworld: {voxel: '5 kg', bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\nplants:\n  - "
      "seeds: [[0, 0, 0]]\n    rules:\n"
      "      light: {bost: 2}\n      bias: {up: größer}\n");
  ASSERT_EQ(all.size(), 3u) << all;
  const auto expect = [&](std::size_t i, int line, int column, int end_column, const std::string& key) {
    EXPECT_EQ(all[i]["file"], scratch_.path("bad.yaml").string());
    EXPECT_EQ(all[i]["line"], line);
    EXPECT_EQ(all[i]["column"], column);
    EXPECT_EQ(all[i]["end_line"], line);
    EXPECT_EQ(all[i]["end_column"], end_column);
    EXPECT_EQ(all[i]["key"], key);
  };
  expect(0, 2, 16, 22, "world.voxel");
  expect(1, 6, 15, 19, "plants[0].rules.light.bost");
  expect(2, 7, 18, 24, "plants[0].rules.bias.up");
  const auto broken = problems("espalier: scene\nworld: {voxel: [\n");  // no key to name, and no end
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_FALSE(broken[0].contains("end_column"));
  EXPECT_FALSE(broken[0].contains("key"));
}

TEST_F(Check, JsonIsThereWithoutProblemsAndOfSeveralFiles) {
  const std::string good = scratch_.path("vine.yaml").string(),
                    bad = scratch_.write("bad.yaml", "espalier: rules\nnam: x\n").string();
  EXPECT_EQ(nlohmann::json::parse(tests::espalier("check --json " + good).output),
            (nlohmann::json{{"problems", nlohmann::json::array()}, {"foretold", nlohmann::json::array()}}));
  const auto ran = tests::espalier("check --json " + good + " " + bad + " " + scratch_.path("gone").string());
  EXPECT_EQ(ran.status, 2);
  const auto problems = nlohmann::json::parse(ran.output)["problems"];
  ASSERT_EQ(problems.size(), 2u) << problems;
  EXPECT_EQ(problems[0]["file"], bad);
  EXPECT_FALSE(problems[1].contains("line"));
}

/// Rules say some things without effect, which is told also where no scene uses them.
TEST_F(Check, WarnsOfRulesAlone) {
  const auto ran = tests::espalier(
      "check " + scratch_.write("r.yaml", "espalier: rules\notherwise: {stem: {radius: 1 cm}}\n").string());
  EXPECT_EQ(ran.status, 0);
  EXPECT_NE(ran.output.find("r.yaml:2:13: warning: otherwise.stem has no effect"), std::string::npos)
      << ran.output;
}

/// As an editor has it that was not saved yet: other files are found beside the one that it is to become.
TEST_F(Check, ReadsStandardInputAsTheFileThatItIsToBecome) {
  const std::string file = scratch_.path("scene.yaml").string();
  const auto piped = [&](const std::string& text, const std::string& arguments) {
    return tests::run("printf '" + text + "' | " ESPALIER_PROGRAM " check " + arguments);
  };
  const std::string start = "espalier: scene\\nmeshes: [plot.obj]\\nworld: {voxel: 5 cm}\\n";
  EXPECT_EQ(piped(start, "--text-only - --as " + file).output, "");
  const auto bad = piped(start + "sede: 1\\n", "--text-only --json - --as " + file);
  EXPECT_EQ(bad.status, 2);
  EXPECT_EQ(nlohmann::json::parse(bad.output)["problems"][0]["file"], file);
  EXPECT_EQ(nlohmann::json::parse(bad.output)["problems"][0]["line"], 4);
  for (const std::string arguments : {"-", "scene.yaml --as b.yaml", "- - --as b.yaml"})
    EXPECT_EQ(piped(start, arguments).status, 2) << arguments;
  const auto large = tests::run("head -c 2000000 /dev/zero | " ESPALIER_PROGRAM " check - --as " + file);
  EXPECT_EQ(large.output, file + ": is too large; expected at most 1000000 bytes\n");
}

/// A house in centimetres: the voxel size that would fit is no cure, and the unit is named on a line of its
/// own.
TEST_F(Check, NamesTheUnitOfAMeshThatIsFarTooLarge) {
  std::string mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh += fmt::format("v {} {} {}\n", (corner & 1) * 880, (corner & 2) * 305, (corner & 4) * 145);
  scratch_.write("plot.obj", mesh + "f 1 2 6 5\nf 1 3 4 2\nf 5 6 8 7\nf 1 5 7 3\nf 2 4 8 6\n");
  const std::string scene =
      scratch_.write("house.yaml", "espalier: scene\nmeshes: [plot.obj]\nworld: {voxel: 1 cm}\n").string();
  const auto ran = tests::espalier("check " + scene);
  EXPECT_EQ(ran.status, 2);
  EXPECT_TRUE(ran.output.starts_with(scene + ":3:16: a world of ")) << ran.output;
  EXPECT_NE(ran.output.find("would fit\n" + scene + ":2:10: the mesh 'plot'"), std::string::npos)
      << ran.output;
}

}  // namespace
}  // namespace espalier
