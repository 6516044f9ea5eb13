#include "tests/bench/machine.h"

#include <embree3/rtcore_config.h>
#include <fmt/format.h>
#include <oneapi/tbb/version.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>

#include "sim/base/parallel.h"
#include "sim/sweep/lanes.h"
#include "tests/bench/peers.h"
#include "tests/bench/report.h"

namespace espalier::bench {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unnamed processor";
}

}  // namespace

std::string machineText() {
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return fmt::format(
      "{}, {} threads, {}, {:.0f} GB of memory\n"
      "{}, {}, Embree {}, Highway {}, oneTBB {}",
      processor(), sim::threadCount(), sim::lanes::level(), memory / 1e9,
#if defined(__clang__)
      "Clang " __clang_version__,
#else
      "GCC " __VERSION__,
#endif
      vdbVersions(), RTC_VERSION_STRING, ESPALIER_HIGHWAY_VERSION, TBB_VERSION_STRING);
}

std::string loadText() {
  double load = 0.0;
  if (getloadavg(&load, 1) != 1) return "load before the run unknown";
  return fmt::format("load before the run {:.2f}", load);
}

double copyBandwidth() {
  constexpr std::size_t kBytes = std::size_t{1} << 29, kPiece = std::size_t{1} << 22;
  const auto from = std::make_unique<char[]>(kBytes);
  const auto to = std::make_unique_for_overwrite<char[]>(kBytes);
  const double seconds = medianSeconds([&] {
    sim::parallelForEach(kBytes / kPiece,
                         [&](std::size_t i) { std::memcpy(&to[i * kPiece], &from[i * kPiece], kPiece); });
  });
  return 2.0 * static_cast<double>(kBytes) / seconds;
}

}  // namespace espalier::bench
