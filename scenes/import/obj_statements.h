#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace espalier::scenes {

/// A number as OBJ and MTL files have them: a `+` may stand before it, and a decimal comma in it. Nothing
/// where the word is something else, or no finite number in single precision.
std::optional<float> numberOf(std::string_view word);

/// The statements of an OBJ or MTL file: its lines, those that end in a backslash joined with the next.
/// Comments are not joined, since a folder's name may end them.
class ObjStatements {
 public:
  /// Borrows the text.
  explicit ObjStatements(std::string_view text);

  /// Goes on to the next one; false at the end.
  bool next();
  std::string_view keyword() const { return keyword_; }
  int line() const { return line_; }  ///< where it begins, from 1

  /// What stands behind the keyword, without blanks at its ends: a name, which may have spaces.
  std::string_view rest() const { return rest_; }
  int column() const;  ///< where that begins, from 1
  /// The next of the numbers behind the keyword; empty at the end and at a comment.
  std::string_view takeNumber();

 private:
  std::string_view takeLine();

  std::string_view left_, statement_, keyword_, rest_, numbers_;
  std::string joined_;
  int lines_ = 0, line_ = 0;
};

/// The vertices of an OBJ file as its other statements ask for them: counted from 1, or backwards from the
/// last one so far. A number may ask for one that comes later. `who` asks: "a face". All throw
/// sim::InputError, with the line.
class ObjVertices {
 public:
  void add() { ++count_; }
  std::int64_t count() const { return count_; }

  /// The vertex, from 1, of `vertex/texture/normal`.
  std::int64_t asked(std::string_view word, int line, const char* who);
  /// To be called at the end: whether all came that were asked for.
  void requireAll() const;

 private:
  [[noreturn]] void failOutOfRange(const std::string& vertex, int line, const char* who) const;

  std::int64_t count_ = 0, highest_ = 0;
  int highest_line_ = 0;
  const char* highest_who_ = "";
};

}  // namespace espalier::scenes
