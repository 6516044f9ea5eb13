#include "scenes/import/obj_text.h"

#include <fmt/format.h>

#include <array>
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

  void addPolygon(ObjStatements& statement) {
    corners_.clear();
    for (std::string_view word = statement.takeNumber(); !word.empty(); word = statement.takeNumber())
      corners_.push_back(vertices_.asked(word, line_, "a face"));
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
  std::vector<std::int64_t> corners_;
  ObjVertices vertices_;
  int line_ = 0;
};

}  // namespace

ObjText takeApart(std::string_view obj) {
  return TakingApart().takeApart(obj);
}

}  // namespace espalier::scenes
