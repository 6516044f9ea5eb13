#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "render/image/image_io.h"
#include "rules/language/registry.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/read_table.h"
#include "scenes/read/registry.h"
#include "tests/support/scratch.h"

/// docs/seeds.md says of every capability which key does it, which scene shows it and which tests prove it.
namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

struct Row {
  std::string what, kind, key, scene, suite;
};

std::vector<Row> rowsOfThePage() {
  std::vector<Row> rows;
  std::istringstream page(tests::fileText(tests::sourceFolder() / "docs/seeds.md"));
  const std::regex row(
      R"(\| (.+) \| (\w+): `([^`]+)` \| \[`(\w+)`\]\(\.\./scenes/library/\w+\.yaml\) \| `(\w+)` \|)");
  std::smatch match;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| ") || line.starts_with("| --- ") || line.starts_with("| what ")) continue;
    EXPECT_TRUE(std::regex_match(line, match, row)) << line;
    if (!match.empty()) rows.push_back({match[1], match[2], match[3], match[4], match[5]});
  }
  return rows;
}

std::set<std::string> keysOf(const rules::Table& table) {
  std::set<std::string> keys;
  forEachKey(table, [&](const std::string& path, const rules::Key&) { keys.insert(path); });
  return keys;
}

std::set<std::string> suitesOfTests() {
  std::set<std::string> suites;
  const std::regex test(R"((?:^|\n)TEST(?:_F|_P)?\((\w+),)");
  for (const auto& entry : fs::recursive_directory_iterator(tests::sourceFolder() / "tests")) {
    if (!entry.path().string().ends_with("_test.cpp")) continue;
    const std::string text = tests::fileText(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), test), end; at != end; ++at)
      suites.insert((*at)[1]);
  }
  return suites;
}

TEST(Seeds, EveryCapabilityHasItsKeyItsSceneAndItsTests) {
  const auto rows = rowsOfThePage();
  EXPECT_GT(rows.size(), 60u);
  const std::set<std::string> of_rules = keysOf(rules::ruleTable()), of_scenes = keysOf(sceneTable());
  const std::set<std::string> suites = suitesOfTests();
  const std::vector<std::string>& images =
      rules::find(*rules::find(sceneTable(), "images")->child, "kind")->choices;
  std::set<std::string> said;
  for (const Row& row : rows) {
    EXPECT_TRUE(said.insert(row.what).second) << "twice: " << row.what;
    EXPECT_TRUE(suites.contains(row.suite)) << row.suite << " of: " << row.what;
    EXPECT_TRUE(fs::exists(tests::sourceFolder() / "scenes/library" / (row.scene + ".yaml"))) << row.scene;
    if (row.kind == "rule") {
      EXPECT_TRUE(of_rules.contains(row.key)) << row.key;
    } else if (row.kind == "scene") {
      EXPECT_TRUE(of_scenes.contains(row.key)) << row.key;
    } else if (row.kind == "image") {
      EXPECT_NE(std::find(images.begin(), images.end(), row.key), images.end()) << row.key;
    }
    EXPECT_TRUE((
        std::set<std::string>{"rule", "scene", "image", "command", "flag", "file", "key"}.contains(row.kind)))
        << row.kind;
  }
}

/// A scene as small as it is still what it is.
Scene smaller(Scene scene) {
  scene.image_width = 96;
  scene.image_height = 72;
  scene.iterations = std::min(scene.iterations, 6);
  scene.film.reset();
  scene.interreflection.reset();
  if (scene.name == "courtyard" || scene.name == "gable" || scene.name == "whorls")
    *scene.world.voxel_m *= 2.0;
  for (HeightsSpec& heights : scene.heights) heights.spacing_m *= 6.0;
  for (PiecesSpec& pieces : scene.pieces) {
    pieces.kerf_m *= 2.0;
    pieces.voxel_m = pieces.kerf_m / 3.0;
  }
  // A picture and what is on its sheets, and no more.
  const auto sheet = [](const ImageSpec& image) { return image.kind == ImageKind::contact_sheet; };
  std::erase_if(scene.images, sheet);
  if (scene.images.size() > 2) scene.images.resize(2);
  if (scene.images.empty()) {  // of a scene that is a film
    scene.images.emplace_back();
    scene.images[0].name = "vines";
  }
  return scene;
}

/// How far the pixels of a picture differ, in the channel in which they do so most: 0..1, by the mean of
/// squares.
double contrastOf(const render::Image& picture) {
  double most = 0.0;
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (std::size_t channel = 0; channel < channels; ++channel) {
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = channel; i < picture.pixels.size(); i += channels) {
      sum += picture.pixels[i];
      squares += picture.pixels[i] * picture.pixels[i];
    }
    const double count = static_cast<double>(picture.pixels.size() / channels);
    most = std::max(most, squares / count - sum / count * (sum / count));
  }
  return std::sqrt(most);
}

std::vector<std::string> scenesOfThePage() {
  std::set<std::string> names;
  for (const Row& row : rowsOfThePage()) names.insert(row.scene);
  return {names.begin(), names.end()};
}

class SeedScenes : public testing::TestWithParam<std::string> {};

TEST_P(SeedScenes, DrawAPictureThatIsNotFlatAlreadyWhenSmall) {
  auto scene = readScene(tests::sourceFolder() / "scenes/library" / (GetParam() + ".yaml"));
  ASSERT_TRUE(scene) << format(scene.problems());
  const tests::Scratch scratch;
  RunOptions options;
  options.folder = scratch.path("out");
  const Report report = runScene(smaller(*scene), options, {.keep = false});
  int pictures = 0;
  for (const std::string& file : report.files) {
    if (!file.ends_with(".png")) continue;
    ++pictures;
    EXPECT_GT(contrastOf(render::decodePng(tests::fileText(scratch.path("out/" + file)))), 0.02) << file;
  }
  EXPECT_GT(pictures, 0);
}

INSTANTIATE_TEST_SUITE_P(Scene, SeedScenes, testing::ValuesIn(scenesOfThePage()),
                         [](const auto& at) { return at.param; });

}  // namespace
}  // namespace espalier::scenes
