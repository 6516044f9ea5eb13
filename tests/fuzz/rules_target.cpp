// Rule files: the reader, the checks between keys, and what makes of them a process at some voxel size.
#include "rules/growth/make_process.h"
#include "rules/growth/voxel_widths.h"
#include "scenes/read/read_rules.h"
#include "scenes/read/settings.h"
#include "sim/base/error.h"
#include "tests/fuzz/input_files.h"
#include "tests/fuzz/target.h"

namespace espalier::fuzz {
namespace {

void prepare(const std::shared_ptr<const rules::RuleSet>& rules) {
  require(!scenes::format(scenes::settings(*rules)).empty(), "a rule set of which there is nothing to say");
  for (const double voxel_m : {0.04, 1e-5, 1e6}) {
    try {
      const sim::Frame frame{sim::Vec3(0.0), voxel_m, {30, 30, 30}};
      rules::layersNeeded(*rules, voxel_m, 60.0);
      const auto nothing = std::make_shared<const sim::SceneSurface>(
          frame.size, std::vector<sim::SurfaceTriangle>(), std::vector<std::string>());
      require(rules::makeProcess(rules, frame, nothing) != nullptr, "no process");
    } catch (const sim::InputError&) {
    }
  }
}

}  // namespace

std::vector<std::string> seeds() {
  auto texts = sourceFiles("rules/library", ".yaml");
  const auto more = sourceFiles("tests/scenes/read/version_1/rules", ".yaml");
  texts.insert(texts.end(), more.begin(), more.end());
  texts.emplace_back(
      "espalier: rules/1\nbase: other.yaml\notherwise: {base: other.yaml, regions: {a: forbid, others: "
      "other.yaml}}\n"
      "elements: [{polygons: [[[0, 0, 0], [1 cm, 0, 0], [0, 1 cm, 0]]], size: {over: age, points: [[0, 1], "
      "[9, 2]]}}]\n");
  return texts;
}

}  // namespace espalier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace espalier;
  static const fuzz::InputFiles files;
  static const auto other =
      files.write("other.yaml", "espalier: rules\nbias: {up: [0, 0.5]}\nregions: {b: {name: x}}\n");
  const auto rules = scenes::readRules(files.write("rules.yaml", fuzz::textOf(data, size)));
  if (rules) {
    fuzz::prepare(*rules);
  } else {
    fuzz::require(!rules.problems().empty(), "a refusal without a word");
    scenes::format(rules.problems());
  }
  return 0;
}
