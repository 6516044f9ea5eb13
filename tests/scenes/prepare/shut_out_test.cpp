#include "scenes/prepare/shut_out.h"

#include <gtest/gtest.h>

#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

/// The warnings of a plant that grows to attractors in a ball of radius 0.5 m about [0, 0, 0].
std::string shutOutOf(const std::string& of_mesh, const std::string& seeds) {
  const tests::Scratch scratch;
  const auto read = readScene(scratch.write(
      "scene.yaml",
      "espalier: scene\nmeshes:\n  - {file: " +
          (tests::sourceFolder() / "scenes/meshes/sphere.obj").string() + ", name: ball, " + of_mesh +
          "}\nworld: {voxel: 5 cm, bounds: {min: [-1, -1, -1], max: [1, 1, 1]}}\nattractors: {within: "
          "{inside: ball, count: 100}}\n"
          "plants:\n  - {name: tree, rules: {propagate: colonization, colonization: {attractors: "
          "within}}, seeds: " +
          seeds + "}\n"));
  EXPECT_TRUE(read) << format(read.problems());
  const Site site = makeSite(*read);
  std::string text;
  for (const Problem& warning : shutOutWarnings(*read, site, makePlantings(*read, site))) {
    EXPECT_EQ(warning.line, 7);
    text += warning.text + "\n";
  }
  return text;
}

TEST(ShutOut, IsSaidOfStartsOutside) {
  EXPECT_EQ(
      shutOutOf("solid: false", "[[0, 0.7, 0]]"),
      "'tree' starts outside of 'ball', which stands between it and the attractors in its inside; expected a "
      "seed in there, or tiled: false of the mesh\n");
}

TEST(ShutOut, IsNotSaidOfOthers) {
  EXPECT_EQ(shutOutOf("solid: false", "[[0, 0.2, 0]]"), "");
  EXPECT_EQ(shutOutOf("solid: false", "[[0, 0.7, 0], [0.1, 0, 0]]"), "");
  EXPECT_EQ(shutOutOf("tiled: false", "[[0, 0.7, 0]]"), "");
}

}  // namespace
}  // namespace espalier::scenes
