// Scene files: the reader, the checks between keys, and what is made of them before any mesh is read.
#include "scenes/lights.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/settings.h"
#include "scenes/show/picture_memory.h"
#include "scenes/show/pictures.h"
#include "sim/base/error.h"
#include "tests/fuzz/input_files.h"
#include "tests/fuzz/target.h"

namespace espalier::fuzz {
namespace {

void prepare(const scenes::Scene& scene) {
  require(!scenes::format(scenes::settings(scene)).empty(), "a scene of which there is nothing to say");
  try {
    scenes::makeSun(scene.sun);
    scenes::shadowDirection(scene.sun);
    require(scenes::pictureBytes(scenes::picturesOf(scene), 1.0) >= 0.0, "pictures of less than nothing");
  } catch (const sim::InputError&) {
  }
}

}  // namespace

std::vector<std::string> seeds() {
  auto texts = sourceFiles("scenes/library", ".yaml");
  for (const char* folder : {"docs/first", "tests/scenes/read/version_1"}) {
    const auto more = sourceFiles(folder, ".yaml");
    texts.insert(texts.end(), more.begin(), more.end());
  }
  texts.emplace_back(
      "espalier: scene\nmeshes: [mesh.obj]\nworld: {resolution: 9}\nplants: [{rules: rules.yaml, seeds: [[0, "
      "0, 0]], "
      "scatter: {region: a, count: 2}}]\nsun: {place: {latitude: 4, longitude: 8, utc_offset: 1}, date: "
      "06-21}\n"
      "cameras: {m: {eye: [1, 1, 1], target: [0, 0, 0]}}\nimages: [vines, {kind: section, axis: x, at: 1 "
      "cm}]\n");
  return texts;
}

}  // namespace espalier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace espalier;
  static const fuzz::InputFiles files;
  static const auto mesh = files.write("mesh.obj", "v 0 0 0\n");
  static const auto rules = files.write("rules.yaml", "espalier: rules\n");
  const auto path = files.write("scene.yaml", fuzz::textOf(data, size));
  const auto scene = scenes::readScene(path);
  if (scene) {
    fuzz::prepare(*scene);
    fuzz::require(scenes::readRulesOrScene(path).problems().empty(),
                  "a scene that reads and does not pass its check");
  } else {
    fuzz::require(!scene.problems().empty(), "a refusal without a word");
    scenes::format(scene.problems());
  }
  return 0;
}
