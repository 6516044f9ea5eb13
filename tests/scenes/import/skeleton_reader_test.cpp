#include "scenes/import/skeleton_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "tests/support/messages.h"
#include "tests/support/numbers.h"
#include "tests/support/scratch.h"

/// Skeletons of others: what their files hold, and what is said of files that hold something else.
namespace espalier::scenes {
namespace {

using sim::Vec3;

class Skeletons : public testing::Test {
 protected:
  std::vector<FileTree> read(const std::string& name, const std::string& text) {
    return readSkeletons(scratch_.write(name, text), read_);
  }
  void expectRefused(const std::string& name, const std::string& text, const std::string& because) {
    const auto file = scratch_.write(name, text);
    const std::string said = tests::messageOf([&] { readSkeletons(file, read_); });
    EXPECT_TRUE(said.starts_with(file.string() + ": ")) << said;
    EXPECT_NE(said.find(because), std::string::npos) << said << "\n  of " << text;
  }

  tests::Scratch scratch_;
  sim::InputFile read_;
};

constexpr const char* kPlain = R"({"nodes": [
  {"parent": 2, "position": [0, 3, 0], "radius": 0.1},
  {"parent": -1, "position": [0, 0, 0]},
  {"parent": 1, "position": [0, 1, 0], "radius": 0.25},
  {"parent": 2, "position": [1, 2, 0.5], "radius": 0.125}]})";

TEST_F(Skeletons, OfNodesInAnyOrderBeginAtTheirRoot) {
  const auto trees = read("tree.json", kPlain);
  ASSERT_EQ(trees.size(), 1u);
  EXPECT_EQ(trees[0].parent, (std::vector<std::int32_t>{-1, 0, 1, 1}));
  EXPECT_EQ(trees[0].position, (std::vector<Vec3>{{0, 0, 0}, {0, 1, 0}, {0, 3, 0}, {1, 2, 0.5}}));
  EXPECT_EQ(std::vector<float>(trees[0].radius.begin() + 1, trees[0].radius.end()),
            (std::vector<float>{0.25f, 0.1f, 0.125f}));
  EXPECT_EQ(trees[0].number, (std::vector<std::int32_t>{1, 2, 0, 3}));
  EXPECT_EQ(read_, (sim::InputFile{"tree.json", "skeleton", sim::hashOf(std::string_view(kPlain))}));
}

TEST_F(Skeletons, MayBeListsOfNodesAndOfSeveralTrees) {
  const auto trees = read("two.json", R"([{"position": [5, 0, 0]}, {"parent": 0, "position": [5, 1, 0]},
    {"parent": null, "position": [7, 0, 0]}, {"parent": 2, "position": [7, 2, 0]},
    {"parent": -1, "position": [9, 9, 9]}])");
  ASSERT_EQ(trees.size(), 2u);  // a root alone is none
  EXPECT_EQ(trees[0].position[1], Vec3(5, 1, 0));
  EXPECT_EQ(trees[1].position, (std::vector<Vec3>{{7, 0, 0}, {7, 2, 0}}));
  EXPECT_TRUE(trees[0].radius.empty());
}

TEST_F(Skeletons, OfOurOwnAreColumns) {
  const auto trees = read("own.json", R"({"espalier": "skeleton/1", "plants": [
    {"name": "a", "parent": [-1, 0], "position_m": [[0, 0, 0], [0, 1, 0]], "radius_m": [1, 0.5], "born": [0, 3]},
    {"name": "bare", "parent": [-1], "position_m": [[0, 0, 0]], "radius_m": [0.1]},
    {"name": "b", "parent": [-1, 0], "position_m": [[2, 0, 0], [2, 1, 0]], "radius_m": [0, 0.25]}]})");
  ASSERT_EQ(trees.size(), 2u);
  EXPECT_EQ(trees[0].name + trees[1].name, "ab");
  EXPECT_EQ(trees[1].radius[1], 0.25f);
}

TEST_F(Skeletons, OfLinesHangTogetherByTheirVertices) {
  const auto trees = read("tree.obj", R"(# a fork, whose second line is drawn towards it, and a stick
v 0 0 0
v 0 1 0
v 0 2 0 1
v 1 2 0 0.5 0.5 0.5
g tree
l 1/1 2/2 3
l -1 2
v 5 0 0
v 5 1 0
v 8 8 8
usemtl none
l 5 \
  6
)");
  ASSERT_EQ(trees.size(), 2u);
  EXPECT_EQ(trees[0].parent, (std::vector<std::int32_t>{-1, 0, 1, 1}));
  EXPECT_EQ(trees[0].position, (std::vector<Vec3>{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {1, 2, 0}}));
  EXPECT_EQ(trees[0].number, (std::vector<std::int32_t>{1, 2, 3, 4}));
  EXPECT_TRUE(trees[0].radius.empty());
  EXPECT_EQ(trees[1].position, (std::vector<Vec3>{{5, 0, 0}, {5, 1, 0}}));
}

TEST_F(Skeletons, BeginWhereTheFirstLineDoes) {
  const auto trees = read("down.obj", "v 0 0 0\nv 0 1 0\nv 0 2 0\nl 3 2\nl 2 1\n");
  ASSERT_EQ(trees.size(), 1u);
  EXPECT_EQ(trees[0].position[0], Vec3(0, 2, 0));
  EXPECT_EQ(trees[0].parent, (std::vector<std::int32_t>{-1, 0, 1}));
}

TEST_F(Skeletons, AreOneNodeWhereParentAndChildStandInOnePlace) {
  const auto trees = read("twice.obj", "v 0 0 0\nv 0 1 0\nv 0 1 0\nv 0 2 0\nl 1 2 2 3 4\n");
  ASSERT_EQ(trees.size(), 1u);
  EXPECT_EQ(trees[0].position, (std::vector<Vec3>{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}));
  EXPECT_EQ(trees[0].parent, (std::vector<std::int32_t>{-1, 0, 1}));
}

TEST_F(Skeletons, OfBadJsonAreRefusedWithThePlace) {
  const auto bad = [&](const std::string& text, const std::string& because) {
    expectRefused("bad.json", text, because);
  };
  bad("{\"nodes\": [", "this is no JSON: ");
  bad("[1e999]", "this is no JSON: ");
  bad("7", "7 is no skeleton");
  bad("{}", "/: it has no 'nodes'");
  bad("[]", "there is no segment in the file");
  bad("[{\"position\": [0, 0, 0]}]", "there is no segment in the file");
  bad("{\"espalier\": \"skeleton/2\", \"nodes\": []}", "/espalier: 'skeleton/2' is not known");
  bad("[[[]]]", "/0: an array is no node");
  bad(std::string(100'000, '[') + std::string(100'000, ']'), "/0: an array is no node");
  bad(R"({"nodes": [{"parent": -1}]})", "/nodes/0: the node has no position");
  bad(R"({"nodes": [3]})", "/nodes/0: 3 is no node");
  bad(R"({"nodes": [{"position": [0, 0]}]})", "/nodes/0/position: an array is no place");
  bad(R"({"nodes": [{"position": [0, "a", 0]}]})", "/nodes/0/position: 'a' is no number");
  bad(R"({"nodes": [{"position": [0, 1e10, 0]}]})",
      "/nodes/0/position: the node stands at [0, 10000000000, 0]");
  const std::string root = R"([{"position": [0, 0, 0]}, )", end = "]";
  bad(root + R"({"parent": 2, "position": [0, 1, 0]})" + end,
      "node 1 has parent 2, and there is no such node; expected 0 to 1");
  bad(root + R"({"parent": -2, "position": [0, 1, 0]})" + end, "/1/parent: the parent is -2");
  bad(root + R"({"parent": 0.5, "position": [0, 1, 0]})" + end, "/1/parent: the parent is 0.5");
  bad(root + R"({"parent": 99999999999999999999, "position": [0, 1, 0]})" + end, "/1/parent");
  bad(root + R"({"parent": 18446744073709551615, "position": [0, 1, 0]})" + end, "there is no such node");
  bad(root + R"({"parent": 2, "position": [0, 1, 0]}, {"parent": 1, "position": [0, 2, 0]})" + end,
      "is its own ancestor");
  bad(root + R"({"parent": 1, "position": [0, 1, 0]})" + end, "node 1 is its own ancestor");
  for (const char* const radius : {"0", "-1", "1e-60", "1e10"})
    bad(root + fmt::format(R"({{"parent": 0, "position": [0, 1, 0], "radius": {}}})", radius) + end,
        "/1/radius: the node has the radius ");
  bad(R"({"nodes": [{"position": [0, 0, 0], "radius": 0}, {"parent": 0, "position": [0, 1, 0], "radius": 1}]})",
      "/nodes/0/radius: the node has the radius 0; expected more than 0");
  bad(root + R"({"parent": 0, "position": [0, 1, 0], "radius": "thick"})" + end,
      "/1/radius: 'thick' is no number");
  bad(root + R"({"parent": 0, "position": [0, 1, 0], "radius": 1}, {"parent": 0, "position": [0, 2, 0]})" +
          end,
      "/2: the node has no radius, unlike those before it");
  bad(root + R"({"parent": 0, "position": [0, 1, 0]}, {"parent": 0, "position": [0, 2, 0], "radius": 1})" +
          end,
      "/2: the node has a radius, unlike those before it");
  const auto plant = [](const std::string& keys) { return "{\"plants\": [{" + keys + "}]}"; };
  bad(R"({"plants": 3})", "/plants: 3 is no list");
  bad(R"({"plants": [3]})", "/plants/0: 3 is no plant");
  bad(plant(""), "/plants/0: it has no 'parent'");
  bad(plant(R"("parent": [-1, 0], "position_m": [[0, 0, 0]])"),
      "/plants/0/position_m: 1 entry for 2 nodes");
  const std::string two = R"("parent": [-1, 0], "position_m": [[0, 0, 0], [0, 1, 0]])";
  bad(plant(two + R"(, "radius_m": [1])"), "/plants/0/radius_m: 1 entry for 2 nodes");
  bad(plant(two + R"(, "radius_m": [1, 0])"), "/plants/0/radius_m/1: the node has the radius 0");
  bad(plant(two + R"(, "radius_m": [1, 1])" + "}, {" + two), "/plants/1: the plant has no radii, unlike");
}

TEST_F(Skeletons, OfBadLinesAreRefusedWithTheLine) {
  const auto bad = [&](const std::string& text, const std::string& because) {
    expectRefused("bad.obj", text, because);
  };
  const std::string three = "v 0 0 0\nv 0 1 0\nv 0 2 0\n";
  bad(three, "there are no lines in the file; expected statements such as l 1 2 3");
  bad(three + "f 1 2 3\n", "there are no lines in the file, only faces");
  bad(three + "l 1 2\nl 2 4\n", "line 5: a line asks for vertex 4, which is out of range: there are 3");
  bad(three + "l 1 -4\n", "line 4: a line asks for vertex -4");
  bad(three + "l 0 1\n", "line 4: a line asks for vertex 0");
  bad(three + "l 1 x\n", "line 4: 'x' is not the number of a vertex");
  bad(three + "l 1\n", "line 4: a line of 1 vertex; expected");
  bad(three + "l 1 1\n", "there are no lines in the file");
  bad(three + "l 1 2 3\nl 3 1\n", "line 5: a line leads from vertex 3 to 1, which hang together already");
  bad(three + "l 1 2\nl 2 1\n", "line 5: a line leads from vertex 2 to 1");
  bad("v 0 0\nl 1 1\n", "line 1: '' is not a finite number");
  bad("v 0 nan 0\n", "line 1: 'nan' is not a finite number");
  bad("v 0 1e20 0\n", "line 1: the vertex stands at ");
  bad("v 0 0 0\nv 0 0 0\nl 1 2\n", "there is no segment in the file");
}

TEST_F(Skeletons, AreRefusedWhereTheyAreNoFile) {
  expectRefused("empty.json", "", "the file is empty");
  const std::string gone = tests::messageOf([&] { readSkeletons(scratch_.path("gone.obj"), read_); });
  EXPECT_NE(gone.find("cannot open the skeleton"), std::string::npos) << gone;
}

TEST_F(Skeletons, MayBeAsDeepAsTheyHaveNodes) {
  constexpr int kDeep = 200'000;
  std::string obj;
  for (int i = 0; i < kDeep; ++i) obj += fmt::format("v 0 {} 0\n", i);
  for (int i = 1; i < kDeep; ++i) obj += fmt::format("l {} {}\n", i, i + 1);
  const auto trees = read("deep.obj", obj);
  ASSERT_EQ(trees.size(), 1u);
  EXPECT_EQ(trees[0].parent.size(), static_cast<std::size_t>(kDeep));
  EXPECT_EQ(trees[0].parent.back(), kDeep - 2);
}

TEST_F(Skeletons, AreTheSameInWhateverOrderTheirNodesStand) {
  tests::Numbers numbers(3);
  constexpr int kNodes = 300;
  std::vector<int> parent{-1}, place{0};
  for (int i = 1; i < kNodes; ++i) {
    parent.push_back(numbers.whole(0, i - 1));
    place.push_back(i);
  }
  const auto text = [&] {  // node i is written at place[i]
    std::vector<std::string> nodes(kNodes);
    for (std::size_t i = 0; i < kNodes; ++i)
      nodes[static_cast<std::size_t>(place[i])] =
          fmt::format(R"({{"parent": {}, "position": [{}, {}, 0]}})",
                      parent[i] < 0 ? -1 : place[static_cast<std::size_t>(parent[i])], i, i * i);
    return fmt::format("[{}]", fmt::join(nodes, ", "));
  };
  const auto edges = [&](const std::vector<FileTree>& trees) {
    std::set<std::pair<double, double>> all;
    for (const FileTree& tree : trees) {
      for (std::size_t n = 1; n < tree.parent.size(); ++n)
        all.insert({tree.position[static_cast<std::size_t>(tree.parent[n])].x, tree.position[n].x});
    }
    return all;
  };
  const auto straight = edges(read("straight.json", text()));
  EXPECT_EQ(straight.size(), static_cast<std::size_t>(kNodes - 1));
  for (int i = kNodes - 1; i > 0; --i)
    std::swap(place[static_cast<std::size_t>(i)], place[static_cast<std::size_t>(numbers.whole(0, i))]);
  EXPECT_EQ(edges(read("mixed.json", text())), straight);
}

TEST_F(Skeletons, ArePlacedAsMeshesAre) {
  auto trees = read("tree.json", kPlain);
  placeSkeletons(trees, {.scale = 2.0, .rotate_deg = {0, 0, 90}, .translate_m = {10, 0, 0}});
  EXPECT_EQ(trees[0].position[1], Vec3(8, 0, 0));
  EXPECT_EQ(trees[0].position[3], Vec3(6, 2, 1));
  EXPECT_EQ(trees[0].radius[1], 0.5f);
}

TEST_F(Skeletons, OfAChildThatWentMadAreNotTrusted) {
  EXPECT_THROW(skeletonsFromChild("", read_), std::runtime_error);
  EXPECT_THROW(skeletonsFromChild(std::string(64, '\xff'), read_), std::runtime_error);
}

}  // namespace
}  // namespace espalier::scenes
