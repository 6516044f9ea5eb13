#pragma once
#include <assimp/DefaultIOSystem.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/base/provenance.h"

namespace espalier::scenes {

/// Assimp's way to files, narrowed: one mesh file by its bare name, and regular files in or below its folder,
/// read only, asked for by relative paths without `..`, not through links that lead out. Everything else is
/// as if it were not there. A file is read once and kept, so that its hash is that of what Assimp saw.
class MeshFolderIo : public Assimp::DefaultIOSystem {
 public:
  using Edit = void (*)(std::string& text);

  /// `mesh_file` is canonical. `edit`, where given, changes the mesh file's text before Assimp sees it.
  MeshFolderIo(const std::filesystem::path& mesh_file, Edit edit);

  bool Exists(const char* name) const override;
  Assimp::IOStream* Open(const char* name, const char* mode) override;

  /// Names that were asked for and could not be served, in the order of asking.
  const std::vector<std::string>& refused() const { return refused_; }
  /// What was read: the mesh file first, then the others in the order of their names; called by their paths
  /// from its folder.
  std::vector<sim::InputFile> files() const;

 private:
  /// The file to open, or an empty path.
  std::filesystem::path resolve(const char* name) const;

  std::filesystem::path mesh_file_;
  Edit edit_;
  std::vector<std::string> refused_;
  struct Kept {
    std::string bytes;  ///< as Assimp sees them
    std::uint64_t hash = 0;
  };
  std::map<std::filesystem::path, Kept> kept_;
};

}  // namespace espalier::scenes
