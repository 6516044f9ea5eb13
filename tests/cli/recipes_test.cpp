// The recipes of docs/recipes.md: each is a file in docs/examples that grows as it stands, and that the page
// shows. And the README's first steps, taken one after the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/scratch.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> recipes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(tests::sourceFolder() / "docs/examples")) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Of a scene that grows without a word of warning.
nlohmann::json plantsOf(const fs::path& scene, const tests::Scratch& scratch) {
  const auto grown = tests::espalier("grow '" + scene.string() + "' --strict --no-pictures --quiet -o '" +
                                     scratch.path("out").string() + "'");
  EXPECT_EQ(grown.status, 0) << grown.output;
  return nlohmann::json::parse(tests::fileText(scratch.path("out/report.json")))["growth"]["plants"];
}

class Recipe : public testing::TestWithParam<std::string> {
 protected:
  const fs::path file_ = tests::sourceFolder() / ("docs/examples/" + GetParam() + ".yaml");
};

TEST_P(Recipe, GrowsAsItStands) {
  const tests::Scratch scratch;
  for (const auto& plant : plantsOf(file_, scratch)) {
    EXPECT_GT(plant["segments"].get<int>(), 300) << plant;
    EXPECT_GT(plant["elements"].get<int>(), 300) << plant;
  }
}

TEST_P(Recipe, IsShownOnThePageWithItsPicture) {
  const std::string page = tests::fileText(tests::sourceFolder() / "docs/recipes.md");
  EXPECT_NE(page.find("```yaml\n" + tests::fileText(file_) + "```\n"), std::string::npos);
  const std::string picture = "images/recipe_" + GetParam() + ".png";
  EXPECT_NE(page.find("(" + picture + ")"), std::string::npos);
  EXPECT_TRUE(fs::exists(tests::sourceFolder() / "docs" / picture));
}

INSTANTIATE_TEST_SUITE_P(Docs, Recipe, testing::ValuesIn(recipes()),
                         [](const auto& recipe) { return recipe.param; });

/// The value that the README's steps give a key of docs/first/vine.yaml.
std::string valueInReadme(const std::string& key) {
  const std::string steps = tests::fileText(tests::sourceFolder() / "README.md");
  const std::size_t first = steps.find("1. **Climb.**"), at = steps.find("`" + key, first) + 1;
  EXPECT_NE(at, std::string::npos + 1) << key;
  return steps.substr(at, steps.find('`', at) - at);
}

class FirstSteps : public testing::Test {
 protected:
  void change(const std::string& from, const std::string& to) {
    const std::size_t at = vine_.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    vine_.replace(at, from.size(), to);
  }
  double segments() {
    scratch_.write("vine.yaml", vine_);
    std::string scene = tests::fileText(tests::sourceFolder() / "docs/first/scene.yaml");
    scene.replace(scene.find("../../scenes"), 12, (tests::sourceFolder() / "scenes").string());
    scene.replace(scene.find("iterations: 45"), 14, "iterations: 32");  // enough to see it
    double sum = 0.0;
    for (const auto& plant : plantsOf(scratch_.write("scene.yaml", scene), scratch_))
      sum += plant["segments"].get<double>();
    return sum;
  }
  std::string vine_ = tests::fileText(tests::sourceFolder() / "docs/first/vine.yaml");
  const tests::Scratch scratch_;
};

TEST_F(FirstSteps, AddUpAndDoWhatTheReadmeSays) {
  change("bias: {up: 0.08}", valueInReadme("bias: {up"));
  const double climbing = segments();
  change("proximity: {max: 3}", valueInReadme("proximity: {max"));
  const double hedge = segments();
  EXPECT_GT(hedge, 2.0 * climbing);
  change("size: 1.2", valueInReadme("size: "));
  change("colour: \"#4f7a2c\"", valueInReadme("colour: "));
  const double autumn = segments();
  EXPECT_LT(autumn, 0.6 * hedge);
  // It is the shade: who asks for no light grows nearly as much.
  change("exposure: {min: 0.3}", "exposure: {min: 0}");
  const double unshaded = segments();
  change(valueInReadme("size: "), "size: 1.2");
  EXPECT_GT(unshaded, 0.9 * segments());
}

}  // namespace
}  // namespace espalier
