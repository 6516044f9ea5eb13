// The time left, on a clock that the test winds.
#include "cli/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace espalier::cli {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class ProgressTold : public testing::Test {
 protected:
  /// What is said in the end, line by line, without what a terminal is told beside.
  static std::vector<std::string> lines(const std::string& said) {
    std::vector<std::string> lines(1);
    for (std::size_t i = 0; i < said.size(); ++i) {
      if (said[i] == '\n' || said[i] == '\r') {
        lines.emplace_back();
      } else if (said.compare(i, 3, "\033[K") == 0) {
        i += 2;
      } else {
        lines.back() += said[i];
      }
    }
    std::erase(lines, "");
    return lines;
  }
  /// A run that tiles for 100 s, grows from the iteration `first` on, one in 2 s, and foretells after the
  /// third.
  static std::vector<std::string> run(bool terminal, int first) {
    testing::internal::CaptureStderr();
    {
      Progress progress(false, terminal);
      Progress::Time now(seconds(12345));
      progress.stage("tiling", now);
      now += seconds(100);
      progress.stage("growing", now);
      for (int done = first + 1; done <= first + 5; ++done) {
        now += seconds(2);
        progress.growth({.iteration = done, .iterations = 40, .first = first, .segments = 7, .sites = 9},
                        now);
        if (done == first + 3) progress.foretold("foretold", now);
      }
    }
    return lines(testing::internal::GetCapturedStderr());
  }
  static std::string leftOf(const std::string& line) { return line.substr(line.rfind(", ")); }
};

TEST_F(ProgressTold, TheTimeLeftCountsFromWhenGrowthBeganAndWhereItBegan) {
  const auto told = run(true, 0);
  ASSERT_EQ(told.size(), 9u);
  EXPECT_EQ(told[0], "tiling");
  EXPECT_EQ(told[1], "growing");
  EXPECT_EQ(told[2],
            "growing [                            ] iteration 1/40, 7 segments, 9 live buds, 78 s left");
  EXPECT_EQ(leftOf(told[4]), ", 74 s left");
  EXPECT_EQ(told[5], "foretold");
  EXPECT_EQ(told[6], "growing");
  EXPECT_EQ(leftOf(told[7]), ", 72 s left");
  EXPECT_EQ(leftOf(told[8]), ", 70 s left");
  EXPECT_EQ(leftOf(run(true, 10).back()), ", 50 s left");
}

TEST_F(ProgressTold, ElsewhereThanOnATerminalNothingIsSaidBefore) {
  EXPECT_EQ(run(false, 0),
            (std::vector<std::string>{"foretold", "growing", "  iteration 4/40, 7 segments, 9 live buds",
                                      "  iteration 5/40, 7 segments, 9 live buds"}));
}

TEST_F(ProgressTold, NoMoreOftenThanSomebodyReadsButTheLast) {
  for (const bool terminal : {false, true}) {
    testing::internal::CaptureStderr();
    Progress progress(false, terminal);
    Progress::Time now(seconds(12345));
    progress.foretold("foretold", now);
    progress.stage("growing", now);
    for (int done = 1; done <= 400; ++done) {
      now += milliseconds(10);
      progress.growth({.iteration = done, .iterations = 400, .sites = 9}, now);
    }
    const auto told = lines(testing::internal::GetCapturedStderr());
    EXPECT_EQ(told.size(), 2 + (terminal ? 80u : 2u));
    EXPECT_NE(told.back().find("iteration 400/400"), std::string::npos) << told.back();
  }
}

TEST_F(ProgressTold, QuietSaysNothingButWarnings) {
  testing::internal::CaptureStderr();
  Progress progress(true, true);
  const Progress::Time now(seconds(12345));
  progress.stage("growing", now);
  progress.growth({.iteration = 1, .iterations = 1}, now + seconds(9));
  progress.warning("careful");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "careful\n");
}

}  // namespace
}  // namespace espalier::cli
