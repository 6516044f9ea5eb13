#include "render/files/skeleton_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "render/model/radii.h"
#include "tests/support/small_vine.h"

namespace espalier {
namespace {

using nlohmann::json;

std::string written(const std::vector<sim::Plant>& plants, const sim::Frame& frame,
                    const sim::Provenance& made_by = {}) {
  std::ostringstream file;
  render::writeSkeletons(file, plants, frame, made_by);
  return std::move(file).str();
}

TEST(SkeletonFile, HoldsEveryNumberAsItIs) {
  sim::Plant vine = tests::smallVine();
  vine.name = "a \"vine\"\xff";
  vine.skeleton.columns["order"].assign(vine.skeleton.parent.size(), 1.0f);
  vine.skeleton.columns["share"].assign(vine.skeleton.parent.size(), 0.1f);
  const sim::Frame frame{{0.3, -7.0, 1e-3}, 0.07, {64, 64, 64}};
  const std::string text = written({vine, vine}, frame, {"Espalier 9", 12, {{"a.yaml", "scene", 255}}});
  const json file = json::parse(text);
  EXPECT_EQ(file["espalier"], "skeleton/1");
  EXPECT_EQ(file["software"], "Espalier 9");
  EXPECT_EQ(file["seed"], 12);
  EXPECT_EQ(file["inputs"][0], json({{"file", "a.yaml"}, {"kind", "scene"}, {"xxh3", "00000000000000ff"}}));
  EXPECT_EQ(file["unit"], "m");
  EXPECT_EQ(file["up"], "y");
  ASSERT_EQ(file["plants"].size(), 2u);
  EXPECT_EQ(file["plants"][0], file["plants"][1]);
  const json& plant = file["plants"][0];
  EXPECT_EQ(plant["name"].get<std::string>().substr(0, 8), "a \"vine\"");
  const sim::Skeleton& s = vine.skeleton;
  EXPECT_EQ(plant["parent"].get<std::vector<int>>(), s.parent);
  EXPECT_EQ(plant["born"].get<std::vector<int>>(), s.born);
  const auto radii = render::stemRadii(s, vine.girth);
  for (std::size_t n = 0; n < s.parent.size(); ++n) {
    const sim::Vec3 at_m = sim::worldFromVoxel(frame, s.position_vx[n]);
    EXPECT_EQ(plant["position_m"][n], json({at_m.x, at_m.y, at_m.z}));
    EXPECT_EQ(plant["radius_m"][n].get<float>(), static_cast<float>(static_cast<double>(radii[n]) * 0.07));
  }
  EXPECT_EQ(plant["columns"].size(), s.columns.size());
  for (const auto& [name, values] : s.columns)
    EXPECT_EQ(plant["columns"][name].get<std::vector<float>>(), values);
  EXPECT_NE(text.find("\"share\":[0.1,0.1,"), std::string::npos);  // no digits that say nothing
}

TEST(SkeletonFile, IsWrittenInPartsAsInOne) {
  sim::Plant line;
  for (int n = 0; n < 9'000; ++n) {
    line.skeleton.parent.push_back(n - 1);
    line.skeleton.position_vx.emplace_back(n * 0.5, 1.0, 2.0);
    line.skeleton.born.push_back(n / 7);
  }
  const json plant = json::parse(written({line}, {sim::Vec3(0.0), 1.0, {8, 8, 8}}))["plants"][0];
  EXPECT_EQ(plant["parent"].get<std::vector<int>>(), line.skeleton.parent);
  EXPECT_EQ(plant["born"].get<std::vector<int>>(), line.skeleton.born);
  EXPECT_EQ(plant["position_m"][8999][0], 4499.5);
}

TEST(SkeletonFile, OfNoPlantsIsAFileToo) {
  EXPECT_EQ(json::parse(written({}, {}))["plants"], json::array());
}

}  // namespace
}  // namespace espalier
