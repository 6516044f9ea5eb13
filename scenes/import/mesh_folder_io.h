#pragma once
#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::scenes {

/// Assimp's way to files, narrowed: one mesh file by its bare name, and regular files in or below its folder,
/// read only, asked for by relative paths without `..`, not through links that lead out. Everything else is
/// as if it were not there.
class MeshFolderIo : public Assimp::DefaultIOSystem {
 public:
  using Edit = void (*)(std::string& text);

  /// `mesh_file` is canonical. `edit`, where given, changes the mesh file's text before Assimp sees it.
  MeshFolderIo(const std::filesystem::path& mesh_file, Edit edit);

  bool Exists(const char* name) const override;
  Assimp::IOStream* Open(const char* name, const char* mode) override;

  /// Names that were asked for and could not be served, in the order of asking.
  const std::vector<std::string>& refused() const { return refused_; }

 private:
  /// The file to open, or an empty path.
  std::filesystem::path resolve(const char* name) const;

  std::filesystem::path mesh_file_;
  Edit edit_;
  std::vector<std::string> refused_;
};

}  // namespace espalier::scenes
