// A job of a program is stopped by its token, wherever it is, by our own code: nobody ends the process.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "scenes/job/expose.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kSoon_s = 2.0;  // ten times what is promised

/// Asks to stop so long after a stage has begun.
class StopAfter {
 public:
  StopAfter(std::string stage, std::chrono::milliseconds after) : stage_(std::move(stage)), after_(after) {}

  void attach(RunOptions& options) {
    options.stop = source_.get_token();
    options.on_stage = [this](const std::string& stage) {
      if (stage != stage_ || waiter_.joinable()) return;
      waiter_ = std::jthread([this](const std::stop_token& over) {
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any().wait_for(lock, over, after_, [] { return false; });
        if (over.stop_requested()) return;
        asked_ = Clock::now();
        source_.request_stop();
      });
    };
  }
  bool asked() const { return source_.stop_requested(); }
  double sinceAsked_s() const { return std::chrono::duration<double>(Clock::now() - asked_).count(); }

 private:
  std::string stage_;
  std::chrono::milliseconds after_;
  std::stop_source source_;
  Clock::time_point asked_;
  std::jthread waiter_;
};

class StoppedJob : public testing::Test {
 protected:
  void SetUp() override {
    auto read = readScene(tests::sourceFolder() / "scenes/library/garden_wall.yaml");
    ASSERT_TRUE(read);
    scene_ = *read;
    scene_.world.voxel_m = 0.025;
    scene_.image_width = 1800;
    scene_.image_height = 1350;
  }

  template <typename Job>
  void stops(const std::string& stage, int after_ms, const Job& job) {
    StopAfter stop(stage, std::chrono::milliseconds(after_ms));
    RunOptions options;
    options.folder = scratch_.path("out");
    stop.attach(options);
    try {
      job(options);
      EXPECT_FALSE(stop.asked()) << stage << ": it was asked to stop, and was not";
    } catch (const sim::Stopped&) {
      const double took_s = stop.sinceAsked_s();
      fmt::print("{} ms after '{}': stopped after {:.3f} s\n", after_ms, stage, took_s);
      EXPECT_LT(took_s, kSoon_s) << stage;
      ++stopped_;
    }
    EXPECT_FALSE(std::filesystem::exists(options.folder)) << stage;
  }

  tests::Scratch scratch_;
  Scene scene_;
  int stopped_ = 0;
};

TEST_F(StoppedJob, EndsSoonWhereverGrowthIs) {
  const auto grow = [&](const RunOptions& options) { runScene(scene_, options); };
  for (const char* stage : {"tiling", "growing", "lighting", "modelling"}) {
    for (const int after_ms : {0, 120}) stops(stage, after_ms, grow);
  }
  for (const int after_ms : {0, 300, 1500}) stops("drawing", after_ms, grow);
  EXPECT_GE(stopped_, 9);
}

TEST_F(StoppedJob, EndsSoonWhereverExposureIs) {
  const auto expose = [&](const RunOptions& options) { exposeScene(scene_, options); };
  for (const char* stage : {"lighting", "certifying", "counting", "drawing"}) {
    for (const int after_ms : {0, 300}) stops(stage, after_ms, expose);
  }
  EXPECT_GE(stopped_, 6);
}

/// As in a server: what one grows is none of the other's affair, and neither is its stop.
TEST(TwoJobs, HearTheirOwnStopsAloneAndGrowWhatTheyGrowAlone) {
  const tests::Scratch scratch;
  auto read = readScene(tests::sourceFolder() / "scenes/library/garden_wall.yaml");
  ASSERT_TRUE(read);
  read->world.voxel_m = 0.08;
  const auto grow = [&](const std::string& folder, const std::stop_token& stop) {
    RunOptions options;
    options.pictures = false;
    options.folder = scratch.path(folder);
    options.stop = stop;
    return runScene(*read, options).growth.value().state_hash;
  };
  const auto alone = grow("alone", {});
  std::stop_source never;
  std::atomic<bool> over = false;
  int stopped = 0;
  std::jthread beside([&] {
    for (int round = 0; !over; ++round) {
      std::stop_source mine;
      const std::jthread soon([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20 * (round % 20)));
        mine.request_stop();
      });
      try {
        grow("stopped", mine.get_token());
      } catch (const sim::Stopped&) {
        ++stopped;
      }
    }
  });
  for (int round = 0; round < 2; ++round) EXPECT_EQ(grow("kept", never.get_token()), alone);
  over = true;
  beside.join();
  EXPECT_GT(stopped, 0);
}

}  // namespace
}  // namespace espalier::scenes
