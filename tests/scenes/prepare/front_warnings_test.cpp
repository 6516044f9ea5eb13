#include "scenes/prepare/front_warnings.h"

#include <gtest/gtest.h>

#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

/// The warnings of a crown 4 m wide in which attractors are about 25 cm from each other.
std::string warned(const std::string& lengths, const std::string& more = "") {
  const tests::Scratch scratch;
  const auto read = readScene(scratch.write(
      "scene.yaml",
      "espalier: scene\nworld: {voxel: 10 cm, bounds: {min: [-4, 0, -4], max: [4, 8, 4]}}\nplants:\n  - "
      "{seeds: "
      "[[0, 1, 0]], rules: {propagate: colonization, colonization: {crown: {sphere: 2 m, trunk: 1 m, count: "
      "500}, " +
          lengths + "}" + more + "}}\n"));
  EXPECT_TRUE(read) << format(read.problems());
  const Site site = makeSite(*read);
  std::string text;
  for (const Problem& warning :
       frontWarnings(*read, site.world.frame(), crownsOf(*read, site, makePlantings(*read, site)))) {
    EXPECT_EQ(warning.line, 4);
    text += warning.text + "\n";
  }
  return text;
}

TEST(FrontWarnings, SayNothingOfLengthsThatWork) {
  EXPECT_EQ(warned(""), "");
  EXPECT_EQ(warned("step: 20 cm, kill: 40 cm, influence: 2 m"), "");
  EXPECT_EQ(warned("step: 2, kill: 1, influence: 60"), "");
  EXPECT_EQ(warned("step: 40 cm, kill: 5 cm, influence: 2 m, onto: true"), "");
}

TEST(FrontWarnings, SayWhatCannotWorkAndWhatWould) {
  EXPECT_EQ(
      warned("step: 40 cm, kill: 5 cm, influence: 2 m"),
      "colonization: kill is 0.05 m, less than half of the step of 0.4 m: most attractors are passed by; "
      "expected kill of 0.2 m or more, or a step of 0.1 m or less\n");
  const std::string blind = warned("influence: 20 cm, kill: 10 cm");
  EXPECT_TRUE(blind.starts_with("colonization: influence is 0.2 m, and the attractors are 0.2")) << blind;
  EXPECT_NE(blind.find("expected about 2."), std::string::npos) << blind;
  EXPECT_NE(warned("step: 3 m, influence: 2 m, kill: 1.6 m").find("longer than the influence radius of 2 m"),
            std::string::npos);
  const std::string wide = warned("kill: 3 m, influence: 9 m");
  EXPECT_TRUE(wide.starts_with("colonization: kill is 3 m, and all attractors lie within 3.")) << wide;
  EXPECT_NE(wide.find("the first node ends most of them; expected about 0.399 m"), std::string::npos) << wide;
}

TEST(FrontWarnings, KnowOrdersApart) {
  EXPECT_EQ(warned("step: 20 cm, kill: 40 cm, influence: 2 m", ", branches: {colonization: {kill: 2 cm}}"),
            "branches.colonization: kill is 0.02 m, less than half of the step of 0.2 m: most attractors are "
            "passed by; expected kill of 0.1 m or more, or a step of 0.04 m or less\n");
}

}  // namespace
}  // namespace espalier::scenes
