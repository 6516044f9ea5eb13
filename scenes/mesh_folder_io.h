#pragma once
#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::scenes {

/// Assimp's way to files, narrowed: regular files in or below one folder, read only, asked for by relative
/// paths without `..`, not through links that lead out. Everything else is as if it were not there.
class MeshFolderIo : public Assimp::DefaultIOSystem {
 public:
  explicit MeshFolderIo(const std::filesystem::path& folder);

  bool Exists(const char* name) const override;
  Assimp::IOStream* Open(const char* name, const char* mode) override;

  /// Names that were asked for and could not be served, in the order of asking.
  const std::vector<std::string>& refused() const { return refused_; }

 private:
  /// The file to open, or an empty path.
  std::filesystem::path resolve(const char* name) const;

  std::filesystem::path folder_;
  std::vector<std::string> refused_;
};

}  // namespace espalier::scenes
