#include "scenes/import/obj_text.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <set>

#include "scenes/problem.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

bool isBlank(char c) {
  return static_cast<unsigned char>(c) <= ' ';
}

std::string_view withoutBlanks(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view takeWord(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && isBlank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !isBlank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

/// The same in a list of numbers, which a comment may follow.
std::string_view takeNumber(std::string_view& text) {
  const std::string_view word = takeWord(text);
  if (!word.starts_with('#')) return word;
  text = {};
  return {};
}

/// A file's statements: its lines, those that end in a backslash joined with the next.
class Statements {
 public:
  explicit Statements(std::string_view text) : left_(text) {}

  bool next() {
    if (left_.empty()) return false;
    line_ = lines_ + 1;
    statement_ = takeLine();
    if (!statement_.ends_with('\\')) return true;
    joined_.clear();
    while (statement_.ends_with('\\')) {
      joined_ += statement_.substr(0, statement_.size() - 1);
      joined_ += ' ';
      statement_ = takeLine();
    }
    joined_ += statement_;
    statement_ = joined_;
    return true;
  }
  std::string_view statement() const { return statement_; }
  int line() const { return line_; }  ///< where it begins, from 1

 private:
  std::string_view takeLine() {
    ++lines_;
    const std::size_t end = std::min(left_.find_first_of("\n\r"), left_.size());
    const std::string_view line = left_.substr(0, end);
    left_.remove_prefix(end);
    if (left_.starts_with("\r\n")) left_.remove_prefix(1);
    if (!left_.empty()) left_.remove_prefix(1);
    return line;
  }

  std::string_view left_, statement_;
  std::string joined_;
  int lines_ = 0, line_ = 0;
};

class TakingApart {
 public:
  ObjText takeApart(std::string_view obj) {
    if (obj.starts_with("\xef\xbb\xbf")) obj.remove_prefix(3);  // a byte order mark
    text_.shapes.reserve(obj.size());
    Statements statements(obj);
    while (statements.next()) {
      line_ = statements.line();
      std::string_view rest = statements.statement();
      const std::string_view keyword = takeWord(rest);
      if (keyword == "v") {
        addVertex(rest);
      } else if (keyword == "f") {
        addPolygon(rest);
      } else if (keyword == "g" || keyword == "o") {
        now_.group = withoutBlanks(rest);
      } else if (keyword == "usemtl") {
        now_.material = named(rest, statements.statement());
      } else if (keyword == "mtllib") {
        addLibrary(named(rest, statements.statement()));
      }
    }
    if (highest_ > vertices_) {
      line_ = highest_line_;
      failOutOfRange(std::to_string(highest_));
    }
    return std::move(text_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw sim::InputError(fmt::format("line {}: {}", line_, what));
  }
  [[noreturn]] void failOutOfRange(const std::string& vertex) const {
    fail(fmt::format("a face asks for vertex {}, which is out of range: there are {}", vertex, vertices_));
  }

  /// Three coordinates, and a fourth alone: more are colours.
  void addVertex(std::string_view rest) {
    std::array<std::string_view, 5> words;
    std::size_t count = 0;
    while (count < words.size() && !(words[count] = takeNumber(rest)).empty()) ++count;
    if (count < 3) fail(fmt::format("a vertex has {} numbers; expected three: x, y and z", count));
    text_.shapes += 'v';
    for (std::size_t i = 0; i < (count == 4 ? 4 : 3); ++i) addNumber(words[i]);
    text_.shapes += '\n';
    ++vertices_;
  }

  void addNumber(std::string_view word) {
    const std::string_view digits = word.substr(word.find_first_not_of("+-") == 1 ? 1 : 0);
    const bool finite = word.find_first_not_of("0123456789+-.,eE") == std::string_view::npos;
    if (!finite && std::string_view("nNiI").find(digits.front()) == std::string_view::npos)
      fail(fmt::format("{} is not a number", inQuotes(word)));
    text_.shapes += ' ';
    if (word.front() == '.') text_.shapes += '0';
    text_.shapes += word;
  }

  void addPolygon(std::string_view rest) {
    corners_.clear();
    for (std::string_view word = takeNumber(rest); !word.empty(); word = takeNumber(rest))
      corners_.push_back(vertexOf(word));
    if (corners_.size() < 3) return;
    text_.shapes += 'f';
    for (const std::int64_t vertex : corners_)
      fmt::format_to(std::back_inserter(text_.shapes), " {}", vertex);
    text_.shapes += '\n';
    if (text_.stretches.empty() || text_.stretches.back().group != now_.group ||
        text_.stretches.back().material.name != now_.material.name) {
      now_.first_polygon = text_.polygons;
      text_.stretches.push_back(now_);
    }
    ++text_.polygons;
  }

  /// Of `vertex/texture/normal`; counted from 1, or backwards from the last one so far.
  std::int64_t vertexOf(std::string_view word) {
    const std::string_view number = word.substr(0, word.find('/'));
    std::int64_t vertex = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), vertex);
    if (error != std::errc() || end != number.data() + number.size())
      fail(fmt::format("{} is not the number of a vertex", inQuotes(word)));
    if (vertex == 0) fail("a face asks for vertex 0; they are counted from 1");
    if (vertex < 0) {
      if (-vertex > vertices_) failOutOfRange(std::string(number));
      return vertices_ + 1 + vertex;
    }
    if (vertex > highest_) {  // it may come later
      highest_ = vertex;
      highest_line_ = line_;
    }
    return vertex;
  }

  ObjText::Named named(std::string_view rest, std::string_view statement) const {
    const std::string_view name = withoutBlanks(rest);
    return {std::string(name), line_, static_cast<int>(name.data() - statement.data()) + 1};
  }

  void addLibrary(const ObjText::Named& library) {
    if (!library.name.empty() && known_libraries_.insert(library.name).second)
      text_.libraries.push_back(library);
  }

  ObjText text_;
  ObjText::Stretch now_;
  std::set<std::string> known_libraries_;
  std::vector<std::int64_t> corners_;
  std::int64_t vertices_ = 0, highest_ = 0;
  int highest_line_ = 0, line_ = 0;
};

}  // namespace

ObjText takeApart(std::string_view obj) {
  return TakingApart().takeApart(obj);
}

}  // namespace espalier::scenes
