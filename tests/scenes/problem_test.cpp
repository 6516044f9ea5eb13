#include "scenes/problem.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace espalier::scenes {
namespace {

using Words = std::vector<std::string>;

TEST(DidYouMean, NamesTheNearestThatIsNearEnough) {
  const Words words = {"paving", "wall", "roof", "bed"};
  EXPECT_EQ(didYouMean("pavingg", words), "; did you mean 'paving'?");
  EXPECT_EQ(didYouMean("wlal", words), "; did you mean 'wall'?") << "neighbours swapped";
  EXPECT_EQ(didYouMean("ROFO", words), "; did you mean 'roof'?");
  EXPECT_EQ(didYouMean("be", words), "; did you mean 'bed'?");
  EXPECT_EQ(didYouMean("chimney", words), "");
  EXPECT_EQ(didYouMean("", words), "");
  EXPECT_EQ(didYouMean(std::string(70'000, 'x'), words), "");
  EXPECT_EQ(didYouMean("abcdef", {"abcxyz", "abdcef", "abcdxf"}), "; did you mean 'abdcef'?")
      << "of equally near ones the first";
  EXPECT_EQ(didYouMean("abcdef", {"abcdxy", "abcdex"}), "; did you mean 'abcdex'?");
}

TEST(Listed, NamesAFewOfManyAndHowManyMoreThereAre) {
  EXPECT_EQ(listed({}), "none");
  EXPECT_EQ(listed({"a", "b"}, "c"), "a, b");
  Words many;
  for (int i = 0; i < 20'000; ++i) many.push_back("r_" + std::to_string(i));
  EXPECT_EQ(listed(many),
            "r_0, r_1, r_2, r_3, r_4, r_5, r_6, r_7, r_8, r_9, r_10, r_11, r_12, r_13, r_14, r_15 and 19984 "
            "more");
  const std::string near = listed(many, "r_1243x");
  EXPECT_TRUE(near.starts_with("r_1243, r_12430, r_12431, ")) << near;
  EXPECT_TRUE(near.ends_with(" and 19992 more")) << near;
  EXPECT_EQ(listed(many, "roofs"), "r_0, r_1, r_2, r_3, r_4, r_5, r_6, r_7 and 19992 more");
}

TEST(Format, MakesOneLineOfAProblem) {
  const Problem problem{"a\nb.yaml", 3, 1, "the key '\x1b[31m' is unknown"};
  EXPECT_EQ(format(problem), "a\\nb.yaml:3:1: the key '\\x1b[31m' is unknown");
  const PlacedError error({problem, {"c", 0, 0, "wrong"}});
  EXPECT_EQ(error.lines(), (Words{format(problem), "c: wrong"}));
  EXPECT_EQ(error.what(), format(problem) + "\nc: wrong");
}

TEST(Gathering, TellsAllThatIsWrongWithItsPlaces) {
  Gathering wrong("a.yaml");
  wrong.part([] {});
  wrong.end();
  const Place place{std::make_shared<const std::string>("b.yaml"), 3, 5, 9, "x.y"};
  wrong.part(place, [] { throw sim::InputError("one"); });
  wrong.part([] { throw sim::InputError("two"); });
  wrong.part(place, [] { throw PlacedError({{"c.yaml", 1, 2, "three"}, {"a.yaml", 0, 0, "two"}}); });
  try {
    wrong.end();
    FAIL() << "nothing was said";
  } catch (const PlacedError& error) {
    EXPECT_EQ(error.problems(),
              (std::vector<Problem>{
                  {"b.yaml", 3, 5, "one", 9, "x.y"}, {"a.yaml", 0, 0, "two"}, {"c.yaml", 1, 2, "three"}}));
  }
}

TEST(Gathering, EndsWhereNobodyReadsOn) {
  Gathering wrong("a.yaml");
  for (std::size_t i = 0; i < 2 * kMostProblems; ++i) wrong.add({"a.yaml", 0, 0, std::to_string(i)});
  try {
    wrong.end();
    FAIL() << "nothing was said";
  } catch (const PlacedError& error) {
    ASSERT_EQ(error.problems().size(), kMostProblems + 1);
    EXPECT_EQ(error.lines().back(), "a.yaml: 1000 problems and perhaps more; the rest is not shown");
  }
}

}  // namespace
}  // namespace espalier::scenes
