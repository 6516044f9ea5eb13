#include "scenes/problem.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "scenes/clean_text.h"

namespace espalier::scenes {
namespace {

constexpr std::size_t kLongestMisspelt = 64;  ///< that may be a misspelt one
constexpr std::size_t kMostShown = 40;        ///< characters of a text in a message

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Insertions, deletions, substitutions and swaps of neighbours, in any letter case; `most` + 1 where it is
/// more than that. A message may ask for thousands of words.
std::size_t editDistance(std::string_view a, std::string_view b, std::size_t most) {
  if (std::max(a.size(), b.size()) > kLongestMisspelt) return most + 1;
  const auto [less, more] = std::minmax({a.size(), b.size()});  // in braces: by value
  if (more - less > most) return most + 1;
  using Row = std::array<std::size_t, kLongestMisspelt + 1>;
  std::array<Row, 3> rows{};  // of this letter of `a` and the two before it
  for (std::size_t j = 0; j <= b.size(); ++j) rows[0][j] = j;
  const auto same = [&](std::size_t i, std::size_t j) { return lower(a[i - 1]) == lower(b[j - 1]); };
  for (std::size_t i = 1; i <= a.size(); ++i) {
    Row& row = rows[i % 3];
    const Row& last = rows[(i + 2) % 3];
    const Row& before = rows[(i + 1) % 3];
    row[0] = i;
    std::size_t least = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same(i, j) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i, j - 1) && same(i - 1, j)) row[j] = std::min(row[j], before[j - 2] + 1);
      least = std::min(least, row[j]);
    }
    if (least > most) return most + 1;  // later rows are no nearer: a swap costs what one change does
  }
  return std::min(rows[a.size() % 3][b.size()], most + 1);
}

/// Those that a misspelt word may have meant, the nearest first.
std::vector<const std::string*> nearTo(std::string_view word, const std::vector<std::string>& candidates) {
  const std::size_t most = std::max<std::size_t>(1, word.size() / 3);
  std::vector<std::pair<std::size_t, const std::string*>> near;
  if (word.empty()) return {};
  for (const auto& candidate : candidates) {
    const std::size_t distance = editDistance(word, candidate, most);
    if (distance <= most) near.emplace_back(distance, &candidate);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const std::string*> words;
  for (const auto& [distance, candidate] : near) words.push_back(candidate);
  return words;
}

std::string placed(const Problem& problem, std::string_view kind) {
  return oneLine(problem.line == 0 ? fmt::format("{}: {}{}", problem.path, kind, problem.text)
                                   : fmt::format("{}:{}:{}: {}{}", problem.path, problem.line, problem.column,
                                                 kind, problem.text));
}

Problem restOf(const std::string& path) {
  return {path, 0, 0, fmt::format("{} problems and perhaps more; the rest is not shown", kMostProblems)};
}

std::vector<std::string> linesOf(const std::vector<Problem>& problems) {
  std::vector<std::string> lines;
  for (const Problem& problem : problems) lines.push_back(format(problem));
  return lines;
}

}  // namespace

std::string format(const Problem& problem) {
  return placed(problem, "");
}

std::string formatWarning(const Problem& warning) {
  return placed(warning, "warning: ");
}

std::string format(const std::vector<Problem>& problems) {
  return fmt::format("{}", fmt::join(linesOf(problems), "\n"));
}

ManyLines::ManyLines(std::vector<std::string> lines)
    : InputError(fmt::format("{}", fmt::join(lines, "\n"))), lines_(std::move(lines)) {}

PlacedError::PlacedError(std::vector<Problem> problems)
    : ManyLines(linesOf(problems)), problems_(std::move(problems)) {}

Problem problemAt(const Place& place, const std::filesystem::path& otherwise, std::string text) {
  if (!place.path) return {otherwise.string(), 0, 0, std::move(text)};
  return {*place.path, place.line, place.column, std::move(text), place.end_column, place.key};
}

void Problems::add(const Place& place, std::string text) {
  if (full()) return;
  const std::string& path = *place.path;
  auto at = std::find(paths_.begin(), paths_.end(), path);
  if (at == paths_.end()) at = paths_.insert(paths_.end(), path);
  seen_.try_emplace(
      {static_cast<std::size_t>(at - paths_.begin()), place.line, place.column, std::move(text)},
      More{place.end_column, place.key});
}

std::vector<Problem> Problems::sorted() const {
  std::vector<Problem> all;
  for (const auto& [where, more] : seen_) {
    const auto& [path, line, column, text] = where;
    all.push_back({paths_[path], line, column, text, more.end_column, more.key});
  }
  if (full()) all.push_back(restOf(paths_.back()));
  return all;
}

void Gathering::add(Problem problem) {
  if (problems_.size() > kMostProblems) return;
  if (problems_.size() == kMostProblems) problem = restOf(file_.string());
  if (std::find(problems_.begin(), problems_.end(), problem) == problems_.end())
    problems_.push_back(std::move(problem));
}

void Gathering::end() const {
  if (!problems_.empty()) throw PlacedError(problems_);
}

std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates) {
  const auto near = nearTo(word, candidates);
  return near.empty() ? "" : fmt::format("; did you mean '{}'?", printable(*near.front()));
}

std::string notCalled(std::string_view what, const std::string& name, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) != names.end()) return "";
  if (names.empty())
    return fmt::format("no {} is called {}, as there is none; expected one in the scene", what,
                       inQuotes(name));
  return fmt::format("no {} is called {}; expected one of {}{}", what, inQuotes(name), listed(names, name),
                     didYouMean(name, names));
}

std::string listed(const std::vector<std::string>& words, std::string_view near) {
  constexpr std::size_t kAll = 16, kFew = 8;
  if (words.empty()) return "none";
  const bool some = words.size() > kAll && !near.empty();
  const std::size_t most = some ? kFew : kAll;
  std::vector<const std::string*> chosen;
  if (some) chosen = nearTo(near, words);
  chosen.resize(std::min(chosen.size(), most));
  for (const auto& word : words) {
    if (chosen.size() == most) break;
    if (std::find(chosen.begin(), chosen.end(), &word) == chosen.end()) chosen.push_back(&word);
  }
  std::vector<std::string> shown;
  for (const std::string* word : chosen) shown.push_back(shortened(printable(*word), kMostShown));
  const std::size_t left = words.size() - chosen.size();
  return fmt::format("{}{}", fmt::join(shown, ", "), left > 0 ? fmt::format(" and {} more", left) : "");
}

std::string inQuotes(std::string_view text) {
  return fmt::format("'{}'", shortened(printable(text), kMostShown));
}

}  // namespace espalier::scenes
