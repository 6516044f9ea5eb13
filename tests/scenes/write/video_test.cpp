#include "scenes/write/video.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/stop.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

constexpr VideoShape kShape{64, 48, 12};

std::vector<std::uint8_t> frame(int number) {
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(kShape.width_px * kShape.height_px * 3));
  for (std::size_t i = 0; i < rgb.size(); ++i)
    rgb[i] = static_cast<std::uint8_t>((i * 7 + static_cast<std::size_t>(number) * 31) % 251);
  return rgb;
}

Video::Made madeBy(const std::filesystem::path& program, int frames = 9) {
  Video video(program, kShape);
  for (int i = 0; i < frames; ++i) video.add(frame(i));
  return video.finish();
}

bool hasChildren() {
  return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD;
}

/// A program that stands in for ffmpeg.
std::filesystem::path program(const tests::Scratch& scratch, const std::string& script) {
  const auto path = scratch.write("ffmpeg", "#!/bin/sh\n" + script + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

TEST(Video, IsOfTheSameBytesEachTime) {
  const auto ffmpeg = ffmpegProgram();
  if (ffmpeg.empty()) GTEST_SKIP() << "ffmpeg is not installed: apt-get install ffmpeg";
  const Video::Made once = madeBy(ffmpeg), again = madeBy(ffmpeg);
  EXPECT_EQ(once.failure, "");
  EXPECT_EQ(once.bytes.substr(4, 4), "ftyp");
  EXPECT_TRUE(once.bytes == again.bytes);
  EXPECT_FALSE(once.bytes == madeBy(ffmpeg, 8).bytes);
  EXPECT_FALSE(hasChildren());
}

TEST(Video, SaysWhatAProgramSaysThatFails) {
  const tests::Scratch scratch;
  const Video::Made made =
      madeBy(program(scratch, "echo first >&2; echo \"Unknown encoder 'x'\" >&2; exit 3"));
  EXPECT_EQ(made.bytes, "");
  EXPECT_EQ(made.failure, "ffmpeg ended with status 3: Unknown encoder 'x'");
  EXPECT_EQ(madeBy(program(scratch, "cat >/dev/null")).failure, "ffmpeg wrote nothing");
  EXPECT_EQ(madeBy(program(scratch, "kill -11 $$")).failure, "ffmpeg was ended by signal 11");
  EXPECT_EQ(madeBy(scratch.path("none")).failure, "ffmpeg ended with status 127");
  EXPECT_FALSE(hasChildren());
}

TEST(Video, TakesNoneOfItsProcessesAlongWhereTheJobIsStopped) {
  const tests::Scratch scratch;
  const auto sleeps = program(scratch, "exec sleep 100");
  for (const bool at_the_end : {false, true}) {
    std::stop_source source;
    const sim::StopScope scope(source.get_token());
    std::jthread later([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(150));
      source.request_stop();
    });
    const auto began = std::chrono::steady_clock::now();
    EXPECT_THROW(
        {
          Video video(sleeps, kShape);
          for (int i = 0; !at_the_end; ++i) video.add(frame(i));
          video.finish();
        },
        sim::Stopped);
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(5));
    EXPECT_FALSE(hasChildren());
  }
}

TEST(Video, ItsProgramIsLookedForInPath) {
  const tests::Scratch scratch;
  const auto here = program(scratch, "exit 0");
  const std::string before = std::getenv("PATH");
  ::setenv("PATH", (":/nowhere:" + here.parent_path().string()).c_str(), 1);
  EXPECT_EQ(ffmpegProgram(), here);
  std::filesystem::permissions(here, std::filesystem::perms::owner_read);
  ::setenv("PATH", "/nowhere", 1);
  EXPECT_EQ(ffmpegProgram(), "");
  ::setenv("PATH", before.c_str(), 1);
}

}  // namespace
}  // namespace espalier::scenes
