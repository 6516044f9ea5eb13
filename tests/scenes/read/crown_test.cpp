#include <gtest/gtest.h>

#include "rules/language/envelope_keys.h"
#include "scenes/read/read_table.h"
#include "scenes/yaml/yaml_tree.h"

namespace espalier::scenes {
namespace {

/// A crown as rules state it, and what is wrong with it.
std::pair<rules::CrownSpec, std::string> crown(const std::string& text) {
  Problems problems;
  Reading reading{problems};
  rules::CrownSpec spec;
  const auto root = parseYaml(text, "f", problems);
  if (root) readTable(*root, *rules::crownKeys(), &spec, "", reading);
  std::string said = format(problems.sorted());
  if (said.empty()) {
    rules::checkCrown(spec, "crown", {[&](const std::string& path, const std::string& what, const auto&) {
                        said += path + ": " + what;
                      }});
  }
  return {spec, said};
}

TEST(Crown, IsASolidOverASeed) {
  const auto [spec, said] = crown("{dome: {radius: 6 m}, trunk: 200 cm, count: 800, spread: height}");
  EXPECT_EQ(said, "");
  EXPECT_EQ(spec.trunk_m, 2.0);
  const sim::Envelope dome = rules::envelopeOf(spec.shape, {1, 2, 3});
  EXPECT_EQ(dome.foot, sim::Vec3(1, 2, 3));
  EXPECT_EQ(std::get<sim::Dome>(dome.solid).radius, 6.0);
  const sim::Strewing strewing = rules::strewingOf(spec.strewing);
  EXPECT_EQ(strewing.count, 800u);
  EXPECT_EQ(strewing.spread, sim::Spread::height);
}

TEST(Crown, HasTheProfileOfACypress) {
  const auto [spec, said] =
      crown("{revolution: [[0, 1], [2 m, 4.5], [7, 50 cm], [12, 1]], density: [[0, 1], [1, 3]]}");
  EXPECT_EQ(said, "");
  const auto profile = std::get<sim::Revolution>(rules::envelopeOf(spec.shape, {}).solid).profile;
  EXPECT_EQ(profile[1], glm::dvec2(2, 4.5));
  EXPECT_EQ(profile[2], glm::dvec2(7, 0.5));
  const sim::Strewing strewing = rules::strewingOf(spec.strewing);
  EXPECT_EQ(strewing.count, 500u);
  ASSERT_EQ(strewing.density.size(), 2u);
  EXPECT_EQ(strewing.density[1].density, 3.0);
}

TEST(Crown, IsOneSolid) {
  EXPECT_EQ(crown("{count: 5}").second,
            "crown: a crown without a shape; expected one, such as dome: {radius: 6 m}");
  EXPECT_EQ(crown("{dome: 5, sphere: 3}").second,
            "crown.sphere: a crown of dome and sphere; expected one shape");
  EXPECT_EQ(
      crown("{revolution: [[0, 1]]}").second,
      "crown.revolution.profile: a profile of 1 point; expected four, the control points of a Bezier curve");
  EXPECT_EQ(crown("{dome: 5, density: [[0, 0]]}").second,
            "crown.density: a density of 0 along the whole height; expected one above 0 somewhere");
  EXPECT_NE(crown("{dome: -5}").second, "");
}

}  // namespace
}  // namespace espalier::scenes
