#include "sim/base/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

namespace espalier::sim {
namespace {

namespace fs = std::filesystem;

/// The number in a control group's file; infinity where there is no file, or no limit ("max").
double limitIn(const fs::path& file) {
  std::ifstream in(file);
  double bytes = INFINITY;
  return in >> bytes ? bytes : INFINITY;
}

/// The least number in a folder and those around it up to the root.
double leastAbove(const fs::path& root, std::string_view group, const char* name) {
  fs::path folder = fs::path(group).relative_path().lexically_normal();
  double least = limitIn(root / name);
  while (!folder.empty() && folder != "." && *folder.begin() != "..") {
    least = std::min(least, limitIn(root / folder / name));
    folder = folder.parent_path();
  }
  return least;
}

struct Limit {
  double bytes = 0.0;
  bool of_addresses = false;  // RLIMIT_AS is the least
};

/// The text of a file; empty where there is none.
std::string textOf(const char* file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct InUse {
  double addresses = 0.0, resident = 0.0;  // bytes
};

InUse inUse() {
  std::ifstream in("/proc/self/statm");
  InUse pages;
  in >> pages.addresses >> pages.resident;
  const auto page = static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  return {page * pages.addresses, page * pages.resident};
}

Limit findLimit() {
  double least =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  least = std::min(least, availableIn(textOf("/proc/meminfo")) + inUse().resident);
  least = std::min(least, controlGroupLimit(textOf("/proc/self/cgroup"), "/sys/fs/cgroup"));
  rlimit addresses{};
  if (::getrlimit(RLIMIT_AS, &addresses) != 0 || addresses.rlim_cur == RLIM_INFINITY) return {least, false};
  const auto most = static_cast<double>(addresses.rlim_cur);
  return {std::min(least, most), most < least};
}

const Limit& limit() {
  static const Limit found = findLimit();
  return found;
}

}  // namespace

double memoryBudget() {
  return 0.75 * limit().bytes;
}

double memoryInUse() {
  return limit().of_addresses ? inUse().addresses : inUse().resident;
}

// Lines of "name:   number kB", in units of 1024 bytes.
double availableIn(std::string_view meminfo) {
  constexpr std::string_view kName = "MemAvailable:";
  const std::size_t at = meminfo.find(kName);
  if (at == meminfo.npos) return INFINITY;
  std::istringstream in{std::string(meminfo.substr(at + kName.size()))};
  double kib = INFINITY;
  return in >> kib ? 1024.0 * kib : INFINITY;
}

// Lines of "number:controllers:path"; of version 2 "0::path".
double controlGroupLimit(std::string_view about, const fs::path& root) {
  double least = INFINITY;
  while (!about.empty()) {
    const std::string_view line = about.substr(0, about.find('\n'));
    about.remove_prefix(std::min(about.size(), line.size() + 1));
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == line.npos || second == line.npos) continue;
    const std::string controllers = "," + std::string(line.substr(first + 1, second - first - 1)) + ",";
    const std::string_view group = line.substr(second + 1);
    if (controllers == ",,") least = std::min(least, leastAbove(root, group, "memory.max"));
    if (controllers.find(",memory,") != controllers.npos)
      least = std::min(least, leastAbove(root / "memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

void releaseFreed() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

std::string inGigabytes(double bytes) {
  const double gib = bytes / (1024.0 * 1024.0 * 1024.0);
  return gib < 1e6 ? fmt::format("{:.1f} GB", gib) : fmt::format("{:.3g} GB", gib);
}

}  // namespace espalier::sim
