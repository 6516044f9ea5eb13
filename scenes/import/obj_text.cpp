#include "scenes/import/obj_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <set>

#include "scenes/import/obj_statements.h"
#include "scenes/problem.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

class TakingApart {
 public:
  ObjText takeApart(std::string_view obj) {
    text_.shapes.reserve(obj.size());
    for (ObjStatements statement(obj); statement.next();) {
      line_ = statement.line();
      const std::string_view keyword = statement.keyword();
      if (keyword == "v") {
        addVertex(statement);
      } else if (keyword == "vt") {
        uvs_.push_back(glm::vec2(looksIn(statement)));
      } else if (keyword == "vn") {
        normals_.push_back(looksIn(statement));
      } else if (keyword == "f") {
        addPolygon(statement);
      } else if (keyword == "g" || keyword == "o") {
        now_.group = statement.rest();
      } else if (keyword == "usemtl") {
        now_.material = named(statement);
      } else if (keyword == "mtllib") {
        addLibrary(named(statement));
      }
    }
    vertices_.requireAll();
    text_.uvs = pick(uv_of_, uvs_);
    text_.normals = pick(normal_of_, normals_);
    return std::move(text_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw sim::InputError(fmt::format("line {}: {}", line_, what));
  }

  /// Three coordinates, and a fourth alone: more are colours.
  void addVertex(ObjStatements& statement) {
    std::array<std::string_view, 5> words;
    std::size_t count = 0;
    while (count < words.size() && !(words[count] = statement.takeNumber()).empty()) ++count;
    if (count < 3) fail(fmt::format("a vertex has {} numbers; expected three: x, y and z", count));
    text_.shapes += 'v';
    for (std::size_t i = 0; i < (count == 4 ? 4 : 3); ++i) addNumber(words[i]);
    text_.shapes += '\n';
    vertices_.add();
  }

  void addNumber(std::string_view word) {
    if (!numberOf(word)) fail(fmt::format("{} is not a finite number", inQuotes(word)));
    text_.shapes += ' ';
    if (word.front() == '.' || word.front() == ',') text_.shapes += '0';
    text_.shapes += word;
  }

  /// Up to three numbers of a `vt` or `vn`; zero where it is none.
  static sim::Vec3f looksIn(ObjStatements& statement) {
    sim::Vec3f looks(0.0f);
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = statement.takeNumber();
      const auto number = word.empty() ? 0.0f : numberOf(word);
      if (!number) return sim::Vec3f(0.0f);
      looks[i] = *number;
    }
    return looks;
  }

  void addPolygon(ObjStatements& statement) {
    corners_.clear();
    words_.clear();
    for (std::string_view word = statement.takeNumber(); !word.empty(); word = statement.takeNumber()) {
      corners_.push_back(vertices_.asked(word, line_, "a face"));
      words_.push_back(word);
    }
    if (corners_.size() < 3) return;
    for (const std::string_view word : words_) addLooks(word);
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

  /// Which `vt` and `vn` a corner asks for, or 0: they may come later.
  void addLooks(std::string_view word) {
    const auto take = [&] {
      const std::size_t slash = word.find('/');
      word.remove_prefix(slash == word.npos ? word.size() : slash + 1);
      return word.substr(0, word.find('/'));
    };
    const auto add = [&](std::vector<std::int64_t>& numbers, std::string_view number, std::size_t so_far) {
      std::int64_t asked = 0;
      if (!number.empty()) {
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), asked);
        if (error != std::errc() || end != number.data() + number.size() || asked == 0) asked = kNowhere;
      }
      if (asked < 0 && asked != kNowhere) {  // backwards from the last one so far
        asked += static_cast<std::int64_t>(so_far) + 1;
        if (asked < 1) asked = kNowhere;
      }
      if (asked == 0 && numbers.empty()) return;
      numbers.resize(all_corners_, 0);
      numbers.push_back(asked);
    };
    add(uv_of_, take(), uvs_.size());
    add(normal_of_, take(), normals_.size());
    ++all_corners_;
  }

  template <class T>
  std::vector<T> pick(std::vector<std::int64_t>& numbers, const std::vector<T>& values) {
    if (numbers.empty()) return {};
    numbers.resize(all_corners_, 0);
    std::vector<T> picked;
    picked.reserve(numbers.size());
    for (const std::int64_t number : numbers) {
      const bool there = number > 0 && number <= static_cast<std::int64_t>(values.size());
      picked.push_back(there ? values[static_cast<std::size_t>(number - 1)] : T(0.0f));
      text_.odd_corners += number != 0 && !there ? 1 : 0;
    }
    return picked;
  }

  static ObjText::Named named(const ObjStatements& statement) {
    return {std::string(statement.rest()), statement.line(), statement.column()};
  }

  void addLibrary(const ObjText::Named& library) {
    if (!library.name.empty() && known_libraries_.insert(library.name).second)
      text_.libraries.push_back(library);
  }

  ObjText text_;
  ObjText::Stretch now_;
  std::set<std::string> known_libraries_;
  static constexpr std::int64_t kNowhere = std::numeric_limits<std::int64_t>::min();
  std::vector<std::int64_t> corners_;
  std::vector<std::string_view> words_;
  std::vector<glm::vec2> uvs_;
  std::vector<sim::Vec3f> normals_;
  std::vector<std::int64_t> uv_of_, normal_of_;  // of each corner
  std::size_t all_corners_ = 0;
  ObjVertices vertices_;
  int line_ = 0;
};

}  // namespace

ObjText takeApart(std::string_view obj) {
  return TakingApart().takeApart(obj);
}

}  // namespace espalier::scenes
