#pragma once
#include <string>
#include <utility>
#include <vector>

/// A rule or scene file before it is written: so that what a check refuses can be taken out again.
namespace espalier::fuzz {

struct DrawnEntry;

struct Drawn {
  enum class Kind { text, list, map };
  Kind kind = Kind::text;
  std::string text;                 ///< as it stands behind its key
  std::vector<DrawnEntry> entries;  ///< of a map; of a list, without keys

  Drawn();
  Drawn(std::string written);  // NOLINT: a text is a value
};

struct DrawnEntry {
  std::string key;
  Drawn value;
  bool required = false;
  std::string path = {};  ///< of its key in the registry, after "rules:" or "scene:"; empty where it has none
  int line = 0;           ///< where it was written last, from 1
};

inline Drawn::Drawn() = default;
inline Drawn::Drawn(std::string written) : text(std::move(written)) {}

/// The file's text, each entry on lines of its own; notes these lines.
std::string write(Drawn& root);

/// Takes out the innermost entry around a line that may go: one that is not required. The line on which it
/// began, or 0 where there is none.
int takeOut(Drawn& root, int line);

}  // namespace espalier::fuzz
