#include "scenes/import/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>

#include "sim/base/error.h"
#include "sim/base/stop.h"

namespace espalier::scenes {
namespace {

// Sanitizers map terabytes of shadow memory, so a limit on the address space would end every child at once.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitMemory = false;
#else
constexpr bool kLimitMemory = true;
#endif

constexpr char kFinished = 'F';
constexpr char kThrew = 'T';
constexpr char kOutOfMemory = 'M';

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  int get() const { return fd_; }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

 private:
  int fd_;
};

/// Never beyond what is allowed already.
void limitTo(int resource, rlim_t soft, rlim_t hard) {
  rlimit limit{};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) ::_exit(1);
  limit.rlim_max = std::min(limit.rlim_max, hard);
  limit.rlim_cur = std::min(limit.rlim_max, soft);
  if (::setrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) ::_exit(1);
}

void enterLimits(const ChildLimits& limits, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent went before the line above could tie us to it
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  limitTo(RLIMIT_CORE, 0, 0);
  limitTo(RLIMIT_FSIZE, 0, 0);
  const auto seconds = static_cast<rlim_t>(limits.cpu.count());
  limitTo(RLIMIT_CPU, seconds, seconds + 1);
  if (kLimitMemory) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t bytes = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + limits.memory_bytes;
    limitTo(RLIMIT_AS, bytes, bytes);
  }
  // An abort inside a library prints to the terminal; the parent says it better.
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

void send(int fd, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::write(fd, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(1);
    data += n;
    size -= static_cast<std::size_t>(n);
  }
}

[[noreturn]] void childMain(const std::function<std::string()>& work, const ChildLimits& limits, pid_t parent,
                            int fd) {
  enterLimits(limits, parent);
  char kind = kFinished;
  std::string bytes;
  try {
    bytes = work();
  } catch (const std::bad_alloc&) {
    kind = kOutOfMemory;
  } catch (const std::exception& error) {
    kind = kThrew;
    bytes = error.what();
  }
  send(fd, &kind, 1);
  send(fd, bytes.data(), bytes.size());
  ::_exit(0);  // nothing of the parent's may be run or flushed a second time
}

enum class Received { all, late, too_long };

constexpr std::chrono::milliseconds kBetweenQuestions(20);  // whether to stop

/// Everything that the child writes until it closes its end.
Received receive(int fd, std::chrono::steady_clock::time_point deadline, std::size_t limit,
                 std::string& bytes) {
  std::array<char, 1 << 16> buffer{};
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now())
            .count();
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

}  // namespace

ChildResult runInChild(const std::function<std::string()>& work, const ChildLimits& limits) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error(fmt::format("cannot open a pipe: {}", std::strerror(errno)));
  }
  Descriptor read_end(ends[0]);
  Descriptor write_end(ends[1]);
  const auto deadline = std::chrono::steady_clock::now() + limits.wall;
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(errno)));
  if (child == 0) childMain(work, limits, parent, write_end.get());

  write_end.close();
  const auto end = [&] {
    ::kill(child, SIGKILL);
    waitFor(child);
  };
  std::string bytes;
  Received received = Received::too_long;  // what running out of memory in here leaves behind
  try {
    received = receive(read_end.get(), deadline, limits.result_bytes, bytes);
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

}  // namespace espalier::scenes
