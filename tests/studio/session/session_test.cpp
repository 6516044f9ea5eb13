// An edit makes anew what it touches and nothing else, and what stands is what a run of the same texts grows.
#include "studio/session/session.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "sim/base/provenance.h"
#include "studio/session/refused.h"
#include "tests/studio/small_project.h"

namespace espalier::studio {
namespace {

using nlohmann::json;
using tests::Heard;
using tests::kSmallRules;
using tests::kSmallScene;
using tests::replaced;

class Studio : public tests::SmallProject {
 protected:
  void open(int threads = 2) {
    session_ = std::make_unique<Session>(scratch_.path("scene.yaml"), threads);
    heard_ = std::make_unique<Heard>(session_->listen());
    heard_->grown(1);
  }
  /// The answer; `version` is then its own.
  json edit(const std::string& name, const std::string& text) {
    const json answer = json::parse(session_->edit({{name, text}}));
    version_ = answer["version"];
    return answer;
  }
  /// How often each stage ran for an edit, of which something can be made.
  json stagesOf(const std::string& name, const std::string& text) {
    const json answer = edit(name, text);
    EXPECT_EQ(answer["problems"], json::array()) << text;
    grown_ = heard_->grown(version_);
    return heard_->until("stages", version_)["ran"];
  }
  /// What the command line grows from the files.
  std::string hashOfARun() {
    const auto scene = scenes::readScene(scratch_.path("scene.yaml"));
    EXPECT_TRUE(scene);
    scenes::RunOptions options;
    options.folder = scratch_.path("run");
    options.pictures = false;
    return sim::hexOf(scenes::runScene(*scene, options).growth->state_hash);
  }

  std::unique_ptr<Session> session_;
  std::unique_ptr<Heard> heard_;
  std::uint32_t version_ = 1;
  json grown_;
};

TEST_F(Studio, AnEditMakesAnewWhatItTouches) {
  open();
  const json bias = stagesOf("vine.yaml", replaced(kSmallRules, "up: 0.1", "up: 0.3"));
  EXPECT_EQ(bias, (json{{"preparing", 1}, {"growing", 1}}));
  const std::string red = replaced(replaced(kSmallRules, "up: 0.1", "up: 0.3"), "#4f7a2c", "#ff0000");
  EXPECT_EQ(stagesOf("vine.yaml", red), (json{{"preparing", 1}, {"dressing", 1}}));
  EXPECT_EQ(stagesOf("vine.yaml", replaced(red, "# how far up", "# higher")), (json{{"preparing", 1}}));
  EXPECT_EQ(stagesOf("scene.yaml", replaced(kSmallScene, "seed: 5", "seed: 5\nsun: {tilt: 30}")),
            (json{{"lighting", 1}, {"preparing", 1}, {"growing", 1}}));
  EXPECT_EQ(stagesOf("scene.yaml", replaced(kSmallScene, "eye: [2.2", "eye: [2.5")),
            (json{{"lighting", 1}, {"preparing", 1}, {"growing", 1}}))
      << "the sun went back";
  EXPECT_EQ(stagesOf("scene.yaml", replaced(kSmallScene, "eye: [2.2", "eye: [2.7")),
            (json{{"preparing", 1}}));
  EXPECT_EQ(stagesOf("scene.yaml", replaced(kSmallScene, "voxel: 5 cm", "voxel: 4 cm")),
            (json{{"tiling", 1}, {"preparing", 1}, {"growing", 1}}));
  EXPECT_EQ(stagesOf("vine.yaml", replaced(red, "max: 3", "max: 40 cm")),
            (json{{"layering", 1}, {"preparing", 1}, {"growing", 1}}));
}

TEST_F(Studio, WhatStandsIsWhatARunGrowsOnAnyThreadsAfterAnyEdits) {
  const std::string first = hashOfARun();
  for (const int threads : {1, 2, 5}) {
    open(threads);
    stagesOf("vine.yaml", replaced(kSmallRules, "up: 0.1", "up: 0.7"));
    EXPECT_NE(grown_["hash"], first);
    stagesOf("vine.yaml", replaced(kSmallRules, "max: 3", "max: 6"));
    stagesOf("scene.yaml", replaced(kSmallScene, "voxel: 5 cm", "voxel: 6 cm"));
    stagesOf("scene.yaml", kSmallScene);
    stagesOf("vine.yaml", kSmallRules);
    EXPECT_EQ(grown_["hash"], first) << threads;
  }
}

TEST_F(Studio, BrokenTextsLeaveWhatStands) {
  open();
  const json answer = edit("vine.yaml", replaced(kSmallRules, "up: 0.1", "upp: 0.1"));
  ASSERT_EQ(answer["problems"].size(), 1u);
  const json& problem = answer["problems"][0];
  EXPECT_EQ(problem["file"], "vine.yaml");
  EXPECT_EQ(problem["line"], 4);
  EXPECT_EQ(problem["column"], 8);
  EXPECT_EQ(problem["end_column"], 11);
  EXPECT_EQ(problem["fix"], "up");
  EXPECT_EQ(problem["severity"], "error");
  EXPECT_EQ(heard_->until("problems", version_)["depth"], "text");
  // What is wrong with the site comes later, and in place.
  const json wall = edit("scene.yaml", replaced(kSmallScene, "[-0.4, 0.1, 0.1]", "[-0.4, 0.5, 0.0]"));
  EXPECT_EQ(wall["problems"].size(), 1u) << "the rules are still broken";
  edit("vine.yaml", kSmallRules);
  const json told =
      heard_->until("problems", version_, [](const json& event) { return event["depth"] == "site"; });
  ASSERT_GE(told["problems"].size(), 1u);
  EXPECT_EQ(told["problems"][0]["file"], "scene.yaml");
  EXPECT_EQ(told["problems"][0]["line"], 10);
  // And all is well again, without anything grown anew.
  EXPECT_EQ(stagesOf("scene.yaml", kSmallScene), (json{{"preparing", 1}}));
}

TEST_F(Studio, SomebodyWhoComesLaterHearsAllThatStands) {
  open();
  stagesOf("vine.yaml", replaced(kSmallRules, "up: 0.1", "up: 0.3"));
  Heard other(session_->listen());
  const json grown = other.grown(version_);
  EXPECT_EQ(grown, grown_);
  std::size_t nodes = 0, elements = 0;
  for (const Heard::Frame& frame : other.frames) {
    std::uint32_t words[6];
    if (frame.kind == 1) continue;
    std::memcpy(words, frame.payload.data(), sizeof words);
    EXPECT_EQ(words[0], version_);
    (frame.kind == 2 ? nodes : elements) += frame.kind == 2 ? words[3] : words[4];
  }
  EXPECT_EQ(nodes, grown["segments"].get<std::size_t>() + 2) << "and the seeds";
  EXPECT_EQ(elements, grown["elements"].get<std::size_t>());
  EXPECT_GT(elements, 0u);
}

/// Where nodes of a version stand that were born early, in metres, by plant and number.
std::map<std::pair<std::uint32_t, std::uint32_t>, sim::Vec3> earlyNodes(
    const std::vector<Heard::Frame>& frames, std::uint32_t version) {
  constexpr std::uint16_t kEarly = 5;
  std::map<std::pair<std::uint32_t, std::uint32_t>, sim::Vec3> nodes;
  for (const Heard::Frame& frame : frames) {
    std::uint32_t header[6];
    if (frame.kind != 2) continue;
    std::memcpy(header, frame.payload.data(), sizeof header);
    const auto [own, plant, first, count, total, iteration] = header;
    if (own != version) continue;
    for (std::uint32_t i = 0; i < count; ++i) {
      float at[3];
      std::uint16_t born = 0;
      std::memcpy(at, frame.payload.data() + 24 + 4 * count + 12 * i, sizeof at);
      std::memcpy(&born, frame.payload.data() + 24 + 16 * count + 4 * total + 2 * i, sizeof born);
      if (born < kEarly) nodes[{plant, first + i}] = sim::Vec3(at[0], at[1], at[2]);
    }
  }
  return nodes;
}

TEST_F(Studio, SmallEditsGiveSmallChanges) {
  open();
  const auto nodesOf = [&](const std::string& file, const std::string& text) {
    stagesOf(file, text);
    return earlyNodes(heard_->frames, version_);
  };
  // The share of nodes that move by less than half a voxel.
  const auto kept = [](const auto& a, const auto& b) {
    std::size_t near = 0;
    for (const auto& [node, at] : a) {
      const auto other = b.find(node);
      if (other != b.end() && glm::distance(at, other->second) < 0.025) ++near;
    }
    EXPECT_GT(a.size(), 10u);
    return static_cast<double>(near) / static_cast<double>(a.size());
  };
  const auto before = earlyNodes(heard_->frames, 1);
  const auto nudged = nodesOf("vine.yaml", replaced(kSmallRules, "up: 0.1", "up: 0.101"));
  nodesOf("vine.yaml", kSmallRules);
  const auto other = nodesOf("scene.yaml", replaced(kSmallScene, "seed: 5", "seed: 6"));
  EXPECT_NE(before, nudged);
  EXPECT_GT(kept(before, nudged), 0.6);
  EXPECT_LT(kept(before, other), 0.2) << "another seed is another plant";
}

TEST_F(Studio, ANodeSaysWhyItIsThere) {
  open();
  stagesOf("vine.yaml", replaced(kSmallRules, "up: 0.1", "up: 0.3"));
  const json why = json::parse(session_->why(version_, 0, 3));
  EXPECT_EQ(why["name"], "vine 1");
  ASSERT_FALSE(why["came"].is_null());
  EXPECT_EQ(why["came"]["iteration"], why["born"]);
  std::size_t taken = 0, rejected = 0;
  for (const json& trial : why["came"]["trials"]) {
    if (trial["outcome"] != "grown") ++rejected;
    double apart = 0;
    for (int axis = 0; axis < 3; ++axis)
      apart += std::abs(trial["to_m"][axis].get<double>() - why["at_m"][axis].get<double>());
    if (apart < 1e-9) ++taken;
  }
  EXPECT_EQ(taken, 1u) << "one trial became the node";
  EXPECT_GT(rejected, 0u);
  EXPECT_THROW(session_->why(version_, 0, 100000), Refused);
  EXPECT_THROW(session_->why(version_, 7, 0), Refused);
  EXPECT_THROW(session_->why(version_ - 1, 0, 0), Refused);
  // To ask changes nothing.
  EXPECT_EQ(stagesOf("vine.yaml", replaced(kSmallRules, "up: 0.1", "up: 0.30")), (json{{"preparing", 1}}));
}

TEST_F(Studio, SurfacesSayWhatFallsOnThem) {
  open();
  const std::string bytes = session_->surfaces(1);
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data(), 4);
  const json header = json::parse(bytes.substr(4, length));
  const std::size_t count = header["count"], channels = header["channels"].size();
  EXPECT_EQ(bytes.size(), 4 + length + count * (6 + 1 + channels));
  EXPECT_GT(count, 500u);
  EXPECT_EQ(header["channels"][0]["name"], "sky exposure");
  EXPECT_EQ(header["channels"].back()["name"], "exposure of vine");
  // Open ground far from the wall sees nearly all of the sky.
  int brightest = 0;
  for (std::size_t i = 0; i < count; ++i)
    brightest = std::max<int>(brightest, static_cast<unsigned char>(bytes[4 + length + 7 * count + i]));
  EXPECT_GT(brightest, 200);
  EXPECT_THROW(session_->surfaces(7), Refused);
}

TEST_F(Studio, ACutShowsTheLayersAroundTheWall) {
  open();
  const std::string bytes = session_->layers(1, 2, 0.0);  // in the wall's own plane
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data(), 4);
  const json header = json::parse(bytes.substr(4, length));
  const std::size_t across = header["across"], up = header["up"];
  ASSERT_EQ(bytes.size(), 4 + length + across * up);
  EXPECT_NEAR(header["across_m"][0], 2.2, 0.051);
  std::array<std::size_t, 256> times{};
  for (std::size_t i = 4 + length; i < bytes.size(); ++i) ++times[static_cast<unsigned char>(bytes[i])];
  EXPECT_GT(times[255], 500u) << "the wall";
  EXPECT_GT(times[0], 20u) << "beyond all layers";
  for (std::size_t layer = 1; layer <= header["layers"]; ++layer) EXPECT_GT(times[layer], 20u) << layer;
  EXPECT_THROW(session_->layers(1, 1, 99.0), Refused);
}

TEST_F(Studio, ExportsAreThoseOfARun) {
  open();
  const json made = json::parse(session_->makeExport("skeleton", ""));
  ASSERT_EQ(made["files"].size(), 1u);
  hashOfARun();
  EXPECT_EQ(session_->exported("skeleton.json"), tests::fileText(scratch_.path("run/skeleton.json")));
  EXPECT_EQ(session_->exported("report.json"), std::nullopt) << "nobody asked for it";
  EXPECT_EQ(session_->exported("../scene.yaml"), std::nullopt);
  const json picture = json::parse(session_->makeExport("image", "vines"));
  ASSERT_EQ(picture["files"].size(), 1u) << picture;
  EXPECT_EQ(picture["files"][0]["name"], "vines.png");
  EXPECT_THROW(session_->makeExport("image", "none"), Refused);
  EXPECT_THROW(session_->makeExport("usd", ""), Refused);
}

TEST_F(Studio, ASceneOfWrongTextsOpensToo) {
  scratch_.write("vine.yaml", replaced(kSmallRules, "up: 0.1", "upp: 0.1"));
  session_ = std::make_unique<Session>(scratch_.path("scene.yaml"), 2);
  heard_ = std::make_unique<Heard>(session_->listen());
  const json told = heard_->until("problems", 1);
  ASSERT_EQ(told["problems"].size(), 1u);
  const json project = json::parse(session_->project());
  EXPECT_EQ(project["files"].size(), 2u) << "the file that is wrong can be mended here: " << project;
  stagesOf("vine.yaml", kSmallRules);
  EXPECT_GT(grown_["segments"], 20);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // which keeps what is freed
#else
constexpr bool kSanitized = false;
#endif

std::size_t residentBytes() {
  std::ifstream status("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  status >> all >> resident;
  return resident * 4096;
}

/// Valid and broken edits, most of them before the last has grown.
TEST_F(Studio, LivesThroughAnyEditsAndEndsWhereARunDoes) {
  open();
  std::mt19937 random(5);
  const std::vector<std::pair<std::string, std::vector<std::string>>> knobs{
      {"up: 0.1", {"up: 0.2", "up: 0.9", "up: nine", "upp: 0.1", "up: [0.1, 0.2]"}},
      {"branch_angle: 60", {"branch_angle: 10", "branch_angle: 400", "branch_angle: }"}},
      {"size: 1.2", {"size: 0.4", "size: -1", "size: [0.5, 2]"}},
      {"#4f7a2c", {"#a04020", "#zzz"}},
      {"max: 3", {"max: 1", "max: 9", "max: 1 km"}},
      {"boost: 1.8", {"boost: 0.5", "boost: \"", "boost: 1e9"}},
      {"espalier: rules", {"espalier: scene", "", "\t", "espalier: rules/1"}}};
  std::size_t valid = 0;
  std::size_t before = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string text = kSmallRules;
    for (const auto& [word, others] : knobs) {
      if (random() % 3 == 0) text = replaced(text, word, others[random() % others.size()]);
    }
    if (edit("vine.yaml", text)["problems"].empty()) ++valid;
    if (random() % 7 == 0) edit("scene.yaml", replaced(kSmallScene, "5 cm", random() % 2 ? "6 cm" : "x"));
    if (random() % 11 == 0) edit("scene.yaml", kSmallScene);
    if (i % 100 != 99) continue;
    edit("scene.yaml", kSmallScene);
    edit("vine.yaml", kSmallRules);
    heard_->grown(version_);
    heard_->frames.clear();
    if (i == 299) before = residentBytes();
  }
  EXPECT_GT(valid, 100u);
  edit("scene.yaml", kSmallScene);
  if (!kSanitized) {
    EXPECT_LT(residentBytes(), before + (std::size_t{16} << 20)) << "memory stays flat";
  }
  edit("vine.yaml", replaced(kSmallRules, "size: 1.2", "size: 1.1"));
  const json grown = heard_->grown(version_);
  scratch_.write("vine.yaml", replaced(kSmallRules, "size: 1.2", "size: 1.1"));
  EXPECT_EQ(grown["hash"], hashOfARun());
}

}  // namespace
}  // namespace espalier::studio
