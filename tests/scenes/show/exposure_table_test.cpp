#include "scenes/show/exposure_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "sim/tile/build_world.h"
#include "tests/support/meshes.h"

namespace espalier::scenes {
namespace {

using nlohmann::json;

/// Rows of RFC 4180, or an empty list for a text that does not follow it.
std::vector<std::vector<std::string>> readCsv(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row;
  std::string field;
  for (std::size_t i = 0; i < text.size();) {
    field.clear();
    if (text[i] == '"') {
      for (++i;; ++i) {
        if (i >= text.size()) return {};
        if (text[i] != '"') {
          field += text[i];
        } else if (i + 1 < text.size() && text[i + 1] == '"') {
          field += text[++i];
        } else {
          break;
        }
      }
      ++i;
    } else {
      while (i < text.size() && text[i] != ',' && text[i] != '\r') field += text[i++];
    }
    row.push_back(field);
    if (i < text.size() && text[i] == ',') {
      ++i;
    } else if (text.compare(i, 2, "\r\n") == 0) {
      i += 2;
      rows.push_back(std::move(row));
      row.clear();
    } else {
      return {};
    }
  }
  return rows;
}

/// A world of two parts whose values are made up, so that every number can be told.
struct Made {
  sim::World world{{sim::Vec3(0.0), 0.5, {8, 4, 4}}};
  sim::Lighting light;

  ExposureTable table() const { return exposureTable("two \"walls\", a test", world, light); }

  Made() {
    const sim::PartId wall = world.addPart({"house, old", "wall", sim::PartKind::scene, -1});
    const sim::PartId roof = world.addPart({"house, old", "roof", sim::PartKind::scene, -1});
    world.addPart({"house, old", "hidden", sim::PartKind::scene, -1});  // has no surface
    // Of the wall 0, 1, 2, 3, 4 tenths; the last one covers its voxel thrice as much as the others.
    for (int i = 0; i < 5; ++i) add(wall, 0.1f * static_cast<float>(i), i == 4 ? 0.75f : 0.25f);
    add(roof, 1.0f, 1.0f);
    light.about.sky = "made up, as it is";
    light.about.weighting = "uniform";
    light.about.directions = 7;
    light.about.sun = "a lamp";
    light.about.sun_hours = 10.0;
    light.about.voxel_m = 0.5;
  }

 private:
  void add(sim::PartId part, float value, float coverage) {
    const sim::Voxel v(static_cast<int>(light.surfaces.size()), 0, 0);
    const sim::Vec3f normal = part == 2 ? sim::Vec3f(0, 1, 0)
                              : v.x < 4 ? sim::Vec3f(0, 0, 1)
                                        : sim::Vec3f(1, 0, 0);
    light.surfaces.push_back({v, {part, sim::Colour(0.5f), coverage, normal}});
    light.sky.values.push_back(value);
    light.sun.values.push_back(1.0f - value);
    light.sun_hours.values.push_back(10.0f * (1.0f - value));
  }
};

TEST(ExposureTable, IsWeightedByArea) {
  const Made made;
  const ExposureTable table = made.table();
  ASSERT_EQ(table.rows.size(), 3u + 2u + 1u + 3u);  // the wall faces two ways, the roof one
  const ExposureRow& wall = table.rows[0];
  EXPECT_EQ(wall.region, "wall");
  EXPECT_EQ(wall.voxels, 5u);
  EXPECT_EQ(wall.area_m2, 1.75 * 0.25);
  const Spread& sky = wall.spreads[0];
  EXPECT_EQ(sky.mean, 0.2571);  // (0.25 (0 + .1 + .2 + .3) + 0.75 * 0.4) / 1.75
  EXPECT_EQ(sky.deviation, 0.1498);
  EXPECT_EQ(sky.least, 0.0);
  EXPECT_EQ(sky.lower_quartile, 0.1);  // by area: 0.4375 of 1.75
  EXPECT_EQ(sky.median, 0.3);
  EXPECT_EQ(sky.upper_quartile, 0.4);
  EXPECT_EQ(sky.greatest, 0.4);
  EXPECT_EQ(sky.histogram[0], 0.1429);
  EXPECT_EQ(sky.histogram[8], 0.4286);
  EXPECT_EQ(table.rows[3].spreads[0].histogram[Spread::kBins - 1], 1.0);  // 1 belongs to the last bin
  EXPECT_EQ(wall.spreads[2].histogram[12], 0.4286);                       // 6 of 10 hours
  EXPECT_EQ(table.rows[5].object, "");
  EXPECT_EQ(table.rows[5].voxels, 6u);
  EXPECT_EQ(table.rows[5].area_m2, 2.75 * 0.25);
}

TEST(ExposureTable, SplitsWhatFacesSeveralWays) {
  const Made made;
  const ExposureTable table = made.table();
  const auto is = [&](std::size_t row, const char* region, const char* faces, std::size_t voxels) {
    EXPECT_EQ(table.rows[row].region, region);
    EXPECT_EQ(table.rows[row].faces, faces);
    EXPECT_EQ(table.rows[row].voxels, voxels);
  };
  is(0, "wall", "", 5);
  is(1, "wall", "E", 1);
  is(2, "wall", "S", 4);
  is(3, "roof", "", 1);
  is(4, "roof", "up", 1);
  is(5, "", "", 6);
  is(6, "", "E", 1);
  is(7, "", "S", 4);
  is(8, "", "up", 1);
  EXPECT_EQ(table.rows[1].spreads[0].mean, 0.4);
  EXPECT_EQ(table.rows[2].spreads[0].mean, 0.15);
}

TEST(ExposureTable, NamesWaysByTheCompass) {
  for (int step = 0; step < 32; ++step) {
    const double compass_deg = 11.25 * step, radians = compass_deg * std::numbers::pi / 180.0;
    const sim::Vec3f normal(static_cast<float>(std::sin(radians)), 0.0f,
                            static_cast<float>(-std::cos(radians)));
    if (step % 4 == 2) continue;  // between two ways
    const char* const names[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
    EXPECT_EQ(wayOf(normal, 0.0), names[(step + 2) / 4 % 8]) << compass_deg;
    EXPECT_EQ(wayOf(normal, 90.0), names[(step + 2 + 24) / 4 % 8]) << compass_deg;  // true north lies east
  }
  const auto leaning = [](double from_level_deg) {
    const double radians = from_level_deg * std::numbers::pi / 180.0;
    return sim::Vec3f(0.0f, static_cast<float>(std::cos(radians)), static_cast<float>(std::sin(radians)));
  };
  EXPECT_EQ(wayOf(leaning(29.0), 0.0), "up");
  EXPECT_EQ(wayOf(leaning(31.0), 0.0), "S");
  EXPECT_EQ(wayOf(leaning(149.0), 0.0), "S");
  EXPECT_EQ(wayOf(leaning(151.0), 0.0), "down");
}

/// Ground with a room on it that has no door, a block that lies on the ground, and a roof on nothing.
class Rooms : public testing::Test {
 protected:
  Rooms() {
    std::vector<sim::TiledMesh> meshes;
    const auto add = [&](sim::Vec3 low, sim::Vec3 high, const char* name) {
      meshes.push_back({tests::boxMesh(low, high, name), true});
    };
    add({0, 0, 0}, {12, 0.5, 12}, "ground");
    add({2, 0.5, 2}, {6, 3, 2.5}, "room");
    add({2, 0.5, 5.5}, {6, 3, 6}, "room");
    add({2, 0.5, 2.5}, {2.5, 3, 5.5}, "room");
    add({5.5, 0.5, 2.5}, {6, 3, 5.5}, "room");
    add({2, 3, 2}, {6, 3.5, 6}, "room");
    add({8, 0.5, 2}, {10, 2, 4}, "block");
    add({7, 3, 7}, {11, 3.25, 11}, "roof");
    const sim::Frame frame{sim::Vec3(-0.445), 0.11, {118, 46, 118}};
    world_.emplace(sim::buildWorld(frame, meshes, 0));
    sim::LightWanted wanted;
    wanted.brightest = true;
    light_ = sim::lightOf(*world_, sim::makeSky({.directions = 200}), {}, wanted);
  }
  ExposureTable table(Unreached unreached) const {
    return exposureTable("rooms", *world_, light_, 0.0, unreached);
  }
  /// 0 where there is no such row.
  static double area(const ExposureTable& table, const std::string& object, const std::string& faces) {
    double area = 0.0;
    for (const ExposureRow& row : table.rows) {
      if (row.object == object && row.faces == faces) area += row.area_m2;
    }
    return area;
  }

  std::optional<sim::World> world_;
  sim::Lighting light_;
};

TEST_F(Rooms, WhatNoSkyReachesIsLeftOutAndItsAreaTold) {
  const ExposureTable all = table(Unreached::count), reached = table(Unreached::leave_out);
  EXPECT_EQ(all.left_out, 0u);
  EXPECT_EQ(all.left_out_m2, 0.0);
  constexpr double kRim_m2 = 2.0;                     // of the floor's voxels, below the walls
  const double inside = 3 * 3 + 3 * 3 + 4 * 3 * 2.5;  // floor, ceiling, walls
  EXPECT_NEAR(reached.left_out_m2, inside, 0.1 * inside);
  EXPECT_NEAR(area(all, "", "") - area(reached, "", ""), reached.left_out_m2, 0.01);
  EXPECT_NEAR(area(all, "ground", "up") - area(reached, "ground", "up"), 9.0, kRim_m2);
  EXPECT_NEAR(area(all, "room", "down"), 9.0, 0.9);
  EXPECT_EQ(area(reached, "room", "down"), 0.0);
  EXPECT_NEAR(area(reached, "room", "N"), 4 * 2.5 + 4 * 0.5, 1.2);  // its outside alone
  EXPECT_EQ(area(reached, "block", "down"), 0.0);
  EXPECT_EQ(area(all, "block", ""), area(reached, "block", ""));
  // Below a roof that one can see out from, surfaces receive nothing, and are there all the same.
  EXPECT_NEAR(area(reached, "roof", "down"), 16.0, 0.5);
  for (const ExposureRow& row : reached.rows) {
    if (row.object == "roof" && row.faces == "down") {
      EXPECT_EQ(row.spreads[0].upper_quartile, 0.0);
    }
    if (row.object == "ground" && row.faces.empty()) {
      EXPECT_NEAR(row.left_out_m2, 9.0, kRim_m2);
    }
    if (row.object == "block") {
      EXPECT_EQ(row.left_out_m2, 0.0);
    }
  }
}

TEST_F(Rooms, TablesSayWhatWasLeftOut) {
  const ExposureTable all = table(Unreached::count), reached = table(Unreached::leave_out);
  EXPECT_EQ(toText(all).find("left out"), std::string::npos);
  EXPECT_NE(
      toText(reached).find(fmt::format("left out: {:.2f} m2 from which no sky and no sun is seen ({} voxels)",
                                       reached.left_out_m2, reached.left_out)),
      std::string::npos)
      << toText(reached);
  EXPECT_FALSE(json::parse(toJson(all)).contains("left_out"));
  const json told = json::parse(toJson(reached));
  EXPECT_EQ(told["left_out"]["voxels"], reached.left_out);
  EXPECT_EQ(told["left_out"]["area_m2"], reached.left_out_m2);
  EXPECT_EQ(told["total"]["left_out_m2"], reached.left_out_m2);
  const auto rows = readCsv(toCsv(reached));
  const auto column = std::find(rows[0].begin(), rows[0].end(), "left_out_m2") - rows[0].begin();
  ASSERT_LT(static_cast<std::size_t>(column), rows[0].size());
  EXPECT_EQ(std::stod(rows[1].at(static_cast<std::size_t>(column))), reached.rows[0].left_out_m2);
}

/// All that is there may lie in the dark.
TEST_F(Rooms, ATableMayBeLeftWithoutRows) {
  light_.brightest.assign(light_.surfaces.size(), sim::Vec3f(0.0f));
  light_.sky.values.assign(light_.sky.values.size(), 0.0f);
  const ExposureTable none = table(Unreached::leave_out);
  EXPECT_TRUE(none.rows.empty());
  EXPECT_EQ(none.left_out, light_.surfaces.size());
  EXPECT_NE(toText(none).find("left out: "), std::string::npos);
  EXPECT_EQ(readCsv(toCsv(none)).size(), 1u);
  EXPECT_TRUE(json::accept(toJson(none)));
}

TEST(ExposureTable, CsvFollowsItsRfcAndSaysWhatJsonSays) {
  const Made made;
  const ExposureTable table = made.table();
  const auto rows = readCsv(toCsv(table));
  ASSERT_EQ(rows.size(), 1u + 9u * 3u);
  const json all = json::parse(toJson(table));
  EXPECT_EQ(all["light"]["weighting"], "uniform");
  EXPECT_EQ(all["light"]["directions"], 7);
  for (std::size_t r = 1; r < rows.size(); ++r) {
    ASSERT_EQ(rows[r].size(), rows[0].size());
    std::map<std::string, std::string> row;
    for (std::size_t c = 0; c < rows[0].size(); ++c) row[rows[0][c]] = rows[r][c];
    EXPECT_EQ(row["scene"], "two \"walls\", a test");
    EXPECT_EQ(row["sky"], "made up, as it is");
    EXPECT_EQ(row["weighting"], "uniform");
    json region;
    if (row["object"] == "total") {
      region = all["total"];
    } else {
      EXPECT_EQ(row["object"], "house, old");
      const auto& regions = all["regions"];
      region = *std::find_if(regions.begin(), regions.end(),
                             [&](const json& j) { return j["region"] == row["region"]; });
    }
    if (row["faces"] != "all") {
      const json& ways = region["facing"];
      region = json(
          *std::find_if(ways.begin(), ways.end(), [&](const json& j) { return j["faces"] == row["faces"]; }));
    }
    EXPECT_EQ(std::stod(row["area_m2"]), region["area_m2"]);
    EXPECT_EQ(std::stoul(row["voxels"]), region["voxels"]);
    const json& spread = region[row["quantity"]];
    for (const char* name :
         {"mean", "standard_deviation", "minimum", "lower_quartile", "median", "upper_quartile", "maximum"}) {
      EXPECT_EQ(std::stod(row[name]), spread[name]) << name;
    }
    double shares = 0.0;
    for (std::size_t bin = 0; bin < Spread::kBins; ++bin) {
      const double share = std::stod(row["share_" + std::to_string(bin + 1)]);
      EXPECT_EQ(share, spread["histogram"][bin]);
      shares += share;
    }
    EXPECT_NEAR(shares, 1.0, 1e-3);
    EXPECT_EQ(std::stod(row["histogram_to"]), all["quantities"][row["quantity"]]["histogram_to"]);
    EXPECT_EQ(row["unit"], all["quantities"][row["quantity"]]["unit"]);
  }
}

TEST(ExposureTable, WithoutASunHasNoColumnsOfOne) {
  Made made;
  made.light.about.sun.clear();
  const ExposureTable table = made.table();
  EXPECT_EQ(table.quantities.size(), 1u);
  EXPECT_EQ(toCsv(table).find("sun"), std::string::npos);
  EXPECT_EQ(readCsv(toCsv(table)).size(), 1u + 9u);
}

TEST(ExposureTable, TheTextNamesEveryRegionWithItsMean) {
  const Made made;
  const std::string text = toText(made.table());
  for (const char* part : {"wall", "roof", "all surfaces", "0.26 (0.10 .. 0.40)", "area m2"})
    EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
}

}  // namespace
}  // namespace espalier::scenes
