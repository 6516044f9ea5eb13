#include "scenes/import/obj_statements.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

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

bool goesOn(std::string_view line) {
  return line.ends_with('\\') && !withoutBlanks(line).starts_with('#');
}

}  // namespace

std::optional<float> numberOf(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  std::string with_point;
  if (const auto comma = word.find(','); comma != word.npos) {
    with_point = word;
    with_point[comma] = '.';
    word = with_point;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  const auto single = static_cast<float>(value);
  return std::isfinite(single) ? std::optional(single) : std::nullopt;
}

ObjStatements::ObjStatements(std::string_view text) : left_(text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (left_.starts_with(kByteOrderMark)) left_.remove_prefix(kByteOrderMark.size());
}

std::string_view ObjStatements::takeLine() {
  ++lines_;
  const std::size_t end = std::min(left_.find_first_of("\n\r"), left_.size());
  const std::string_view line = left_.substr(0, end);
  left_.remove_prefix(end);
  if (left_.starts_with("\r\n")) left_.remove_prefix(1);
  if (!left_.empty()) left_.remove_prefix(1);
  return line;
}

bool ObjStatements::next() {
  if (left_.empty()) return false;
  line_ = lines_ + 1;
  statement_ = takeLine();
  if (goesOn(statement_)) {
    joined_.clear();
    for (; statement_.ends_with('\\'); statement_ = takeLine()) {
      joined_ += statement_.substr(0, statement_.size() - 1);
      joined_ += ' ';
    }
    joined_ += statement_;
    statement_ = joined_;
  }
  numbers_ = statement_;
  keyword_ = takeWord(numbers_);
  rest_ = withoutBlanks(numbers_);
  return true;
}

int ObjStatements::column() const {
  return static_cast<int>(rest_.data() - statement_.data()) + 1;
}

std::string_view ObjStatements::takeNumber() {
  const std::string_view word = takeWord(numbers_);
  if (!word.starts_with('#')) return word;
  numbers_ = {};
  return {};
}

void ObjVertices::failOutOfRange(const std::string& vertex, int line, const char* who) const {
  throw sim::InputError(fmt::format("line {}: {} asks for vertex {}, which is out of range: there are {}",
                                    line, who, vertex, count_));
}

std::int64_t ObjVertices::asked(std::string_view word, int line, const char* who) {
  const std::string_view number = word.substr(0, word.find('/'));
  std::int64_t vertex = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), vertex);
  if (error != std::errc() || end != number.data() + number.size())
    throw sim::InputError(fmt::format("line {}: {} is not the number of a vertex", line, inQuotes(word)));
  if (vertex == 0)
    throw sim::InputError(fmt::format("line {}: {} asks for vertex 0; they are counted from 1", line, who));
  if (vertex < 0) {
    if (vertex < -count_) failOutOfRange(std::string(number), line, who);
    return count_ + 1 + vertex;
  }
  if (vertex > highest_) {  // it may come later
    highest_ = vertex;
    highest_line_ = line;
    highest_who_ = who;
  }
  return vertex;
}

void ObjVertices::requireAll() const {
  if (highest_ > count_) failOutOfRange(std::to_string(highest_), highest_line_, highest_who_);
}

}  // namespace espalier::scenes
