#include "tests/bench/report.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace espalier::bench {
namespace {

std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  std::replace(text.begin(), text.end(), '\n', ';');
  return '"' + text + '"';
}

/// Four figures; large numbers whole, in groups of three.
std::string number(double value) {
  if (std::abs(value) < 1000.0) return fmt::format("{:.4g}", value);
  std::string digits = fmt::format("{:.0f}", value);
  for (int at = static_cast<int>(digits.size()) - 3; at > (value < 0.0 ? 1 : 0); at -= 3)
    digits.insert(static_cast<std::size_t>(at), ",");
  return digits;
}

}  // namespace

double secondsOf(const Work& work) {
  const auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

double cpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](timeval t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::vector<double> medianSeconds(const std::vector<Work>& works) {
  constexpr std::size_t kRounds = 5;
  std::vector<std::array<double, kRounds>> seconds(works.size());
  for (const Work& work : works) work();
  for (std::size_t round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < works.size(); ++i) seconds[i][round] = secondsOf(works[i]);
  }
  std::vector<double> medians;
  for (auto& five : seconds) {
    std::nth_element(five.begin(), five.begin() + kRounds / 2, five.end());
    medians.push_back(five[kRounds / 2]);
  }
  return medians;
}

double medianSeconds(const Work& work) {
  return medianSeconds(std::vector<Work>{work})[0];
}

std::uint64_t hashOf(std::span<const std::uint16_t> sums) {
  return XXH3_64bits(sums.data(), sums.size_bytes());
}

Report::Report(std::string machine)
    : machine_(std::move(machine)), csv_("row,what,value,unit,target,met,state,machine\n") {
  print(machine_);
}

void Report::print(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
  text_ += line + '\n';
}

void Report::title(const std::string& text) {
  print("\n" + text);
}

void Report::note(const std::string& text) {
  print("  " + text);
}

void Report::add(const Figure& figure) {
  std::string target, met;
  if (figure.target) {
    const auto [goal, at_least] = *figure.target;
    target = fmt::format("{} {}", at_least ? "at least" : "at most", number(goal));
    met = (at_least ? figure.value >= goal : figure.value <= goal) ? "met" : "missed";
  }
  print(fmt::format("  {:<70} {:>13} {:<7} {}{}", figure.what, number(figure.value), figure.unit,
                    figure.state == 0 ? "" : fmt::format("{:016x}", figure.state),
                    met.empty() ? "" : fmt::format("  target {}: {}", target, met)));
  csv_ += fmt::format("{},{},{:.9g},{},{},{},{:016x},{}\n", quoted(figure.row), quoted(figure.what),
                      figure.value, quoted(figure.unit), quoted(target), met, figure.state, quoted(machine_));
}

void Report::writeCsv(const std::filesystem::path& path) const {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  sim::writeWhole(path, csv_);
}

void Report::writeInto(const std::filesystem::path& document) const {
  std::ifstream in(document);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string fence = "\n```\n";
  const auto begin = text.find(fence);
  const auto end = begin == std::string::npos ? begin : text.find(fence, begin + fence.size() - 1);
  if (end == std::string::npos)
    throw sim::InputError(document.string() + ": there is no block between two lines of ```");
  text.replace(begin + fence.size(), end + 1 - begin - fence.size(), text_);
  sim::writeWhole(document, text);
}

}  // namespace espalier::bench
