#include "scenes/problem.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

namespace espalier::scenes {
namespace {

constexpr std::size_t kLongestWord = 64;

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Insertions, deletions, substitutions and swaps of neighbours, in any letter case.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  const auto same = [&](std::size_t i, std::size_t j) { return lower(a[i - 1]) == lower(b[j - 1]); };
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same(i, j) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i, j - 1) && same(i - 1, j))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string placed(const Problem& problem, std::string_view kind) {
  const auto& [path, line, column, text] = problem;
  return line == 0 ? fmt::format("{}: {}{}", path, kind, text)
                   : fmt::format("{}:{}:{}: {}{}", path, line, column, kind, text);
}

/// Fit for one line: control characters are spaces, and what is long is cut short.
std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string shown;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      shown += ' ';
      continue;
    }
    // Cut between characters, never inside one.
    if (shown.size() >= kMost && (static_cast<unsigned char>(c) & 0xc0) != 0x80) return shown + "...";
    shown += c;
  }
  return shown;
}

}  // namespace

std::string format(const Problem& problem) {
  return placed(problem, "");
}

std::string formatWarning(const Problem& warning) {
  return placed(warning, "warning: ");
}

std::string format(const std::vector<Problem>& problems) {
  std::string all;
  for (const auto& problem : problems) {
    if (!all.empty()) all += '\n';
    all += format(problem);
  }
  return all;
}

void Problems::add(const Place& place, std::string text) {
  if (full()) return;
  const std::string& path = *place.path;
  auto at = std::find(paths_.begin(), paths_.end(), path);
  if (at == paths_.end()) at = paths_.insert(paths_.end(), path);
  seen_.emplace(static_cast<std::size_t>(at - paths_.begin()), place.line, place.column, std::move(text));
}

std::vector<Problem> Problems::sorted() const {
  std::vector<Problem> all;
  for (const auto& [path, line, column, text] : seen_) all.push_back({paths_[path], line, column, text});
  if (full())
    all.push_back(
        {paths_.back(), 0, 0, fmt::format("{} problems and perhaps more; the rest is not shown", kMost)});
  return all;
}

std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.empty() || word.size() > kLongestWord) return "";
  const std::string* best = nullptr;
  std::size_t distance = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const auto& candidate : candidates) {
    if (candidate.size() > kLongestWord) continue;
    const auto [less, more] = std::minmax(word.size(), candidate.size());
    if (more - less >= distance) continue;
    const auto d = editDistance(word, candidate);
    if (d < distance) {
      distance = d;
      best = &candidate;
    }
  }
  return best ? fmt::format("; did you mean '{}'?", *best) : "";
}

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t kMost = 16;
  if (words.empty()) return "none";
  std::vector<std::string> shown;
  for (const auto& word : std::span(words).first(std::min(words.size(), kMost)))
    shown.push_back(shortened(word));
  return fmt::format("{}{}", fmt::join(shown, ", "), words.size() > kMost ? ", ..." : "");
}

std::string inQuotes(std::string_view text) {
  return fmt::format("'{}'", shortened(text));
}

}  // namespace espalier::scenes
