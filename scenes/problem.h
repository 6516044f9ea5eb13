#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/base/error.h"

/// What is wrong with an input file, and where. A reader finds all of a file's problems in one run.
namespace espalier::scenes {

struct Problem {
  std::string path;    ///< as it was asked for, or beside the file that names it
  int line = 0;        ///< from 1; 0: the file as a whole
  int column = 0;      ///< from 1, in characters
  std::string text;    ///< what is wrong; what was expected; did you mean 'x'?
  int end_column = 0;  ///< in the same line, behind the last character; 0: not known
  std::string key =
      {};  ///< the path of what is wrong in its file, such as "plants[0].seeds"; empty: not known
  friend bool operator==(const Problem&, const Problem&) = default;
};

/// "path:line:column: text", in one line whatever path and text are.
std::string format(const Problem& problem);
/// "path:line:column: warning: text", likewise.
std::string formatWarning(const Problem& warning);
/// One line each.
std::string format(const std::vector<Problem>& problems);

/// Wrong input that takes several lines to tell. What any other sim::InputError says is one line, whatever
/// line breaks a name in it has.
class ManyLines : public sim::InputError {
 public:
  explicit ManyLines(std::vector<std::string> lines);
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

/// Wrong input with its places, at least one: a line each.
class PlacedError : public ManyLines {
 public:
  explicit PlacedError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// A value, or the problems that kept it from being one.
template <class T>
class Result {
 public:
  Result(T value) : value_(std::move(value)) {}                              // NOLINT: a value is a result
  Result(std::vector<Problem> problems) : problems_(std::move(problems)) {}  // NOLINT: and so is failure

  explicit operator bool() const { return value_.has_value(); }
  const T& operator*() const { return *value_; }
  T& operator*() { return *value_; }
  const T* operator->() const { return &*value_; }
  T* operator->() { return &*value_; }
  /// Empty where there is a value.
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::optional<T> value_;
  std::vector<Problem> problems_;
};

/// A place in an input file.
struct Place {
  std::shared_ptr<const std::string> path;
  int line = 0;
  int column = 0;
  int end_column = 0;    ///< as a Problem has it
  std::string key = {};  ///< likewise
};

/// What is wrong at a place; without a path in it, with a file as a whole.
Problem problemAt(const Place& place, const std::filesystem::path& otherwise, std::string text);

/// Nobody reads more problems than this; further ones are counted as one.
inline constexpr std::size_t kMostProblems = 1000;

/// Gathers problems. The same one found twice (a file that several others build on) counts once.
class Problems {
 public:
  void add(const Place& place, std::string text);
  bool empty() const { return seen_.empty(); }
  bool full() const { return seen_.size() >= kMostProblems; }
  /// File by file in the order in which they were first found wanting, each from top to bottom.
  std::vector<Problem> sorted() const;

 private:
  struct More {
    int end_column;
    std::string key;
  };
  std::vector<std::string> paths_;
  std::map<std::tuple<std::size_t, int, int, std::string>, More> seen_;
};

/// Does the parts of some work, each although others failed, so that all that is wrong is told at once.
/// The same problem found twice counts once.
class Gathering {
 public:
  /// `file`: what is wrong where a part has no place.
  explicit Gathering(std::filesystem::path file) : file_(std::move(file)) {}

  /// A sim::InputError that the part throws has this place then, but a PlacedError has its own.
  template <class Work>
  void part(const Place& place, Work work) {
    try {
      work();
    } catch (const PlacedError& error) {
      for (const Problem& problem : error.problems()) add(problem);
    } catch (const sim::InputError& error) {
      add(problemAt(place, file_, error.what()));
    }
  }
  template <class Work>
  void part(Work work) {
    part({}, std::move(work));
  }
  void add(Problem problem);
  /// Throws PlacedError if anything is wrong.
  void end() const;

 private:
  std::filesystem::path file_;
  std::vector<Problem> problems_;
};

/// "; did you mean 'x'?" for the candidate nearest to a misspelt word, or nothing where none is near.
std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates);
/// Words joined by commas, as many and as much of each as a reader will look at: of many, those nearest to
/// the word `near` first, and how many more there are.
std::string listed(const std::vector<std::string>& words, std::string_view near = {});
/// What is said of a name that none of what a scene has is called by: "no mesh is called 'wal'; expected one
/// of ground, wall; did you mean 'wall'?". Empty where it is one of the names.
std::string notCalled(std::string_view what, const std::string& name, const std::vector<std::string>& names);
/// A text from a file for use in a message: in quotes, printable and cut short.
std::string inQuotes(std::string_view text);

}  // namespace espalier::scenes
