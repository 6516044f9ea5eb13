#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "scenes/import/child_process.h"
#include "sim/base/error.h"
#include "sim/base/stop.h"

namespace espalier::scenes {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

ChildResult asked(const std::string& what, ChildLimits limits = {}) {
  return runInProgram(ESPALIER_STRANGE_READER, what, limits);
}

bool hasChildren() {
  return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD;
}

TEST(ExecutedChild, HandsBackWhatTheWorkReturned) {
  std::string large = std::string(3'000'000, 'x') + '\0' + "end";  // many times what a socket or a pipe holds
  EXPECT_EQ(asked(large).bytes, large);
  EXPECT_EQ(asked("long").bytes, std::string(5'000'000, 'x'));
  const ChildResult babbled = asked("babble");
  EXPECT_EQ(babbled.end, ChildEnd::finished);
  EXPECT_EQ(babbled.bytes, "an answer");
  EXPECT_FALSE(hasChildren());
}

TEST(ExecutedChild, WhateverItDoesIsAResult) {
  EXPECT_EQ(asked("throw").end, ChildEnd::threw);
  EXPECT_EQ(asked("throw").bytes, "no good");
  EXPECT_EQ(asked("throw early").end, ChildEnd::threw);
  EXPECT_EQ(asked("throw early").bytes, "not ready");
  EXPECT_EQ(asked("abort").end, ChildEnd::crashed);
  EXPECT_EQ(asked("exit").bytes, "exit status 3");
  EXPECT_EQ(asked("kill").end, ChildEnd::crashed);
  EXPECT_THROW(asked("interrupt"), sim::Stopped);
  EXPECT_FALSE(hasChildren());
}

TEST(ExecutedChild, HangsEndAtTheWallClockAndAtTheProcessorLimit) {
  ChildLimits limits;
  limits.wall = 200ms;
  EXPECT_EQ(asked("sleep", limits).end, ChildEnd::out_of_time);
  limits = {};
  limits.cpu = 1s;
  EXPECT_EQ(asked("spin", limits).end, ChildEnd::out_of_time);
  EXPECT_FALSE(hasChildren());
}

TEST(ExecutedChild, MemoryIsLimited) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need the address space";
#endif
  ChildLimits limits;
  limits.memory_bytes = std::size_t{64} << 20;
  EXPECT_EQ(asked("eat", limits).end, ChildEnd::out_of_memory);
  limits.result_bytes = 1000;
  EXPECT_EQ(asked("long", limits).end, ChildEnd::out_of_memory);
}

TEST(ExecutedChild, AStopEndsIt) {
  std::stop_source source;
  const sim::StopScope in_force(source.get_token());
  const std::jthread later([&] {
    std::this_thread::sleep_for(100ms);
    source.request_stop();
  });
  const auto begin = Clock::now();
  EXPECT_THROW(asked("sleep"), sim::Stopped);
  EXPECT_LT(Clock::now() - begin, 10s);
  EXPECT_FALSE(hasChildren());
  EXPECT_THROW(asked("long"), sim::Stopped);
}

/// On another thread, and another job.
TEST(ExecutedChild, AStopOfAnotherJobDoesNot) {
  std::stop_source mine, other;
  std::jthread beside([&] {
    const sim::StopScope in_force(other.get_token());
    EXPECT_THROW(asked("sleep"), sim::Stopped);
  });
  const sim::StopScope in_force(mine.get_token());
  other.request_stop();
  EXPECT_EQ(asked("long").end, ChildEnd::finished);
}

TEST(ExecutedChild, HasTheSignalsOfAForkedOneAndNoHandlersOfOurs) {
  EXPECT_EQ(asked("signals").bytes, "-d-d-d-d");
  std::jthread([] {
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGINT);
    pthread_sigmask(SIG_BLOCK, &blocked, nullptr);
    EXPECT_EQ(asked("signals").bytes, "bd-d-d-d");
  }).join();
  const auto before = std::signal(SIGTERM, SIG_IGN);
  EXPECT_EQ(asked("signals").bytes, "-d-d-d-d");
  std::signal(SIGTERM, before);
}

TEST(ExecutedChild, HasItsLimitsAndNoFilesOfOurs) {
  ChildLimits limits;
  limits.cpu = 17s;
  EXPECT_EQ(asked("limits", limits).bytes, "0 0 17 ");
  const std::ofstream careless("/dev/null");  // not closed by the system where a program is executed
  const int another = ::open("/dev/null", O_RDONLY);
  EXPECT_EQ(asked("open files").bytes, "");
  ::close(another);
}

TEST(ExecutedChild, WhatCannotBeStartedIsTold) {
  try {
    runInProgram("/nowhere/program", "", {});
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "cannot start /nowhere/program: No such file or directory");
  }
  EXPECT_EQ(runInProgram("/bin/true", "", {}).bytes, "exit status 0");
  EXPECT_EQ(runInProgram("/bin/echo", "", {}).end, ChildEnd::crashed) << "an answer that makes no sense";
  EXPECT_EQ(runInProgram("/bin/true", std::string(5'000'000, 'x'), {}).end, ChildEnd::crashed)
      << "it takes nothing";
}

TEST(ExecutedChild, EndsWithItsParent) {
  const pid_t parent = ::fork();
  if (parent == 0) {
    ::execl(ESPALIER_STRANGE_READER, ESPALIER_STRANGE_READER, ESPALIER_STRANGE_READER, "sleep", nullptr);
    ::_exit(127);
  }
  pid_t child = 0;
  for (int i = 0; i < 500 && child == 0; ++i, std::this_thread::sleep_for(10ms)) {
    std::ifstream children("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) +
                           "/children");
    if (!(children >> child)) child = 0;
  }
  ASSERT_GT(child, 0);
  std::this_thread::sleep_for(200ms);  // it sleeps now, or was told by its own question that we are gone
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  bool gone = false;
  for (int i = 0; i < 500 && !gone; ++i, std::this_thread::sleep_for(10ms)) {
    std::ifstream about("/proc/" + std::to_string(child) + "/stat");
    std::string word, state;
    gone = !(about >> word >> word >> state) || state == "Z" || state == "X";
  }
  EXPECT_TRUE(gone);
}

}  // namespace
}  // namespace espalier::scenes
