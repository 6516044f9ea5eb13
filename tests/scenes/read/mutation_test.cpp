#include <gtest/gtest.h>

#include <chrono>

#include "scenes/read/read_scene.h"
#include "tests/support/numbers.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

class Mutations : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(Mutations, EndInSenseOrInClearProblems) {
  const tests::Scratch scratch;
  const auto name = GetParam().filename().string();
  const auto original = tests::fileText(GetParam());
  // The files that it names stay whole beside it.
  for (const auto& file : tests::libraryFiles()) {
    scratch.write("rules/library/" + file.filename().string(), tests::fileText(file));
  }
  tests::Numbers numbers(original.size());
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    const auto text = tests::mutated(original, numbers);
    const auto start = std::chrono::steady_clock::now();
    const auto problems = readRulesOrScene(scratch.write("rules/library/" + name, text)).problems();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2)) << text;
    refused += !problems.empty();
    for (const auto& problem : problems) {
      EXPECT_FALSE(problem.text.empty());
      EXPECT_GE(problem.line, 0);
      EXPECT_LE(problem.line, std::count(text.begin(), text.end(), '\n') + 2) << text;
    }
  }
  EXPECT_GT(refused, 100) << "the mutations are too tame to test anything";
}

INSTANTIATE_TEST_SUITE_P(
    Library, Mutations, testing::ValuesIn(tests::libraryFiles()),
    [](const auto& at) {  // A rule set and a scene may have one name: rules_library_fir, scenes_library_fir.
      const auto folder = at.param.parent_path();
      return folder.parent_path().filename().string() + "_" + at.param.stem().string();
    });

}  // namespace
}  // namespace espalier::scenes
