#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/read/document.h"
#include "scenes/scene.h"

namespace espalier::studio {

/// A text of a project: a file, as it is being written.
struct OpenFile {
  std::string name;  ///< from the scene's file
  std::filesystem::path path;
  bool scene = false;    ///< else rules
  bool library = false;  ///< a rule set of the program's own: it can only be read
  std::string text;
  std::string saved;  ///< a hash of the file's bytes, as they were last read or written here
};

/// A scene's text and those of the rule files that it names.
class Project {
 public:
  /// Throws InputError for a scene file that cannot be read.
  explicit Project(const std::filesystem::path& scene);

  const std::filesystem::path& scene() const { return files_.front().path; }
  /// The scene first, then rules in the order in which they are named.
  const std::vector<OpenFile>& files() const { return files_; }
  /// Throws InputError for a name that none has.
  const OpenFile& file(const std::string& name) const;
  /// What the page calls the file of a path.
  std::string nameOf(const std::string& path) const;
  /// All texts that can be written.
  scenes::OpenTexts texts() const;

  /// Throws InputError for a name that none has, and for a file of the library.
  void write(const std::string& name, std::string text);
  /// Files that a scene names (its read_files) come in, those that it does not name go, but for ones with
  /// unsaved words; where it names none at all, nothing happens. Whether any did.
  bool take(const scenes::Scene& scene);

  /// Puts a text into its file, whole or not at all. `saved`: the hash that the writer knows. Where the file
  /// holds something else by now, nothing happens and the text that it holds comes back. Throws InputError
  /// for a file that the scene on the disk does not name, for a link out of the scene's folder, and as
  /// sim::writeWhole does.
  std::optional<std::string> save(const std::string& name, const std::string& text, const std::string& saved);

  struct Changed {
    std::string name, saved, text;
  };
  /// Files that another hand has changed since they were read, saved, or told of.
  std::vector<Changed> changedOnDisk();

 private:
  OpenFile& fileToWrite(const std::string& name);
  void requireOurs(const OpenFile& file) const;

  std::vector<OpenFile> files_;
  std::map<std::string, std::pair<std::uintmax_t, std::int64_t>> stamps_;  // size and time by path
  std::map<std::string, std::string> told_;                                // hash by path
};

}  // namespace espalier::studio
