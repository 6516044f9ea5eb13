#pragma once
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

}  // namespace espalier::scenes
