#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>

#include "scenes/read/read_scene.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

/// A small generator whose numbers are the same everywhere (SplitMix64).
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t end) {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<std::size_t>((z ^ (z >> 31)) % end);
  }

 private:
  std::uint64_t state_;
};

std::string mutated(std::string text, Numbers& numbers) {
  constexpr std::string_view kNasty = "{}[]:,-#&*!|>'\"%@`\n\t ?~0.eE<\\\xff";
  const std::size_t edits = 1 + numbers.below(4);
  for (std::size_t i = 0; i < edits && !text.empty(); ++i) {
    const auto at = numbers.below(text.size());
    switch (numbers.below(5)) {
      case 0:
        text[at] = static_cast<char>(numbers.below(256));
        break;
      case 1:
        text[at] = kNasty[numbers.below(kNasty.size())];
        break;
      case 2:
        text.insert(at, 1, kNasty[numbers.below(kNasty.size())]);
        break;
      case 3:
        text.erase(at, 1 + numbers.below(8));
        break;
      case 4:
        text.insert(at, text.substr(numbers.below(text.size()), numbers.below(40)));
        break;
    }
  }
  return text;
}

class Mutations : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(Mutations, EndInSenseOrInClearProblems) {
  const tests::Scratch scratch;
  const auto name = GetParam().filename().string();
  const auto original = tests::fileText(GetParam());
  // The files that it names stay whole beside it.
  for (const auto& file : tests::libraryFiles()) {
    scratch.write("rules/library/" + file.filename().string(), tests::fileText(file));
  }
  Numbers numbers(original.size());
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    const auto text = mutated(original, numbers);
    const auto start = std::chrono::steady_clock::now();
    const auto problems = checkFile(scratch.write("rules/library/" + name, text));
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

INSTANTIATE_TEST_SUITE_P(Library, Mutations, testing::ValuesIn(tests::libraryFiles()),
                         [](const auto& at) { return at.param.stem().string(); });

}  // namespace
}  // namespace espalier::scenes
