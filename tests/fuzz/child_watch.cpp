#include "tests/fuzz/child_watch.h"

#include <fcntl.h>
#include <pthread.h>
#include <sanitizer/common_interface_defs.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>

// Where the linker puts the counters that clang's instrumentation counts in: libFuzzer's, and those of
// coverage.
extern "C" {
extern char __start___sancov_cntrs __attribute__((weak, visibility("hidden")));
extern char __stop___sancov_cntrs __attribute__((weak, visibility("hidden")));
extern char __start___llvm_prf_cnts __attribute__((weak, visibility("hidden")));
extern char __stop___llvm_prf_cnts __attribute__((weak, visibility("hidden")));
}

namespace espalier::fuzz {
namespace {

std::array<int, 2> reports{-1, -1};  // a pipe

/// Puts memory that a fork does not copy in place of whole pages.
void share(char* begin, char* end) {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
  const auto last = reinterpret_cast<std::uintptr_t>(end) / page * page;
  if (first >= last) return;
  auto* const at = reinterpret_cast<void*>(first);
  const std::string kept(static_cast<const char*>(at), last - first);
  if (::mmap(at, kept.size(), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_FIXED, -1, 0) ==
      MAP_FAILED)
    std::abort();
  std::memcpy(at, kept.data(), kept.size());
}

/// A child's crash is nothing that libFuzzer should write down.
void inChild() {
  __sanitizer_set_report_fd(reinterpret_cast<void*>(static_cast<std::intptr_t>(reports[1])));
  __sanitizer_set_death_callback([] {});
  std::signal(SIGXFSZ, SIG_DFL);
}

std::string told() {
  std::string text;
  std::array<char, 4096> buffer{};
  while (true) {
    const ssize_t n = ::read(reports[0], buffer.data(), buffer.size());
    if (n <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

/// Whether the innermost frame that belongs to anybody is ours. To run out of memory is what a child may do.
bool isOurs(const std::string& report) {
  if (report.find("runtime error:") != report.npos) return true;  // only what is compiled here says so
  if (report.find("ERROR: AddressSanitizer") == report.npos || report.find("out-of-memory") != report.npos ||
      report.find("allocation-size-too-big") != report.npos)
    return false;
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("libassimp") != line.npos) return false;
    if (line.find(" in espalier::") != line.npos) return true;
  }
  return true;
}

}  // namespace

void watchChildren() {
  share(&__start___sancov_cntrs, &__stop___sancov_cntrs);
  share(&__start___llvm_prf_cnts, &__stop___llvm_prf_cnts);
  if (::pipe2(reports.data(), O_CLOEXEC | O_NONBLOCK) != 0 ||
      ::pthread_atfork(nullptr, nullptr, inChild) != 0)
    std::abort();
}

void requireChildrenWithoutFault() {
  const std::string report = told();
  if (!isOurs(report) || report.empty()) return;
  std::fputs(report.c_str(), stderr);
  std::abort();
}

}  // namespace espalier::fuzz
