#include "scenes/import/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "scenes/import/child_work.h"
#include "sim/base/error.h"
#include "sim/base/stop.h"

namespace espalier::scenes {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() { close(); }
  int get() const { return fd_; }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

 private:
  int fd_;
};

/// Two that are connected, neither among the three standard ones: those are put in their places in a child.
struct Ends {
  Descriptor ours, theirs;
};

int aside(int fd) {
  if (fd > STDERR_FILENO) return fd;
  const Descriptor low(fd);
  return ::fcntl(fd, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
}

Ends connected(std::array<int, 2> ends, bool made) {
  const int reason = errno;
  if (made) ends = {aside(ends[0]), aside(ends[1])};
  if (made && ends[0] >= 0 && ends[1] >= 0) return {Descriptor(ends[0]), Descriptor(ends[1])};
  const int why = made ? errno : reason;
  for (const int end : ends) {
    if (end >= 0) ::close(end);
  }
  throw std::runtime_error(fmt::format("cannot open a pipe: {}", std::strerror(why)));
}

/// What they write comes to us.
Ends pipeToUs() {
  std::array<int, 2> ends{-1, -1};
  const bool made = ::pipe2(ends.data(), O_CLOEXEC) == 0;
  return connected(ends, made);
}

/// What we write comes to them; unlike into a pipe, it can be written without a signal where they have gone.
Ends socketToThem() {
  std::array<int, 2> ends{-1, -1};
  const bool made = ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0;
  return connected(ends, made);
}

constexpr std::array<int, 3> kEnding{SIGINT, SIGTERM, SIGHUP};  // what ends a child of ours is not ours

[[noreturn]] void childMain(const std::function<std::string()>& work, const ChildLimits& limits, pid_t parent,
                            int to) {
  endWith(parent);
  for (const int signal : kEnding) std::signal(signal, SIG_DFL);
  enterLimits(limits);
  fallSilent();
  answer(work, to);
}

/// Executes the program with those as its standard input and output, and no other descriptor of ours, whoever
/// opened it.
pid_t spawned(const std::filesystem::path& program, int in, int out) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t how;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawnattr_init(&how);
  ::posix_spawn_file_actions_adddup2(&files, in, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
  ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  sigset_t ending;
  sigemptyset(&ending);
  for (const int signal : kEnding) sigaddset(&ending, signal);
  ::posix_spawnattr_setsigdefault(&how, &ending);
  ::posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGDEF);
  std::string name = program.string(), flag = kAnswerFlag;
  const std::array<char*, 3> command{name.data(), flag.data(), nullptr};
  pid_t child = -1;
  const int failure = ::posix_spawn(&child, name.c_str(), &files, &how, command.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  ::posix_spawnattr_destroy(&how);
  if (failure != 0)
    throw std::runtime_error(fmt::format("cannot start {}: {}", name, std::strerror(failure)));
  return child;
}

enum class Received { all, late, too_long };

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kBetweenQuestions(20);  // whether to stop

/// Whether all was taken in time, or its taker has ended, of which its answer will tell.
bool give(int to, std::string_view bytes, Clock::time_point deadline) {
  while (!bytes.empty()) {
    if (Clock::now() >= deadline) return false;
    sim::throwIfStopped();
    pollfd wait{to, POLLOUT, 0};
    const int ready = ::poll(&wait, 1, static_cast<int>(kBetweenQuestions.count()));
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t n = ::send(to, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (n <= 0) return true;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

/// Everything that the child writes until it closes its end.
Received receive(int fd, Clock::time_point deadline, std::size_t limit, std::string& bytes) {
  std::array<char, 1 << 16> buffer{};
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return Received::late;
    sim::throwIfStopped();
    pollfd wait{fd, POLLIN, 0};
    const int ready = ::poll(&wait, 1, static_cast<int>(std::min<long>(left, kBetweenQuestions.count())));
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    if (ready < 0) return Received::late;
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return Received::all;
    if (bytes.size() + static_cast<std::size_t>(n) > limit) return Received::too_long;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

int waitFor(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

ChildResult resultOf(int status, std::string bytes) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) throw sim::Stopped();
    if (signal == SIGXCPU) return {ChildEnd::out_of_time, {}};
    return {ChildEnd::crashed, fmt::format("signal {}, {}", signal, ::strsignal(signal))};
  }
  if (bytes.empty()) return {ChildEnd::crashed, fmt::format("exit status {}", WEXITSTATUS(status))};
  const char kind = bytes.front();
  bytes.erase(0, 1);
  switch (kind) {
    case kFinished:
      return {ChildEnd::finished, std::move(bytes)};
    case kThrew:
      return {ChildEnd::threw, std::move(bytes)};
    case kOutOfMemory:
      return {ChildEnd::out_of_memory, {}};
    default:
      return {ChildEnd::crashed, "an answer that makes no sense"};
  }
}

/// What a child answers, once it was told what it is to do.
template <class Tell>
ChildResult answerOf(pid_t child, int from, const ChildLimits& limits, Clock::time_point deadline,
                     Tell tell) {
  const auto end = [&] {
    ::kill(child, SIGKILL);
    waitFor(child);
  };
  std::string bytes;
  Received received = Received::too_long;  // what running out of memory in here leaves behind
  try {
    received = tell() ? receive(from, deadline, limits.result_bytes, bytes) : Received::late;
  } catch (const std::bad_alloc&) {
    bytes.clear();
  } catch (const sim::Stopped&) {
    end();
    throw;
  }
  if (received != Received::all) {
    end();
    return {received == Received::late ? ChildEnd::out_of_time : ChildEnd::out_of_memory, {}};
  }
  return resultOf(waitFor(child), std::move(bytes));
}

}  // namespace

ChildResult runInChild(const std::function<std::string()>& work, const ChildLimits& limits) {
  Ends answers = pipeToUs();
  const auto deadline = Clock::now() + limits.wall;
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(errno)));
  if (child == 0) childMain(work, limits, parent, answers.theirs.get());
  answers.theirs.close();
  return answerOf(child, answers.ours.get(), limits, deadline, [] { return true; });
}

ChildResult runInProgram(const std::filesystem::path& program, const std::string& ask,
                         const ChildLimits& limits) {
  const std::string order = orderFor(ask, limits);
  Ends orders = socketToThem();
  Ends answers = pipeToUs();
  const auto deadline = Clock::now() + limits.wall;
  const pid_t child = spawned(program, orders.theirs.get(), answers.theirs.get());
  orders.theirs.close();
  answers.theirs.close();
  return answerOf(child, answers.ours.get(), limits, deadline, [&] {
    const bool given = give(orders.ours.get(), order, deadline);
    orders.ours.close();
    return given;
  });
}

}  // namespace espalier::scenes
