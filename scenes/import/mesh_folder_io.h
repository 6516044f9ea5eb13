#pragma once
#include <assimp/DefaultIOSystem.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/provenance.h"

namespace espalier::scenes {

/// Assimp's way to files, narrowed: one mesh file by its bare name, and regular files in or below its folder,
/// read only, asked for by relative paths without `..`, not through links that lead out, of at most
/// kMostFileBytes. Everything else is as if it were not there. A file is read once and kept, so that its hash
/// is that of what was read. Beside them stand files that are only shown.
class MeshFolderIo : public Assimp::DefaultIOSystem {
 public:
  /// `mesh_file` is canonical.
  explicit MeshFolderIo(const std::filesystem::path& mesh_file);

  /// What the file holds; null where it is not to be read. `name` is as the mesh has it; a `%20` in it may
  /// stand for a space, as in a URI. Stays where it is.
  const std::string* read(const std::string& name);
  /// Shows these bytes as a file of this name, whatever the folder has. They are not copied.
  void show(const std::string& name, std::string_view bytes) { shown_[name] = bytes; }

  bool Exists(const char* name) const override;
  Assimp::IOStream* Open(const char* name, const char* mode) override;

  /// Names that Assimp asked for and that could not be served, in the order of asking.
  const std::vector<std::string>& refused() const { return refused_; }
  /// What was read: the mesh file first, then the others in the order of their names; called by their paths
  /// from its folder.
  std::vector<sim::InputFile> files() const;

 private:
  /// The file to open, or an empty path.
  std::filesystem::path resolve(const std::string& name) const;

  std::filesystem::path mesh_file_;
  std::vector<std::string> refused_;
  struct Kept {
    std::string bytes;
    std::uint64_t hash = 0;
  };
  std::map<std::filesystem::path, Kept> kept_;
  std::map<std::string, std::string_view> shown_;
};

}  // namespace espalier::scenes
