#include "scenes/import/child_work.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <new>
#include <stdexcept>

#include "scenes/import/wire.h"

namespace espalier::scenes {
namespace {

// Sanitizers map terabytes of shadow memory, so a limit on the address space would end every child at once.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitMemory = false;
#else
constexpr bool kLimitMemory = true;
#endif

/// Never beyond what is allowed already.
void limitTo(int resource, rlim_t soft, rlim_t hard) {
  rlimit limit{};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) ::_exit(1);
  limit.rlim_max = std::min(limit.rlim_max, hard);
  limit.rlim_cur = std::min(limit.rlim_max, soft);
  if (::setrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) ::_exit(1);
}

void sendAll(int to, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::write(to, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(1);
    data += n;
    size -= static_cast<std::size_t>(n);
  }
}

std::string untilTheEnd(int from) {
  std::string bytes;
  std::array<char, 1 << 16> buffer{};
  for (;;) {
    const ssize_t n = ::read(from, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw std::runtime_error("the order cannot be read");
    if (n == 0) return bytes;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

std::function<std::string()> ordered(
    const std::function<std::function<std::string()>(const std::string&)>& workFor) {
  const std::string order = untilTheEnd(STDIN_FILENO);
  Unpacker in(order);
  endWith(in.get<pid_t>());
  ChildLimits limits;
  limits.cpu = std::chrono::seconds(in.get<std::int64_t>());
  limits.memory_bytes = static_cast<std::size_t>(in.get<std::uint64_t>());
  const std::string ask = in.getText();
  in.requireEnd();
  std::function<std::string()> work = workFor(ask);
  enterLimits(limits);
  return work;
}

}  // namespace

void endWith(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it went before the line above could tie us to it
}

void enterLimits(const ChildLimits& limits) {
  limitTo(RLIMIT_CORE, 0, 0);
  limitTo(RLIMIT_FSIZE, 0, 0);
  const auto seconds = static_cast<rlim_t>(limits.cpu.count());
  limitTo(RLIMIT_CPU, seconds, seconds + 1);
  if (!kLimitMemory) return;
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t bytes = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + limits.memory_bytes;
  limitTo(RLIMIT_AS, bytes, bytes);
}

void fallSilent() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  if (nowhere > STDERR_FILENO) ::close(nowhere);
}

void answer(const std::function<std::string()>& work, int to) {
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
  sendAll(to, &kind, 1);
  sendAll(to, bytes.data(), bytes.size());
  ::_exit(0);
}

std::string orderFor(const std::string& ask, const ChildLimits& limits) {
  Packer order;
  order.put(::getpid());
  order.put(static_cast<std::int64_t>(limits.cpu.count()));
  order.put(static_cast<std::uint64_t>(limits.memory_bytes));
  order.putText(ask);
  return order.take();
}

void answerParent(const std::function<std::function<std::string()>(const std::string& ask)>& workFor) {
  const int to = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  if (to < 0) ::_exit(1);
  fallSilent();
  // What fails on the way to the work is told as what fails in it.
  answer([&] { return ordered(workFor)(); }, to);
}

}  // namespace espalier::scenes
