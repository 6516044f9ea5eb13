#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// What a benchmark found, on paper and as a table.
namespace espalier::bench {

using Work = std::function<void()>;

/// One timing.
double secondsOf(const Work& work);

/// What this process has used so far, of all threads.
double cpuSeconds();

/// The median of five timings, seconds, after one run that warms caches and memory.
double medianSeconds(const Work& work);
/// The same for several that are to be compared: they take turns, so that what else the machine does falls on
/// all of them.
std::vector<double> medianSeconds(const std::vector<Work>& works);

/// XXH3 of an answer: says what a figure was measured on.
std::uint64_t hashOf(std::span<const std::uint16_t> sums);

/// What a figure is held to.
struct Target {
  double value = 0.0;
  bool at_least = true;  ///< else at most
};

struct Figure {
  std::string row;   ///< of the benchmark
  std::string what;  ///< was measured
  double value = 0.0;
  std::string unit;
  std::uint64_t state = 0;  ///< hash of the world or the answer
  std::optional<Target> target = std::nullopt;
};

/// Prints as it goes, and keeps all for the table.
class Report {
 public:
  explicit Report(std::string machine);

  void title(const std::string& text);
  void note(const std::string& text);
  void add(const Figure& figure);

  /// Each figure with the machine and the versions.
  void writeCsv(const std::filesystem::path& path) const;
  /// Replaces what stands between a document's first two lines of ``` by what was printed.
  void writeInto(const std::filesystem::path& document) const;

 private:
  void print(const std::string& line);

  std::string machine_, text_, csv_;
};

}  // namespace espalier::bench
